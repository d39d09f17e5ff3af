// SPDX-License-Identifier: Apache-2.0
#include "renderer/environment_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "scene/environment.h"
#include "scene/points/sobol.h"

namespace bounce {
namespace {

constexpr double k_pi = std::numbers::pi;

// Cells of the grid that parts are cut from: 0.7 degrees, a quarter of what a shadow map's texel blurs.
constexpr int k_grid_width = 512;
constexpr int k_grid_height = 256;

// A source is a sun where this much of the image's light comes from within k_sun_disk and most of that from
// its middle. Less than that leaves no shadow to be missed; each costs a light's shadow maps and reflective
// shadow map.
constexpr double k_sun_share = 0.04;
constexpr double k_sun_disk = 2.5 * k_pi / 180.0;
constexpr double k_sun_ring = 4.0 * k_pi / 180.0;    // from the disk's edge to here is what lies around it
constexpr double k_sun_spread = 1.3 * k_pi / 180.0;  // root mean square distance of its light from its middle
// In an image with larger texels than this a bright one is no sun but a soft patch.
constexpr double k_sun_texel = 1.0 * k_pi / 180.0;
constexpr int k_sun_candidates = 12;

// Parts smaller than this (root mean square radius) are not cut but shared: their lights' shadow maps see no
// difference.
constexpr double k_small_part = 0.05;

// Of the weight that parts are cut by, what is there without light: a dark sky is cut as well, or one of its
// lights would stand for half a sphere.
constexpr double k_dark_weight = 0.05;

double luminance(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

glm::dvec3 texel(const scene::Environment& image, int x, int y) {
    const size_t i = (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x)) * 3;
    return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

// As texture hardware interpolates and repeats it; x and y in texels.
glm::dvec3 interpolated(const scene::Environment& image, double x, double y) {
    const double left = std::floor(x - 0.5);
    const double top = std::floor(y - 0.5);
    const double fx = x - 0.5 - left;
    const double fy = y - 0.5 - top;
    const auto wrap = [](double i, int n) { return ((static_cast<int>(i) % n) + n) % n; };
    const auto row = [&](double j) {
        const int y0 = std::clamp(static_cast<int>(j), 0, image.height - 1);
        return (1.0 - fx) * texel(image, wrap(left, image.width), y0) +
               fx * texel(image, wrap(left + 1.0, image.width), y0);
    };
    return (1.0 - fy) * row(top) + fy * row(top + 1.0);
}

// Takes compact sources out of the image.
class SunFinder {
  public:
    explicit SunFinder(scene::Environment& image) : image_(image) {
        luminance_.reserve(image.rgb.size() / 3);
        for (int y = 0; y < image.height; ++y) {
            const double sr = scene::environment_texel_sr(image.width, image.height, y);
            for (int x = 0; x < image.width; ++x) {
                const double l = luminance(texel(image, x, y));
                luminance_.push_back(static_cast<float>(l));
                total_ += l * sr;
            }
        }
    }

    std::vector<EnvironmentSun> find() {
        std::vector<EnvironmentSun> suns;
        if (k_pi / image_.height > k_sun_texel || !(total_ > 0.0)) {
            return suns;
        }
        for (int i = 0; i < k_sun_candidates && suns.size() < EnvironmentLights::k_most_suns; ++i) {
            const auto peak = std::max_element(luminance_.begin(), luminance_.end());
            const auto index = static_cast<int>(peak - luminance_.begin());
            const glm::dvec3 middle = direction(index % image_.width, index / image_.width);
            if (const EnvironmentSun sun = take(middle); sun.angle_rad > 0.0) {
                suns.push_back(sun);
            }
            // Taken or not, no later candidate is there.
            visit(middle, k_sun_disk,
                  [&](int x, int y, const glm::dvec3&, double, double) { luminance_[place(x, y)] = 0.0F; });
        }
        std::stable_sort(suns.begin(), suns.end(), [](const EnvironmentSun& a, const EnvironmentSun& b) {
            return luminance(a.irradiance) > luminance(b.irradiance);
        });
        return suns;
    }

  private:
    [[nodiscard]] size_t place(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(image_.width) + static_cast<size_t>(x);
    }
    [[nodiscard]] glm::dvec3 direction(int x, int y) const {
        return scene::environment_direction((x + 0.5) / image_.width, (y + 0.5) / image_.height);
    }

    // Calls f(x, y, direction, solid angle, angle from the middle) for the texels within a radius.
    template <typename F>
    void visit(const glm::dvec3& middle, double radius, F&& f) const {
        const double polar = std::acos(std::clamp(middle.y, -1.0, 1.0));
        const double azimuth = std::atan2(middle.z, middle.x);
        const int top = std::max(static_cast<int>((polar - radius) / k_pi * image_.height), 0);
        const int bottom =
            std::min(static_cast<int>((polar + radius) / k_pi * image_.height) + 1, image_.height - 1);
        const double cos_radius = std::cos(radius);
        for (int y = top; y <= bottom; ++y) {
            const double sr = scene::environment_texel_sr(image_.width, image_.height, y);
            // A row near a pole lies in the disk with all of its length.
            const double sine = std::sin(k_pi * (y + 0.5) / image_.height) * std::sin(polar);
            const double half = sine > radius * radius ? radius / std::sqrt(sine) * 1.2 : k_pi;
            const double center = (azimuth / (2.0 * k_pi) + 0.5) * image_.width - 0.5;
            const double reach = std::min(half / (2.0 * k_pi), 0.5) * image_.width;
            const int first = static_cast<int>(std::floor(center - reach));
            const int count = std::min(static_cast<int>(std::ceil(2.0 * reach)) + 1, image_.width);
            for (int i = 0; i < count; ++i) {
                const int x = ((first + i) % image_.width + image_.width) % image_.width;
                const glm::dvec3 d = direction(x, y);
                if (const double c = glm::dot(d, middle); c >= cos_radius) {
                    f(x, y, d, sr, std::acos(std::min(c, 1.0)));
                }
            }
        }
    }

    // The source around a place, taken out of the image; angle_rad is 0 where there is none that counts.
    EnvironmentSun take(const glm::dvec3& middle) {
        glm::dvec3 around(0.0);
        double around_sr = 0.0;
        visit(middle, k_sun_ring, [&](int x, int y, const glm::dvec3&, double sr, double angle) {
            if (angle > k_sun_disk) {
                around += texel(image_, x, y) * sr;
                around_sr += sr;
            }
        });
        around /= std::max(around_sr, 1e-30);
        EnvironmentSun sun;
        glm::dvec3 moment(0.0);
        double light = 0.0;
        visit(middle, k_sun_disk, [&](int x, int y, const glm::dvec3& d, double sr, double) {
            const glm::dvec3 above = glm::max(texel(image_, x, y) - around, glm::dvec3(0.0)) * sr;
            sun.irradiance += above;
            moment += d * luminance(above);
            light += luminance(above);
        });
        if (!(light > k_sun_share * total_) || !(glm::length(moment) > 0.0)) {
            return {};
        }
        sun.from = glm::normalize(moment);
        double squares = 0.0;
        visit(middle, k_sun_disk, [&](int x, int y, const glm::dvec3& d, double sr, double) {
            const glm::dvec3 above = glm::max(texel(image_, x, y) - around, glm::dvec3(0.0)) * sr;
            const double angle = std::acos(std::min(glm::dot(d, sun.from), 1.0));
            squares += angle * angle * luminance(above);
        });
        const double spread = std::sqrt(squares / light);
        if (spread > k_sun_spread) {
            return {};
        }
        // Of an even disk of radius a the mean square distance from the middle is a^2 / 2.
        sun.angle_rad = std::max(2.0 * std::numbers::sqrt2 * spread, 1e-4);
        visit(middle, k_sun_disk, [&](int x, int y, const glm::dvec3&, double, double) {
            float* rgb = &image_.rgb[3 * place(x, y)];
            for (int c = 0; c < 3; ++c) {
                rgb[c] = std::min(rgb[c], static_cast<float>(around[c]));
            }
        });
        return sun;
    }

    scene::Environment& image_;
    std::vector<float> luminance_;  // 0 where no candidate is looked for any more
    double total_ = 0.0;
};

}  // namespace

struct EnvironmentLights::Part {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int lights = 1;  // that share it
    double weight = 0.0;
    double squares = 0.0;  // mean square distance of its weight from its middle
    // What is gained by cutting: error goes with a light's part times how far it is from where it should be.
    [[nodiscard]] double cost() const {
        const double w = weight / lights;
        return w * w * (squares + k_small_part * k_small_part);
    }
};

EnvironmentLights::EnvironmentLights(const scene::Environment& environment) {
    scene::Environment image = environment;
    suns_ = SunFinder(image).find();

    // A small image is interpolated at more places than it has texels.
    const int finer = std::max({1, (k_grid_width + image.width - 1) / image.width,
                                (k_grid_height + image.height - 1) / image.height});
    const int across = std::min(image.width * (image.width < k_grid_width ? finer : 1), 1 << 20);
    const int down = image.height * (image.height < k_grid_height ? finer : 1);
    width_ = std::min(across, k_grid_width);
    height_ = std::min(down, k_grid_height);
    const bool exact = across == image.width && down == image.height;
    table_.resize(static_cast<size_t>(width_ + 1) * static_cast<size_t>(height_ + 1));
    const auto cell = [&](int x, int y) -> Sums& {
        return table_[static_cast<size_t>(y) * static_cast<size_t>(width_ + 1) + static_cast<size_t>(x)];
    };
    double total = 0.0;
    for (int y = 0; y < down; ++y) {
        const double sr = scene::environment_texel_sr(across, down, y);
        const int row = static_cast<int>(int64_t{y} * height_ / down) + 1;
        for (int x = 0; x < across; ++x) {
            const double u = (x + 0.5) / across;
            const double v = (y + 0.5) / down;
            const glm::dvec3 light =
                sr * (exact ? texel(image, x, y) : interpolated(image, u * image.width, v * image.height));
            const glm::dvec3 d = scene::environment_direction(u, v);
            Sums& sum = cell(static_cast<int>(int64_t{x} * width_ / across) + 1, row);
            sum.irradiance += light;
            sum.luminance += luminance(light);
            sum.light_moment += d * luminance(light);
            sum.moment += d * sr;  // of what is there without light
            sum.solid_angle += sr;
            total += luminance(light);
        }
    }
    const double dark = total > 0.0 ? k_dark_weight * total / (4.0 * k_pi) : 1.0;
    for (int y = 1; y <= height_; ++y) {
        for (int x = 1; x <= width_; ++x) {
            Sums& sum = cell(x, y);
            sum.weight = sum.luminance + dark * sum.solid_angle;
            sum.moment = sum.light_moment + dark * sum.moment;
            const Sums &left = cell(x - 1, y), &above = cell(x, y - 1), &both = cell(x - 1, y - 1);
            sum.weight += left.weight + above.weight - both.weight;
            sum.moment += left.moment + above.moment - both.moment;
            sum.irradiance += left.irradiance + above.irradiance - both.irradiance;
            sum.light_moment += left.light_moment + above.light_moment - both.light_moment;
            sum.luminance += left.luminance + above.luminance - both.luminance;
            sum.solid_angle += left.solid_angle + above.solid_angle - both.solid_angle;
        }
    }
}

const EnvironmentLights::Sums& EnvironmentLights::at(int x, int y) const {
    return table_[static_cast<size_t>(y) * static_cast<size_t>(width_ + 1) + static_cast<size_t>(x)];
}

EnvironmentLights::Sums EnvironmentLights::sums(int x0, int y0, int x1, int y1) const {
    const Sums &a = at(x1, y1), &b = at(x0, y1), &c = at(x1, y0), &d = at(x0, y0);
    return {a.weight - b.weight - c.weight + d.weight,
            a.moment - b.moment - c.moment + d.moment,
            a.irradiance - b.irradiance - c.irradiance + d.irradiance,
            a.light_moment - b.light_moment - c.light_moment + d.light_moment,
            a.luminance - b.luminance - c.luminance + d.luminance,
            a.solid_angle - b.solid_angle - c.solid_angle + d.solid_angle};
}

EnvironmentLights::Part EnvironmentLights::make_part(int x0, int y0, int x1, int y1) const {
    const Sums s = sums(x0, y0, x1, y1);
    Part part{x0, y0, x1, y1};
    part.weight = std::max(s.weight, 0.0);
    // Sum of w |d - m|^2 over unit vectors d with the middle m is sum of w less |sum of w d|^2 over it.
    const double mean = glm::length(s.moment) / std::max(part.weight, 1e-300);
    part.squares = std::max(1.0 - mean * mean, 0.0);
    return part;
}

// Cuts where the sum of what is left of weight times squares is least. False where there is nothing to be
// cut.
bool EnvironmentLights::cut(const Part& part, Part& first, Part& second) const {
    double least = 1e300;
    const auto consider = [&](const Part& a, const Part& b) {
        if (const double left = a.weight * a.squares + b.weight * b.squares; left < least) {
            least = left;
            first = a;
            second = b;
        }
    };
    for (int x = part.x0 + 1; x < part.x1; ++x) {
        consider(make_part(part.x0, part.y0, x, part.y1), make_part(x, part.y0, part.x1, part.y1));
    }
    for (int y = part.y0 + 1; y < part.y1; ++y) {
        consider(make_part(part.x0, part.y0, part.x1, y), make_part(part.x0, y, part.x1, part.y1));
    }
    return least < 1e300;
}

std::vector<EnvironmentRegion> EnvironmentLights::regions(int count) const {
    // A binary tree; leaves are the parts.
    struct Node {
        Part part;
        int children = -1;  // the first of two
    };
    std::vector<Node> nodes{{make_part(0, 0, width_, height_)}};
    const auto cheaper = [&](int a, int b) {
        const double ca = nodes[static_cast<size_t>(a)].part.cost();
        const double cb = nodes[static_cast<size_t>(b)].part.cost();
        return ca != cb ? ca < cb : a > b;
    };
    std::priority_queue<int, std::vector<int>, decltype(cheaper)> queue(cheaper);
    queue.push(0);
    for (int lights = 1; lights < count; ++lights) {
        const int index = queue.top();
        queue.pop();
        const Part part = nodes[static_cast<size_t>(index)].part;
        Part first;
        Part second;
        // What is shared already stays whole.
        const bool small = part.lights > 1 || part.squares < k_small_part * k_small_part;
        if (!small && cut(part, first, second)) {
            nodes[static_cast<size_t>(index)].children = static_cast<int>(nodes.size());
            nodes.push_back({first});
            nodes.push_back({second});
            queue.push(static_cast<int>(nodes.size()) - 2);
            queue.push(static_cast<int>(nodes.size()) - 1);
        } else {
            ++nodes[static_cast<size_t>(index)].part.lights;
            queue.push(index);
        }
    }
    std::vector<EnvironmentRegion> out;
    std::vector<int> stack{0};
    while (!stack.empty()) {
        const Node node = nodes[static_cast<size_t>(stack.back())];
        stack.pop_back();
        if (node.children >= 0) {
            stack.push_back(node.children + 1);
            stack.push_back(node.children);
            continue;
        }
        const Part& part = node.part;
        const Sums s = sums(part.x0, part.y0, part.x1, part.y1);
        const glm::dvec3 moment =
            s.luminance > 0.0 && glm::length(s.light_moment) > 1e-9 * s.luminance ? s.light_moment : s.moment;
        const double length = glm::length(moment);
        EnvironmentRegion region;
        region.from = length > 0.0 ? moment / length
                                   : scene::environment_direction(0.5 * (part.x0 + part.x1) / width_,
                                                                  0.5 * (part.y0 + part.y1) / height_);
        // Differences of sums may round to just below 0.
        region.irradiance = glm::max(s.irradiance, glm::dvec3(0.0)) / static_cast<double>(part.lights);
        region.solid_angle = std::max(s.solid_angle, 0.0);
        out.insert(out.end(), static_cast<size_t>(part.lights), region);
    }
    return out;
}

SphereCells EnvironmentLights::cells(int across) const {
    SphereCells out{std::min(width_, across), std::min(height_, across / 2), {}};
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const Sums s = sums(x * width_ / out.width, y * height_ / out.height,
                                (x + 1) * width_ / out.width, (y + 1) * height_ / out.height);
            // Differences of sums may round to just below 0.
            out.light.emplace_back(glm::max(glm::vec3(s.irradiance), glm::vec3(0.0F)),
                                   static_cast<float>(std::max(s.solid_angle, 0.0)));
        }
    }
    return out;
}

double EnvironmentLights::whole_luminance() const {
    double sum = luminance(sums(0, 0, width_, height_).irradiance);
    for (const EnvironmentSun& sun : suns_) {
        sum += luminance(sun.irradiance);
    }
    return sum;
}

int environment_region_count(const EnvironmentLights& environment, const IsmLayout& layout) {
    const int subsets = layout.vpls / layout.subset;
    return environment.suns().empty() || layout.subset < 2 ? layout.vpls : layout.vpls - subsets;
}

std::vector<gpu::GpuVpl> environment_vpls(const EnvironmentLights& environment,
                                          const std::vector<EnvironmentRegion>& regions,
                                          const glm::dmat3& render_from_environment, double strength,
                                          const IsmLayout& layout, const DistantMaps& maps) {
    const int subsets = layout.vpls / layout.subset;
    double all = 0.0;
    for (const EnvironmentRegion& region : regions) {
        all += luminance(region.irradiance);
    }
    const std::vector<EnvironmentSun>& suns = environment.suns();
    for (const EnvironmentSun& sun : suns) {
        all += luminance(sun.irradiance);
    }
    const double per_light = all > 0.0 ? 4.0 * k_pi / all : 0.0;
    std::vector<gpu::GpuVpl> lights;
    for (int i = 0; i < layout.vpls; ++i) {
        const int subset = i / layout.subset;
        const auto region = static_cast<size_t>(i % layout.subset * subsets + subset);
        EnvironmentRegion of;
        double weight = 0.0;
        if (region < regions.size()) {
            of = regions[region];
            weight = luminance(of.irradiance) * per_light;
        } else {
            const size_t sun = static_cast<size_t>(subset) % suns.size();
            const auto shared = (static_cast<size_t>(subsets) - sun + suns.size() - 1) / suns.size();
            of.from = suns[sun].from;
            of.solid_angle = k_pi * 0.25 * suns[sun].angle_rad * suns[sun].angle_rad;
            weight = luminance(suns[sun].irradiance) * per_light / static_cast<double>(shared);
        }
        const double turn = 2.0 * k_pi * scene::sobol_point(static_cast<uint32_t>(i), k_world_lights_seed).z;
        // The map turns with the image, so that nothing but the light moves over its texels.
        gpu::GpuVpl light =
            distant_light(render_from_environment * -of.from,
                          render_from_environment * turned_tangent(-of.from, turn), i, layout, maps);
        light.position.w = static_cast<float>(of.solid_angle);
        light.intensity = glm::vec4(glm::vec3(of.irradiance * strength), 0.0F);
        light.incident.w = static_cast<float>(weight);
        lights.push_back(light);
    }
    return lights;
}

}  // namespace bounce
