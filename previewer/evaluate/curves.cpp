// SPDX-License-Identifier: Apache-2.0
#include "evaluate/curves.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace bounce {

double mean_of_frames(const std::vector<FrameError>& frames, double FrameError::*figure) {
    double sum = 0.0;
    for (const FrameError& frame : frames) {
        sum += frame.*figure;
    }
    return sum / static_cast<double>(frames.size());
}

CurvePoint make_point(std::string label, std::vector<FrameError> frames) {
    assert(!frames.empty());
    CurvePoint point;
    point.label = std::move(label);
    const std::pair<double CurvePoint::*, double FrameError::*> means[]{
        {&CurvePoint::seconds, &FrameError::seconds},
        {&CurvePoint::relmse, &FrameError::relmse},
        {&CurvePoint::relmse_exposed, &FrameError::relmse_exposed},
        {&CurvePoint::flip_ldr, &FrameError::flip_ldr},
        {&CurvePoint::ssim, &FrameError::ssim},
        {&CurvePoint::psnr_db, &FrameError::psnr_db},
        {&CurvePoint::bias, &FrameError::bias},
        {&CurvePoint::nrmse, &FrameError::nrmse},
        {&CurvePoint::smape, &FrameError::smape},
        {&CurvePoint::flip_hdr, &FrameError::flip_hdr},
        {&CurvePoint::seconds_least, &FrameError::seconds_least},
        {&CurvePoint::seconds_most, &FrameError::seconds_most},
    };
    for (const auto& [mean, figure] : means) {
        point.*mean = mean_of_frames(frames, figure);
    }
    for (const FrameError& frame : frames) {
        for (size_t channel = 0; channel < point.bias_rgb.size(); ++channel) {
            point.bias_rgb.at(channel) += frame.bias_rgb.at(channel) / static_cast<double>(frames.size());
        }
    }
    point.frames = std::move(frames);
    return point;
}

std::vector<bool> pareto_front(const std::vector<std::pair<double, double>>& points) {
    std::vector<bool> front;
    front.reserve(points.size());
    for (const auto& point : points) {
        const double seconds = point.first;
        const double error = point.second;
        const bool finite = std::isfinite(seconds) && std::isfinite(error);
        front.push_back(finite && std::none_of(points.begin(), points.end(), [&](const auto& other) {
                            return other.first <= seconds && other.second <= error &&
                                   (other.first < seconds || other.second < error);
                        }));
    }
    return front;
}

void mark_pareto(std::vector<Curve>& curves) {
    std::vector<CurvePoint*> all;
    std::vector<CurvePoint*> own;
    for (Curve& curve : curves) {
        for (CurvePoint& point : curve.points) {
            all.push_back(&point);
            if (!point.options.empty()) {
                own.push_back(&point);
            }
        }
    }
    const auto mark = [](const std::vector<CurvePoint*>& points, bool CurvePoint::*on_front) {
        std::vector<std::pair<double, double>> measured;
        measured.reserve(points.size());
        for (const CurvePoint* point : points) {
            measured.emplace_back(point->seconds, point->relmse);
        }
        const std::vector<bool> front = pareto_front(measured);
        for (size_t i = 0; i < points.size(); ++i) {
            points[i]->*on_front = front[i];
        }
    };
    mark(all, &CurvePoint::pareto);
    mark(own, &CurvePoint::own_front);
}

std::string equal_error_name(EqualErrorKind kind) {
    switch (kind) {
        case EqualErrorKind::interpolated:
            return "interpolated";
        case EqualErrorKind::extrapolated:
            return "extrapolated";
        case EqualErrorKind::fastest_point:
            return "fastest_point";
    }
    return {};
}

std::optional<EqualError> time_at_error(std::vector<std::pair<double, double>> ladder, double error) {
    // NaN compares false and is dropped with what has no logarithm.
    std::erase_if(ladder, [](const auto& point) {
        return !(point.first > 0.0 && point.second > 0.0 && std::isfinite(point.first) &&
                 std::isfinite(point.second));
    });
    if (ladder.size() < 2 || !(error > 0.0) || !std::isfinite(error)) {
        return std::nullopt;  // one point is no ladder, not even as a bound
    }
    // Of a noisy picture a single pixel can outweigh all others: points that a faster one beats say nothing.
    const std::vector<bool> front = pareto_front(ladder);
    size_t at = 0;
    std::erase_if(ladder, [&](const auto&) { return !front[at++]; });
    std::sort(ladder.begin(), ladder.end());
    ladder.erase(std::unique(ladder.begin(), ladder.end()), ladder.end());
    // From here on each point is slower and more exact than the one before.
    if (ladder.front().second <= error) {
        return EqualError{ladder.front().first, EqualErrorKind::fastest_point};
    }
    if (ladder.size() < 2) {
        return std::nullopt;
    }
    const auto after = std::find_if(ladder.begin() + 1, ladder.end(),
                                    [&](const auto& point) { return point.second <= error; });
    const bool beyond = after == ladder.end();
    const auto& [t1, e1] = beyond ? *(ladder.end() - 1) : *after;
    const auto& [t0, e0] = beyond ? *(ladder.end() - 2) : *(after - 1);
    if (beyond) {
        // Noise falls as one over the samples. Where the last segment is flatter than that, by set-up time or
        // by chance, following it would flatter whatever is compared.
        const double exponent = std::min(std::log(t1 / t0) / std::log(e0 / e1), 1.0);
        return EqualError{t1 * std::pow(e1 / error, exponent), EqualErrorKind::extrapolated};
    }
    const double along = std::log(error / e0) / std::log(e1 / e0);
    return EqualError{t0 * std::pow(t1 / t0, along), EqualErrorKind::interpolated};
}

std::vector<Speedup> speedups_at_equal_error(const std::vector<Curve>& curves) {
    std::vector<std::pair<double, double>> ladder;
    for (const Curve& curve : curves) {
        if (curve.reference_engine) {
            for (const CurvePoint& point : curve.points) {
                ladder.emplace_back(point.seconds, point.relmse);
            }
        }
    }
    std::vector<Speedup> speedups;
    for (const Curve& curve : curves) {
        if (curve.reference_engine || curve.peer) {
            continue;
        }
        for (const CurvePoint& point : curve.points) {
            if (const auto equal = time_at_error(ladder, point.relmse); equal && point.seconds > 0.0) {
                speedups.push_back({curve.name, point.label, point.relmse, point.seconds, equal->seconds,
                                    equal->seconds / point.seconds, equal->kind});
            }
        }
    }
    return speedups;
}

FrontSummary summarize_front(const std::vector<Curve>& curves, const std::vector<Speedup>& speedups) {
    FrontSummary summary;
    summary.geometric_mean_ratio = summary.least_ratio = std::numeric_limits<double>::quiet_NaN();
    double log_sum = 0.0;
    for (const Curve& curve : curves) {
        for (const CurvePoint& point : curve.points) {
            if (!point.own_front) {
                continue;
            }
            ++summary.points;
            const auto found = std::find_if(speedups.begin(), speedups.end(), [&](const Speedup& item) {
                return item.curve == curve.name && item.label == point.label;
            });
            if (found == speedups.end()) {
                continue;
            }
            ++summary.compared;
            summary.extrapolated += found->kind == EqualErrorKind::extrapolated ? 1U : 0U;
            summary.upper_bounds += found->kind == EqualErrorKind::fastest_point ? 1U : 0U;
            log_sum += std::log(found->ratio);
            if (!(summary.least_ratio <= found->ratio)) {
                summary.least_ratio = found->ratio;
                summary.least_curve = curve.name;
                summary.least_label = point.label;
            }
        }
    }
    if (summary.compared > 0) {
        summary.geometric_mean_ratio = std::exp(log_sum / static_cast<double>(summary.compared));
    }
    return summary;
}

}  // namespace bounce
