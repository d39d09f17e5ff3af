// SPDX-License-Identifier: Apache-2.0
#include "image/metrics.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "image/metrics_json.h"
#include "image/srgb.h"

namespace bounce {
namespace {

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_inf = std::numeric_limits<float>::infinity();

Image pixels(int width, int height, std::vector<float> rgb) {
    Image image(width, height);
    image.rgb = std::move(rgb);
    return image;
}

Image constant(int width, int height, float value) {
    Image image(width, height);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

// One pixel whose numbers fit on paper.
const Image k_test = pixels(1, 1, {0.2F, 0.5F, 1.0F});
const Image k_reference = pixels(1, 1, {0.1F, 0.5F, 2.0F});

TEST(Metrics, RelmseByHand) {
    // (0.01/0.02 + 0/0.26 + 1/4.01) / 3
    EXPECT_NEAR(compare(k_test, k_reference).relmse, 0.249792, 1e-6);
}

TEST(Metrics, RelmseExposedByHand) {
    // mean(b) = 2.6/3, so both are scaled by s = 0.207692, s^2 = 0.0431361:
    // (s^2 0.01/(s^2 0.01 + 0.01) + 0 + s^2/(4 s^2 + 0.01)) / 3 = (0.0413523 + 0.236303) / 3
    EXPECT_NEAR(compare(k_test, k_reference).relmse_exposed, 0.0925519, 1e-6);
}

TEST(Metrics, RelmseExposedDoesNotChangeWithExposure) {
    const auto scaled = [](const Image& image, float factor) {
        Image result = image;
        for (float& value : result.rgb) {
            value *= factor;
        }
        return result;
    };
    const Metrics base = compare(k_test, k_reference);
    const Metrics bright = compare(scaled(k_test, 64.0F), scaled(k_reference, 64.0F));
    EXPECT_NEAR(bright.relmse_exposed, base.relmse_exposed, 1e-9);
    EXPECT_NEAR(bright.nrmse, base.nrmse, 1e-9);
    EXPECT_NEAR(bright.bias, base.bias, 1e-9);
    EXPECT_GT(std::abs(bright.relmse - base.relmse), 0.01) << "relmse is absolute by definition";
}

TEST(Metrics, RelativeErrorsByHand) {
    const Metrics metrics = compare(k_test, k_reference);
    EXPECT_NEAR(metrics.nrmse, std::sqrt(1.01 / 4.26), 1e-7);
    EXPECT_NEAR(metrics.smape, (0.1 / 0.31 + 0.0 + 1.0 / 3.01) / 3.0, 1e-7);
    EXPECT_NEAR(metrics.bias, 1.7 / 2.6 - 1.0, 1e-7);
    EXPECT_NEAR(metrics.bias_rgb[0], 1.0, 1e-6);
    EXPECT_NEAR(metrics.bias_rgb[1], 0.0, 1e-6);
    EXPECT_NEAR(metrics.bias_rgb[2], -0.5, 1e-6);
}

TEST(Metrics, BiasIsSignedAndNoiseWithoutBiasHasNone) {
    EXPECT_NEAR(compare(constant(4, 4, 0.9F), constant(4, 4, 1.0F)).bias, -0.1, 1e-6);
    const Image noisy = pixels(2, 1, {0.5F, 0.5F, 0.5F, 1.5F, 1.5F, 1.5F});
    const Metrics metrics = compare(noisy, constant(2, 1, 1.0F));
    EXPECT_NEAR(metrics.bias, 0.0, 1e-9);
    EXPECT_NEAR(metrics.relmse, 0.25 / 1.01, 1e-7);
}

TEST(Metrics, MaxAbsNamesItsPixel) {
    Image test = constant(5, 4, 1.0F);
    test.rgb[test.offset(3, 2) + 1] = -1.5F;
    const Metrics metrics = compare(test, constant(5, 4, 1.0F));
    EXPECT_DOUBLE_EQ(metrics.max_abs, 2.5);
    EXPECT_EQ(metrics.max_abs_x, 3);
    EXPECT_EQ(metrics.max_abs_y, 2);
}

TEST(Metrics, PsnrByHand) {
    // On screen 0.6 against 0.5: the mean squared error is 0.01, so 20 dB.
    const Metrics metrics =
        compare(constant(3, 3, linear_from_srgb(0.6F)), constant(3, 3, linear_from_srgb(0.5F)));
    EXPECT_NEAR(metrics.psnr_db, 20.0, 1e-4);
}

TEST(Metrics, EqualImagesHaveNoError) {
    Image image(16, 12);
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = static_cast<float>(i % 37) / 20.0F;
    }
    const Metrics metrics = compare(image, image);
    for (const NamedMetric& metric : named_metrics()) {
        if (metric.lower_is_better) {
            EXPECT_EQ(metric.value(metrics), 0.0) << metric.name;
            EXPECT_FALSE(exceeds(metrics, metric, 0.0)) << metric.name;
        }
    }
    EXPECT_NEAR(metrics.ssim, 1.0, 1e-9);
    EXPECT_TRUE(std::isinf(metrics.psnr_db));
    EXPECT_TRUE(metrics_to_json(metrics)["psnr_db"].is_null());
}

TEST(Metrics, BlackReferenceIsNoDivisionByZero) {
    const Metrics same = compare(constant(2, 2, 0.0F), constant(2, 2, 0.0F));
    EXPECT_EQ(same.bias, 0.0);
    EXPECT_EQ(same.nrmse, 0.0);
    EXPECT_EQ(same.flip_hdr, 0.0);
    const Metrics light = compare(constant(2, 2, 0.1F), constant(2, 2, 0.0F));
    EXPECT_NEAR(light.relmse, 1.0, 1e-6);  // 0.01 / 0.01
    EXPECT_TRUE(std::isinf(light.bias));
    EXPECT_TRUE(exceeds(light, *find_metric("bias"), 1e9));
    EXPECT_TRUE(std::isfinite(light.flip_hdr));
}

TEST(Metrics, NotFiniteValuesFailEveryThreshold) {
    Image test = constant(4, 4, 1.0F);
    test.rgb[5] = k_nan;
    test.rgb[9] = k_inf;
    Image reference = constant(4, 4, 1.0F);
    reference.rgb[5] = k_nan;
    const Metrics metrics = compare(test, reference);
    EXPECT_EQ(metrics.nan, 2U);
    EXPECT_EQ(metrics.inf, 1U);
    EXPECT_TRUE(std::isnan(metrics.relmse));
    EXPECT_TRUE(std::isnan(metrics.ssim));
    for (const NamedMetric& metric : named_metrics()) {
        EXPECT_TRUE(exceeds(metrics, metric, 1e30)) << metric.name;
    }
    const auto json = metrics_to_json(metrics);
    EXPECT_TRUE(json["relmse"].is_null());
    EXPECT_EQ(json["nan"], 2);
    EXPECT_TRUE(std::isnan(relmse(test, reference)));
}

TEST(Metrics, RefusesDifferentSizes) {
    try {
        (void)compare(constant(4, 3, 0.0F), constant(3, 4, 0.0F));
        FAIL() << "compared";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused);
        EXPECT_THAT(error.what(), testing::HasSubstr("4x3 but the reference is 3x4"));
    }
}

TEST(Metrics, JsonHasTheNamesOfTheContract) {
    const auto json = metrics_to_json(compare(k_test, k_reference));
    for (const char* name : {"relmse", "relmse_exposed", "nrmse", "smape", "psnr_db", "ssim", "flip_ldr",
                             "flip_hdr", "bias", "max_abs", "nan", "inf", "width", "height"}) {
        ASSERT_TRUE(json.contains(name)) << name;
        EXPECT_TRUE(json[name].is_number()) << name;
    }
    EXPECT_TRUE(json["nan"].is_number_integer());
}

TEST(Ssim, ConstantPlanesByHand) {
    Plane a(20, 15);
    Plane b(20, 15);
    std::fill(a.values.begin(), a.values.end(), 0.4F);
    std::fill(b.values.begin(), b.values.end(), 0.6F);
    // Without variance the second factor is 1: (2 * 0.24 + 1e-4) / (0.16 + 0.36 + 1e-4).
    EXPECT_NEAR(ssim(a, b), 0.4801 / 0.5201, 1e-6);
}

// One 11 x 11 window: the sums of the paper's equations 14 to 16, written out.
TEST(Ssim, OneWindowAgainstTheEquations) {
    Plane a(11, 11);
    Plane b(11, 11);
    double weight = 0;
    double mean_a = 0;
    double mean_b = 0;
    const auto w = [](int x, int y) { return std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / 4.5); };
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 11; ++x) {
            const auto i = static_cast<size_t>(y * 11 + x);
            a.values[i] = static_cast<float>((x * 3 + y * 5) % 7) / 7.0F;
            b.values[i] = static_cast<float>((x * 2 + y * y) % 5) / 5.0F;
            weight += w(x, y);
            mean_a += w(x, y) * a.values[i];
            mean_b += w(x, y) * b.values[i];
        }
    }
    mean_a /= weight;
    mean_b /= weight;
    double var_a = 0;
    double var_b = 0;
    double covariance = 0;
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 11; ++x) {
            const auto i = static_cast<size_t>(y * 11 + x);
            var_a += w(x, y) / weight * std::pow(a.values[i] - mean_a, 2);
            var_b += w(x, y) / weight * std::pow(b.values[i] - mean_b, 2);
            covariance += w(x, y) / weight * (a.values[i] - mean_a) * (b.values[i] - mean_b);
        }
    }
    const double expected = (2 * mean_a * mean_b + 1e-4) * (2 * covariance + 9e-4) /
                            ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (var_a + var_b + 9e-4));
    EXPECT_NEAR(ssim(a, b), expected, 1e-6);
}

TEST(Ssim, InvertedStructureIsNegative) {
    Plane a(16, 16);
    Plane b(16, 16);
    for (size_t i = 0; i < a.values.size(); ++i) {
        a.values[i] = static_cast<float>(i % 2);
        b.values[i] = 1.0F - a.values[i];
    }
    EXPECT_LT(ssim(a, b), -0.9);
}

}  // namespace
}  // namespace bounce
