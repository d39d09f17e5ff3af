// SPDX-License-Identifier: Apache-2.0
//
// The approximate visibility grid of a scene and what is traced through it, read back.
#pragma once

#include <array>
#include <bit>
#include <map>
#include <random>

#include "ism_fixture.h"
#include "passes/avg_trace.h"
#include "passes/deform.h"
#include "renderer/avg_layout.h"
#include "renderer/avg_rays.h"

namespace bounce::test {

struct ReadGrid {
    gpu::AvgUniforms layout{};
    gpu::RenderSpace space;
    int found = 0;  // surfaces, whether there was room for them or not
    std::vector<GLuint> cells;
    std::vector<gpu::GpuAvgVoxel> surfaces;

    [[nodiscard]] glm::ivec3 size() const { return glm::ivec3(layout.size); }
    [[nodiscard]] GLuint word(const glm::ivec3& cell) const {
        return cells[static_cast<size_t>((cell.z * layout.size.y + cell.y) * layout.size.x + cell.x)];
    }
    [[nodiscard]] glm::dvec3 voxels(const glm::dvec3& world) const {
        return (space.point(world) - glm::dvec3(glm::vec3(layout.origin))) /
               static_cast<double>(layout.origin.w);
    }
    [[nodiscard]] double voxel_m() const { return static_cast<double>(layout.origin.w) / space.scale; }
    [[nodiscard]] const gpu::GpuAvgVoxel* at(const glm::ivec3& cell, int axis) const {
        const GLuint bits = word(cell);
        if ((bits >> static_cast<GLuint>(axis) & 1U) == 0U) {
            return nullptr;
        }
        const auto below = static_cast<unsigned>(bits & ((1U << static_cast<GLuint>(axis)) - 1U));
        const size_t index = (bits >> 3U) + static_cast<size_t>(std::popcount(below));
        return &surfaces[std::min(index, surfaces.size() - 1)];
    }
    // Surfaces by cell and axis, whatever their order in the list.
    [[nodiscard]] std::map<std::array<int, 4>, gpu::GpuAvgVoxel> sorted() const {
        std::map<std::array<int, 4>, gpu::GpuAvgVoxel> out;
        for (int z = 0; z < layout.size.z; ++z) {
            for (int y = 0; y < layout.size.y; ++y) {
                for (int x = 0; x < layout.size.x; ++x) {
                    for (int axis = 0; axis < 3; ++axis) {
                        if (const gpu::GpuAvgVoxel* surface = at({x, y, z}, axis)) {
                            out[{x, y, z, axis}] = *surface;
                        }
                    }
                }
            }
        }
        return out;
    }
    [[nodiscard]] double area_m2() const {
        double faces = 0.0;
        for (const auto& [place, surface] : sorted()) {
            faces += static_cast<double>(surface.tensor_diagonal.w);
        }
        return faces * voxel_m() * voxel_m();
    }
};

struct Traced {
    ReadGrid grid;
    std::vector<std::vector<gpu::GpuVpl>> bounces;

    [[nodiscard]] glm::dvec3 place(const gpu::GpuVpl& vpl) const {
        return glm::dvec3(glm::vec3(vpl.position)) / grid.space.scale + grid.space.origin;
    }
    // Reflected by all lights of a bounce, W.
    [[nodiscard]] glm::dvec3 flux_w(size_t bounce) const {
        glm::dvec3 sum(0.0);
        for (const gpu::GpuVpl& vpl : bounces[bounce]) {
            sum += pi * glm::dvec3(glm::vec3(vpl.intensity));
        }
        return sum / (grid.space.scale * grid.space.scale);
    }
};

inline bool is_dark(const gpu::GpuVpl& vpl) {
    return vpl.intensity.r <= 0.0F && vpl.intensity.g <= 0.0F && vpl.intensity.b <= 0.0F;
}

// Fills the grid of the scene as settings have it, and traces the lights of all bounces through it.
inline Traced trace(const scene::Scene& scene, const Settings& settings, double time_s = 0.0) {
    const scene::Pose pose = scene::evaluate_pose(scene, time_s);
    gpu::GpuScene gpu_scene(scene);
    gpu_scene.set_pose(pose);
    static gl::ProgramCache programs;  // compiling takes longer than all else
    if (gpu_scene.deforms()) {
        passes::run_deform(programs, gpu_scene);
    }
    gpu::UniformArena uniforms;
    const passes::PassContext context{.programs = programs,
                                      .scene = gpu_scene,
                                      .uniforms = uniforms,
                                      .frame = uniforms.add(gpu::FrameUniforms{}),
                                      .width = 1,
                                      .height = 1};
    Traced out;
    out.grid.space = gpu_scene.space();
    const scene::Bounds first = scene::world_bounds(scene, scene::evaluate_pose(scene, 0.0));
    passes::AvgGrid grid;
    grid.layout = avg_layout(first, gpu_scene.bounds(), gpu_scene.space(), settings.avg_size, 1LL << 27);
    grid.uniforms = uniforms.add(grid.layout);
    out.grid.layout = grid.layout;

    TransientPool pool;
    FrameGraph graph(pool);
    grid = passes::add_avg_grid(graph, context, grid);
    std::vector<AvgRayLight> lights;
    for (const scene::LightInstance& instance : pose.light_instances) {
        const scene::Light& light = pose.lights[static_cast<size_t>(instance.light)];
        lights.push_back(
            {set_up_light(instance, light, gpu_scene.bounds(), gpu_scene.space(), 64, 64), light.pattern});
    }
    const IsmLayout first_layout = ism_layout(settings, 1, 0);
    const gl::Buffer rays =
        gl::Buffer::of("rays", std::span<const gpu::GpuAvgRay>(avg_rays(lights, first_layout)));
    const gl::Buffer numbers = gl::Buffer::of(
        "numbers", std::span<const glm::vec4>(
                       avg_numbers(std::max(first_layout.vpls, ism_layout(settings, 2, 0).vpls))));
    std::vector<passes::VplSet> sets;
    for (int bounce = 1; bounce <= settings.bounces && !lights.empty(); ++bounce) {
        const IsmLayout layout = ism_layout(settings, bounce, 0);
        passes::VplSet set;
        set.maps = layout.vpls;
        set.map_size = layout.map_size;
        set.columns = layout.columns;
        set.interleave = layout.interleave;
        set.subset = layout.subset;
        set.cell_columns = layout.cell_columns;
        set.uniforms = uniforms.add(ism_uniforms(layout, settings, 0, 0.0));
        const passes::AvgTraceInputs inputs{
            grid,   settings.avg_hits,      settings.avg_paths, &numbers, k_avg_sequences,
            bounce, settings.glossy_bounces};
        sets.push_back(bounce == 1 ? passes::add_vpls_from_rays(graph, context, inputs, rays, set)
                                   : passes::add_vpls_from_avg(graph, context, inputs, sets.back(), set));
    }
    graph.add_pass("read back", [&](PassBuilder& builder) {
        builder.read(grid.cells);
        builder.read(grid.surfaces);
        builder.read(grid.rows);
        for (const passes::VplSet& set : sets) {
            builder.read(set.vpls);
        }
        builder.side_effect();
        return [&](const PassResources& resources) {
            glMemoryBarrier(GL_ALL_BARRIER_BITS);
            const glm::ivec3 size = out.grid.size();
            out.grid.cells.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y) *
                                  static_cast<size_t>(size.z));
            glGetTextureImage(resources.texture(grid.cells).id(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT,
                              static_cast<GLsizei>(out.grid.cells.size() * sizeof(GLuint)),
                              out.grid.cells.data());
            const auto last = static_cast<size_t>(size.y) * static_cast<size_t>(size.z) - 1;
            out.grid.found =
                static_cast<int>(resources.buffer(grid.rows).read<float>(1, last * sizeof(float))[0]);
            out.grid.surfaces = resources.buffer(grid.surfaces)
                                    .read<gpu::GpuAvgVoxel>(static_cast<size_t>(grid.layout.size.w));
            for (const passes::VplSet& set : sets) {
                out.bounces.push_back(
                    resources.buffer(set.vpls).read<gpu::GpuVpl>(static_cast<size_t>(set.maps)));
            }
        };
    });
    uniforms.upload();
    gl::PassTimer timer(gl::TimingMode::off);
    graph.execute(timer);
    return out;
}

inline Settings traced(int size, int bounces = 1, int vpls = 1024) {
    Settings settings;
    settings.avg_size = size;
    settings.bounces = bounces;
    settings.vpls = settings.bounce_vpls = vpls;
    settings.vpl_sampling = VplSampling::avg;
    settings.bounce_source = BounceSource::avg;
    return settings;
}

// Triangles with these corners, three by three.
inline int add_triangles(scene::Scene& scene, const std::vector<glm::vec3>& corners, int material) {
    scene::Primitive p;
    p.positions = corners;
    for (size_t i = 0; i < corners.size(); i += 3) {
        const glm::vec3 across = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
        const glm::vec3 n = glm::length(across) > 0.0F ? glm::normalize(across) : glm::vec3(0.0F, 0.0F, 1.0F);
        for (size_t k = 0; k < 3; ++k) {
            p.normals.push_back(n);
            p.indices.push_back(static_cast<uint32_t>(i + k));
        }
    }
    p.material = material;
    scene.meshes.push_back({"triangles", {p}, {}});
    return static_cast<int>(scene.meshes.size()) - 1;
}

// Each side of a box from -half to half as n x n squares of two triangles.
inline std::vector<glm::vec3> box_triangles(const glm::vec3& half, int n) {
    std::vector<glm::vec3> out;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const auto at = [&](int i, int j) {
                glm::vec3 p(0.0F);
                p[axis] = side;
                p[(axis + 1) % 3] = side * (2.0F * static_cast<float>(i) / static_cast<float>(n) - 1.0F);
                p[(axis + 2) % 3] = 2.0F * static_cast<float>(j) / static_cast<float>(n) - 1.0F;
                return p * half;
            };
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    for (const glm::vec3& p : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j),
                                               at(i + 1, j + 1), at(i, j + 1)}) {
                        out.push_back(p);
                    }
                }
            }
        }
    }
    return out;
}

inline int main_axis(const glm::dvec3& n) {
    const glm::dvec3 a = glm::abs(n);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

// Whether a place of a triangle is in the grid, and inside of what bounds there what faces as it does.
// across: along its normal, by the order of its corners.
inline ::testing::AssertionResult holds(const ReadGrid& grid, const glm::dvec3& world,
                                        const glm::dvec3& across) {
    const glm::dvec3 at = grid.voxels(world);
    const glm::ivec3 cell(glm::floor(at));
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell, grid.size()))) {
        return ::testing::AssertionFailure() << "outside of the grid";
    }
    const int axis = main_axis(across);
    const gpu::GpuAvgVoxel* surface = grid.at(cell, axis);
    if (surface == nullptr) {
        return ::testing::AssertionFailure() << "no surface at " << at.x << ' ' << at.y << ' ' << at.z;
    }
    const double along = glm::dot(glm::dvec3(glm::vec3(surface->normal)), at - glm::dvec3(cell) - 0.5);
    const bool up = across[axis] > 0.0;
    const double low = (up ? surface->slab.x : surface->slab.z) / AVG_SLAB_STEPS;
    const double high = (up ? surface->slab.y : surface->slab.w) / AVG_SLAB_STEPS;
    if (!(along >= low && along <= high)) {
        return ::testing::AssertionFailure() << along << " is not from " << low << " to " << high;
    }
    return ::testing::AssertionSuccess();
}

}  // namespace bounce::test
