// SPDX-License-Identifier: Apache-2.0
#include "passes/sphere_vpls.h"

#include "passes/float_layouts.h"
#include "passes/vpl_choice.h"

namespace bounce::passes {

VplSet add_vpls_from_sphere(FrameGraph& graph, const PassContext& context, const SphereSource& sphere,
                            VplSet set, const Drawing& drawing) {
    const int chosen_a_subset = set.subset - (sphere.has_suns && set.subset > 1 ? 1 : 0);
    const int chosen = set.maps / set.subset * chosen_a_subset;
    MapSource map;
    map.defines = with_lobes({{"SPHERE", "1"}}, context, drawing.glossy);
    map.size = sphere.width;
    map.rows = sphere.height;
    map.declare = [](PassBuilder&) {};
    map.content = ContentHash().add(content(context, sphere.uniforms)).add(sphere.content).key();
    map.bind = [context, sphere](const PassResources&) {
        context.uniforms.bind(UBO_SPHERE, sphere.uniforms);
        sphere.cells->bind_storage(SSBO_SPHERE);
    };
    const std::string of = ", world";
    const BufferHandle importance = add_vpl_importance(graph, context, {map}, drawing.view, chosen, of);
    const ImportanceTables tables = add_importance_sums(graph, context, {map}, importance, of, false);
    const VplSampling sampling = is_chosen(drawing.sampling) ? drawing.sampling : VplSampling::inverse2;
    const BufferHandle choices =
        add_vpl_choice(graph, context, {map}, tables, {sampling, chosen, drawing.steps, set.seed}, of);
    BufferHandle out;
    graph.add_pass("sphere vpls", [&](PassBuilder& builder) {
        builder.read(set.vpls);
        builder.read(choices);
        out = builder.create_buffer("world lights", static_cast<size_t>(set.maps) * sizeof(gpu::GpuVpl),
                                    k_vpl_floats);
        builder.decided_by(
            ContentHash().add(map.content).add(content(context, set)).add(chosen_a_subset).key());
        return [context, map, set, chosen_a_subset, choices, out](const PassResources& resources) {
            context.programs.compute("passes/sphere_vpls.comp").use();
            map.bind(resources);
            context.uniforms.bind(UBO_ISM, set.uniforms);
            resources.buffer(set.vpls).bind_storage(SSBO_VPLS);
            resources.buffer(choices).bind_storage(SSBO_VPL_CHOICES);
            resources.buffer(out).bind_storage(SSBO_VPLS_OUT);
            glUniform3i(0, set.maps, set.subset, chosen_a_subset);
            glUniform1ui(1, set.seed);
            dispatch_1d(set.maps);
            finish_writes();
        };
    });
    set.vpls = out;
    return set;
}

}  // namespace bounce::passes
