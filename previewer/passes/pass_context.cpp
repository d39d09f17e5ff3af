// SPDX-License-Identifier: Apache-2.0
#include "passes/pass_context.h"

#include <algorithm>
#include <cstring>

namespace bounce::passes {
namespace {

bool depth_only(DrawKind kind) {
    switch (kind) {
        case DrawKind::depth:
        case DrawKind::solid_depth:
        case DrawKind::hashed_depth:
        case DrawKind::blended_depth:
        case DrawKind::seen_depth:
        case DrawKind::peeled_depth:
            return true;
        default:
            return false;
    }
}

// Of what a camera sees: with depth clamped it would see through its own near plane.
bool seen_by_camera(DrawKind kind) {
    return kind == DrawKind::surface || kind == DrawKind::surface_with_emission ||
           kind == DrawKind::seen_depth || kind == DrawKind::peeled_surface ||
           kind == DrawKind::peeled_surface_with_emission || kind == DrawKind::peeled_depth;
}

bool has_emission(DrawKind kind) {
    return kind == DrawKind::surface_with_emission || kind == DrawKind::peeled_surface_with_emission;
}

int blend_rule(DrawKind kind, bool blends) {
    switch (kind) {
        case DrawKind::peeled_surface:
        case DrawKind::peeled_surface_with_emission:
        case DrawKind::peeled_depth:
            return BLEND_PEEL;
        case DrawKind::hashed_depth:
        case DrawKind::blended_depth:
        case DrawKind::light_surface:
        case DrawKind::plane:
            return BLEND_HASHED;
        case DrawKind::solid_depth:
            return BLEND_SOLID;
        case DrawKind::depth:
            return BLEND_HALF;
        default:
            return blends ? BLEND_SOLID : BLEND_HALF;
    }
}

// Whether any of the batch can pass the kind's rule.
bool is_drawn(const gpu::DrawFeatures& features, DrawKind kind, bool blends) {
    const int rule = blend_rule(kind, blends);
    if (rule == BLEND_PEEL || kind == DrawKind::blended_depth) {
        return features.blend;
    }
    return rule != BLEND_SOLID || features.solid;
}

gl::Defines batch_defines(const gpu::DrawFeatures& features, DrawKind kind, bool blends, bool from_blender) {
    gl::Defines defines;
    const auto define_if = [&](bool condition, const char* name) {
        if (condition) {
            defines[name] = "1";
        }
    };
    const bool depth = depth_only(kind);
    define_if(features.alpha_test, "ALPHA_TEST");
    define_if(depth, "DEPTH_ONLY");
    if (depth && !features.alpha_test) {
        return defines;
    }
    if (features.blend) {
        defines["BLEND_RULE"] = std::to_string(blend_rule(kind, blends));
    }
    define_if(features.base_color_texture, "BASE_COLOR_TEXTURE");
    define_if(features.base_color_encoded, "BASE_COLOR_ENCODED");
    define_if(features.vertex_color, "VERTEX_COLOR");
    if (depth) {
        return defines;
    }
    define_if(features.metallic_roughness_texture, "METALLIC_ROUGHNESS_TEXTURE");
    define_if(features.metallic_roughness_encoded, "METALLIC_ROUGHNESS_ENCODED");
    define_if(features.normal_texture, "NORMAL_TEXTURE");
    define_if(features.normal_encoded, "NORMAL_ENCODED");
    define_if(features.normal_texture && from_blender && seen_by_camera(kind), "VALID_REFLECTIONS");
    define_if(has_emission(kind) && features.emission, "EMISSION");
    define_if(has_emission(kind) && features.emission_texture, "EMISSION_TEXTURE");
    define_if(has_emission(kind) && features.emission_encoded, "EMISSION_ENCODED");
    define_if(has_emission(kind), "WRITE_EMISSION");
    define_if(blend_rule(kind, blends) == BLEND_PEEL, "WRITE_ALPHA");
    define_if(kind == DrawKind::light_surface, "LIGHT_VIEW");
    return defines;
}

struct Run {
    uint32_t first;
    uint32_t count;
};

// The batch's draws that the view may see; all of them without a view.
std::vector<Run> seen_draws(const gpu::GpuScene& scene, const gpu::DrawBatch& batch, const View* view) {
    if (view == nullptr) {
        return {{batch.first_draw, batch.draw_count}};
    }
    std::vector<Run> out;
    for (uint32_t draw = batch.first_draw; draw < batch.first_draw + batch.draw_count; ++draw) {
        if (!gpu::may_be_seen(scene.draw_box(draw), view->clip_from_render)) {
            continue;
        }
        if (!out.empty() && out.back().first + out.back().count == draw) {
            ++out.back().count;
        } else {
            out.push_back({draw, 1});
        }
    }
    return out;
}

void draw_batches(const PassContext& context, const View* view, bool mirrored, DrawKind kind,
                  const std::string& fragment, const gl::Defines& defines, gpu::Geometry geometry) {
    context.scene.bind();
    glEnable(GL_DEPTH_TEST);
    // A light inside its own near plane must not see through what stands there.
    if (!seen_by_camera(kind) && (view == nullptr || !view->begins_near)) {
        glEnable(GL_DEPTH_CLAMP);
    }
    for (const gpu::DrawBatch& batch : context.scene.batches()) {
        if (!is_drawn(batch.features, kind, context.blends)) {
            continue;
        }
        const std::vector<Run> runs = seen_draws(context.scene, batch, view);
        if (runs.empty()) {
            continue;
        }
        gl::Defines all =
            batch_defines(batch.features, kind, context.blends, context.scene.source().from_blender);
        all.insert(defines.begin(), defines.end());
        if (batch.draw_count == 1) {
            all["SINGLE_DRAW"] = "1";
            context.scene.bind_single(batch);
        }
        context.programs.raster("passes/geometry.vert", fragment, all).use();
        context.scene.bind_material(batch);
        glFrontFace(batch.mirrored != mirrored ? GL_CW : GL_CCW);
        if (batch.cull_back_faces) {
            glEnable(GL_CULL_FACE);
        } else {
            glDisable(GL_CULL_FACE);
        }
        for (const Run& run : runs) {
            gpu::GpuScene::draw(batch, run.first, run.count, geometry);
        }
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
}

}  // namespace

ContentKey drawn_content(const PassContext& context, const View* view, DrawKind kind,
                         gpu::Geometry geometry) {
    ContentHash hash;
    hash.add(kind).add(geometry).add(context.blends);
    if (view != nullptr) {
        hash.add(content(context, view->uniforms)).add(view->mirrored).add(view->begins_near);
    }
    for (const gpu::DrawBatch& batch : context.scene.batches()) {
        if (!is_drawn(batch.features, kind, context.blends)) {
            continue;
        }
        const bool looks = !depth_only(kind) || batch.features.alpha_test;
        for (const Run& run : seen_draws(context.scene, batch, view)) {
            for (uint32_t draw = run.first; draw < run.first + run.count; ++draw) {
                hash.add(context.scene.draw_content(draw, geometry));
            }
            hash.add(batch.cull_back_faces).add(batch.mirrored);
            if (looks) {
                hash.add(context.scene.material_content(batch));
                hash.add(content(batch_defines(batch.features, kind, context.blends,
                                               context.scene.source().from_blender)));
            }
        }
    }
    return hash.key();
}

ContentKey content(const PassContext& context, gpu::UniformArena::Slot slot) {
    return ContentHash().add_all(context.uniforms.bytes(slot)).key();
}

ContentKey camera_content(const PassContext& context) {
    gpu::FrameUniforms frame{};
    std::memcpy(&frame, context.uniforms.bytes(context.frame).data(), sizeof(frame));
    return ContentHash()
        .add(frame.render_from_clip)
        .add(frame.camera_position)
        .add(frame.camera_forward)
        .add(frame.size.x)
        .add(frame.size.y)
        .add(frame.interpolation.z)
        .key();
}

ContentKey content(const gl::Defines& defines) {
    ContentHash hash;
    for (const auto& [name, value] : defines) {
        hash.add_text(name).add_text(value);
    }
    return hash.key();
}

gl::Defines light_defines(const LightPass& light) {
    return {{"MAP_KIND", std::to_string(light.map_kind)}, {"PROFILE", std::to_string(light.profile)}};
}

void draw_scene(const PassContext& context, const View& view, DrawKind kind, const std::string& fragment,
                const gl::Defines& defines, gpu::Geometry geometry) {
    context.uniforms.bind(UBO_VIEW, view.uniforms);
    draw_batches(context, &view, view.mirrored, kind, fragment, defines, geometry);
}

void draw_batches(const PassContext& context, bool mirrored, DrawKind kind, const std::string& fragment,
                  const gl::Defines& defines, gpu::Geometry geometry) {
    draw_batches(context, nullptr, mirrored, kind, fragment, defines, geometry);
}

void dispatch_2d(int width, int height) {
    glDispatchCompute(static_cast<GLuint>((width + GROUP_2D - 1) / GROUP_2D),
                      static_cast<GLuint>((height + GROUP_2D - 1) / GROUP_2D), 1);
}

void dispatch_1d(int threads) {
    const int groups = (threads + GROUP_1D - 1) / GROUP_1D;
    glDispatchCompute(static_cast<GLuint>(std::min(groups, MOST_GROUPS)),
                      static_cast<GLuint>((groups + MOST_GROUPS - 1) / MOST_GROUPS), 1);
}

void finish_writes() {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_FRAMEBUFFER_BARRIER_BIT);
}

}  // namespace bounce::passes
