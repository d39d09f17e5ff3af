// SPDX-License-Identifier: Apache-2.0
//
// The samplers of virtual point lights against the sum over all texels, on importance maps made of numbers.
#include "passes/vpl_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "render_fixture.h"

namespace bounce::test {
namespace {

struct Map {
    int size = 0;  // texels a row
    int rows = 0;
};

struct Chosen {
    size_t texel = 0;  // among those of all maps
    double texels = 0.0;
    double standing = 0.0;  // texels around it without another light
};

// Two lights whose maps differ in size, with importance that spreads over three decades and is nothing in
// places, and something to be summed up that grows with it, but more slowly.
struct Problem {
    std::vector<Map> maps = {{8, 8}, {4, 24}};
    std::vector<float> importance;
    std::vector<double> value;  // nothing where importance is nothing

    Problem() {
        std::mt19937 numbers(7);
        std::uniform_real_distribution<double> uniform(0.0, 1.0);
        for (const Map& map : maps) {
            for (int i = 0; i < map.size * map.rows; ++i) {
                const double f = uniform(numbers) < 0.2 ? 0.0 : std::pow(10.0, 3.0 * uniform(numbers) - 2.0);
                importance.push_back(static_cast<float>(f));
                value.push_back(std::sqrt(f) * (0.2 + uniform(numbers)));
            }
        }
    }
    [[nodiscard]] double sum() const {
        double out = 0.0;
        for (const double v : value) {
            out += v;
        }
        return out;
    }
    [[nodiscard]] size_t texels_of(size_t map) const {
        return static_cast<size_t>(maps[map].size) * static_cast<size_t>(maps[map].rows);
    }
    // Density of the uniform proposals: first one of the maps, then any of its texels.
    [[nodiscard]] double proposed(size_t texel) const {
        const size_t map = texel < texels_of(0) ? 0 : 1;
        return 1.0 / (static_cast<double>(maps.size()) * static_cast<double>(texels_of(map)));
    }
};

class VplChoice : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    std::vector<Chosen> choose(const Problem& problem, const passes::Choosing& choosing) {
        scene::Scene scene;
        add_mesh_node(scene, add_square(scene, 1.0F, add_diffuse(scene)), glm::dmat4(1.0));
        gpu::GpuScene gpu_scene(scene);
        gpu::UniformArena uniforms;
        const passes::PassContext context{.programs = programs_,
                                          .scene = gpu_scene,
                                          .uniforms = uniforms,
                                          .frame = uniforms.add(gpu::FrameUniforms{}),
                                          .width = 1,
                                          .height = 1};
        std::vector<passes::MapSource> sources;
        std::vector<float> row_sums;
        std::vector<float> texel_sums;
        std::vector<size_t> first;
        float rows = 0.0F;
        for (const Map& map : problem.maps) {
            first.push_back(texel_sums.size());
            passes::MapSource source;
            source.size = map.size;
            source.rows = map.rows;
            sources.push_back(source);
            for (int row = 0; row < map.rows; ++row) {
                float sum = 0.0F;
                for (int x = 0; x < map.size; ++x) {
                    sum += problem.importance[texel_sums.size()];
                    texel_sums.push_back(sum);
                }
                rows += sum;
                row_sums.push_back(rows);
            }
        }
        auto importance = gl::Buffer::of<float>("importance", problem.importance);
        auto row_buffer = gl::Buffer::of<float>("rows", row_sums);
        auto texel_buffer = gl::Buffer::of<float>("texels", texel_sums);
        TransientPool pool;
        FrameGraph graph(pool);
        const BufferHandle choices = passes::add_vpl_choice(
            graph, context, sources,
            {graph.import_buffer("importance", importance), graph.import_buffer("rows", row_buffer),
             graph.import_buffer("texels", texel_buffer)},
            choosing);
        std::vector<Chosen> out;
        graph.add_pass("read back", [&](PassBuilder& builder) {
            builder.read(choices);
            builder.side_effect();
            return [&](const PassResources& resources) {
                for (const glm::uvec4& c :
                     resources.buffer(choices).read<glm::uvec4>(static_cast<size_t>(choosing.lights))) {
                    out.push_back({first.at(c.x) + c.y, static_cast<double>(glm::uintBitsToFloat(c.z)),
                                   static_cast<double>(glm::uintBitsToFloat(c.w))});
                }
            };
        });
        uniforms.upload();
        gl::PassTimer timer(gl::TimingMode::off);
        graph.execute(timer);
        return out;
    }

    struct Estimate {
        double mean = 0.0;
        double error = 0.0;  // of the mean, one standard deviation
    };
    // Of the sum over all texels, from many seeds.
    Estimate estimate(const Problem& problem, passes::VplSampling sampling, int steps, int seeds = 400,
                      int lights = 64) {
        double mean = 0.0;
        double squares = 0.0;
        for (int seed = 1; seed <= seeds; ++seed) {
            double sum = 0.0;
            for (const Chosen& c : choose(problem, {sampling, lights, steps, static_cast<uint32_t>(seed)})) {
                sum += problem.value.at(c.texel) * c.texels;
            }
            const double d = sum - mean;
            mean += d / seed;
            squares += d * (sum - mean);
        }
        return {mean, std::sqrt(squares / (static_cast<double>(seeds) * (seeds - 1)))};
    }

    gl::ProgramCache programs_;
};

using passes::VplSampling;

TEST_F(VplChoice, EstimatesTheSumOverAllTexelsWithoutBias) {
    const Problem problem;
    const struct {
        VplSampling sampling;
        int steps;
    } cases[] = {{VplSampling::uniform3, 1},          {VplSampling::inverse2, 1},
                 {VplSampling::inverse3, 1},          {VplSampling::metropolis, 1},
                 {VplSampling::metropolis_single, 5}, {VplSampling::resampled, 2},
                 {VplSampling::resampled, 5},         {VplSampling::resampled, 20}};
    for (const auto& [sampling, steps] : cases) {
        const Estimate e = estimate(problem, sampling, steps);
        // Four standard deviations, and a part in a thousand for sums in single precision.
        EXPECT_NEAR(e.mean, problem.sum(), 4.0 * e.error + 1e-3 * problem.sum())
            << static_cast<int>(sampling) << ", " << steps << " steps";
        EXPECT_LT(e.error, 0.02 * problem.sum()) << static_cast<int>(sampling);
    }
}

// Of two proposals a and b, each uniform, the chain ends at b with min(1, f(b) / f(a)), else at a, and is
// worth (f(a) + f(b)) / 2 over its own f: what that makes of the sum can be enumerated.
TEST_F(VplChoice, TwoStepsOfMetropolisHaveTheBiasOfTheAlgorithm) {
    const Problem problem;
    double expected = 0.0;
    const size_t n = problem.value.size();
    const auto f = [&](size_t i) { return problem.importance[i] / problem.proposed(i); };
    const auto g = [&](size_t i) { return problem.value[i] / problem.proposed(i); };
    for (size_t a = 0; a < n; ++a) {
        for (size_t b = 0; b < n; ++b) {
            const double weight = 0.5 * (f(a) + f(b));
            const double accepted = f(a) > 0.0 ? std::min(f(b) / f(a), 1.0) : f(b) > 0.0 ? 1.0 : 0.0;
            double sum = 0.0;
            sum += f(b) > 0.0 ? accepted * weight / f(b) * g(b) : 0.0;
            sum += f(a) > 0.0 ? (1.0 - accepted) * weight / f(a) * g(a) : 0.0;
            expected += sum * problem.proposed(a) * problem.proposed(b);
        }
    }
    const Estimate e = estimate(problem, VplSampling::metropolis, 2, 4000);
    EXPECT_NEAR(e.mean, expected, 4.0 * e.error + 1e-3 * expected);
    // And that is far enough from no bias for the test to tell.
    EXPECT_GT(std::abs(expected - problem.sum()), 8.0 * e.error + 2e-3 * expected);
}

TEST_F(VplChoice, LongChainsOfMetropolisComeNearTheSum) {
    const Problem problem;
    for (const VplSampling sampling : {VplSampling::metropolis, VplSampling::metropolis_unreduced}) {
        const Estimate e = estimate(problem, sampling, 200, 100);
        // 1 %: start-up bias falls with the length of the chain.
        EXPECT_NEAR(e.mean, problem.sum(), 4.0 * e.error + 1e-2 * problem.sum());
    }
}

// Figure 6: without the reduction short chains are far off, with it they are not.
TEST_F(VplChoice, WeightsReduceTheBiasOfShortChains) {
    const Problem problem;
    const double reduced = std::abs(estimate(problem, VplSampling::metropolis, 2).mean - problem.sum());
    const double unreduced =
        std::abs(estimate(problem, VplSampling::metropolis_unreduced, 2).mean - problem.sum());
    EXPECT_LT(reduced, 0.5 * unreduced);
}

TEST_F(VplChoice, ChainsFollowImportance) {
    const Problem problem;
    std::vector<double> drawn(problem.value.size());
    constexpr int k_seeds = 200;
    for (uint32_t seed = 1; seed <= k_seeds; ++seed) {
        for (const Chosen& c : choose(problem, {VplSampling::metropolis, 64, 50, seed})) {
            drawn[c.texel] += 1.0 / (64.0 * k_seeds);
        }
    }
    double all = 0.0;
    for (const float f : problem.importance) {
        all += static_cast<double>(f);
    }
    double off = 0.0;
    for (size_t i = 0; i < drawn.size(); ++i) {
        off += std::abs(drawn[i] - static_cast<double>(problem.importance[i]) / all);
    }
    // Of 2 at most; noise of 12,800 draws over some hundred texels makes 0.07 of it.
    EXPECT_LT(off, 0.15);
}

TEST_F(VplChoice, NothingImportantMakesDarkLights) {
    Problem problem;
    std::fill(problem.importance.begin(), problem.importance.end(), 0.0F);
    for (const VplSampling sampling :
         {VplSampling::uniform3, VplSampling::inverse2, VplSampling::inverse3, VplSampling::metropolis,
          VplSampling::metropolis_single, VplSampling::metropolis_unreduced, VplSampling::resampled}) {
        for (const Chosen& c : choose(problem, {sampling, 64, 5, 0})) {
            EXPECT_EQ(c.texels, 0.0);
        }
    }
}

// The first proposals are those of uniform sampling, and chains share none: with importance that only grows
// along the texels a chain ends at the last of its proposals, which lies in its own part of the sequence.
TEST_F(VplChoice, ChainsOfOneStepAreUniformSampling) {
    const Problem problem;
    const auto chains = choose(problem, {VplSampling::metropolis, 96, 1, 0});
    const auto uniform = choose(problem, {VplSampling::uniform3, 96, 1, 0});
    for (size_t i = 0; i < chains.size(); ++i) {
        EXPECT_EQ(chains[i].texel, uniform[i].texel);
        EXPECT_NEAR(chains[i].texels, uniform[i].texels, 1e-5 * uniform[i].texels);
    }
}

// The size of a light is a function of its texel, whatever its chain met: the near field, which knows no
// chains, has the same. With inverse transform, and with chains of one step, it is what the light is worth.
TEST_F(VplChoice, SizesFollowFromTheTexelAlone) {
    const Problem problem;
    double all = 0.0;
    for (const float f : problem.importance) {
        all += static_cast<double>(f);
    }
    constexpr int k_lights = 64;
    for (const VplSampling sampling :
         {VplSampling::uniform3, VplSampling::inverse2, VplSampling::inverse3, VplSampling::metropolis,
          VplSampling::metropolis_single, VplSampling::metropolis_unreduced, VplSampling::resampled}) {
        for (const int steps : {1, 5}) {
            for (const Chosen& c : choose(problem, {sampling, k_lights, steps, 3})) {
                if (!(c.texels > 0.0)) {
                    continue;
                }
                const double even = 1.0 / (k_lights * problem.proposed(c.texel));
                const double by_importance =
                    all / (k_lights * static_cast<double>(problem.importance[c.texel]));
                const double part = sampling == VplSampling::uniform3 ? 1.0
                                    : passes::is_chain(sampling)      ? 1.0 / steps
                                                                      : 0.0;
                const double expected = part * even + (1.0 - part) * by_importance;
                // Single precision over two hundred sums.
                EXPECT_NEAR(c.standing, expected, 1e-4 * expected)
                    << static_cast<int>(sampling) << ", " << steps;
            }
        }
    }
}

// A local change of importance moves all lights of the inverse transform, and few of the chains'.
TEST_F(VplChoice, ChainsStayWhereImportanceDidNotChange) {
    Problem problem;
    problem.maps = {{64, 64}};
    problem.importance.assign(64UL * 64UL, 1.0F);
    const auto moved = [&](VplSampling sampling) {
        const auto before = choose(problem, {sampling, 256, 10, 0});
        Problem after = problem;
        for (size_t i = 0; i < 64; ++i) {
            after.importance[i] = 8.0F;  // one row of 64
        }
        const auto now = choose(after, {sampling, 256, 10, 0});
        int count = 0;
        for (size_t i = 0; i < before.size(); ++i) {
            count += before[i].texel != now[i].texel ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(moved(VplSampling::inverse2), 200);
    // A proposal in 64 is in that row, of ten a chain.
    EXPECT_LT(moved(VplSampling::metropolis), 64);
    EXPECT_LT(moved(VplSampling::resampled), 64);
}

}  // namespace
}  // namespace bounce::test
