// SPDX-License-Identifier: Apache-2.0
#include "renderer/setting_names.h"

namespace bounce {

template <>
const std::map<std::string, Technique>& setting_names<Technique>() {
    static const std::map<std::string, Technique> names = {
        {"direct", Technique::direct}, {"rsm", Technique::rsm}, {"ism", Technique::ism}};
    return names;
}

template <>
const std::map<std::string, Visibility>& setting_names<Visibility>() {
    static const std::map<std::string, Visibility> names = {{"none", Visibility::none},
                                                            {"ism", Visibility::ism},
                                                            {"shadow-maps", Visibility::shadow_maps},
                                                            {"simplified", Visibility::simplified}};
    return names;
}

template <>
const std::map<std::string, Shading>& setting_names<Shading>() {
    static const std::map<std::string, Shading> names = {{"deferred", Shading::deferred},
                                                         {"hybrid", Shading::hybrid}};
    return names;
}

template <>
const std::map<std::string, VplSampling>& setting_names<VplSampling>() {
    static const std::map<std::string, VplSampling> names = {
        {"inverse-transform", VplSampling::inverse_transform},
        {"uniform", VplSampling::uniform},
        {"uniform3", VplSampling::uniform3},
        {"inverse2", VplSampling::inverse2},
        {"inverse3", VplSampling::inverse3},
        {"metropolis", VplSampling::metropolis},
        {"metropolis-single", VplSampling::metropolis_single},
        {"metropolis-unreduced", VplSampling::metropolis_unreduced},
        {"resampled", VplSampling::resampled},
        {"avg", VplSampling::avg}};
    return names;
}

template <>
const std::map<std::string, Importance>& setting_names<Importance>() {
    static const std::map<std::string, Importance> names = {{"flux", Importance::flux},
                                                            {"view", Importance::view}};
    return names;
}

template <>
const std::map<std::string, WorldSampling>& setting_names<WorldSampling>() {
    static const std::map<std::string, WorldSampling> names = {{"parts", WorldSampling::parts},
                                                               {"drawn", WorldSampling::drawn}};
    return names;
}

template <>
const std::map<std::string, BounceSource>& setting_names<BounceSource>() {
    static const std::map<std::string, BounceSource> names = {
        {"points", BounceSource::points}, {"irsm", BounceSource::irsm}, {"avg", BounceSource::avg}};
    return names;
}

template <>
const std::map<std::string, AvgHits>& setting_names<AvgHits>() {
    static const std::map<std::string, AvgHits> names = {{"slabs", AvgHits::slabs},
                                                         {"voxels", AvgHits::voxels}};
    return names;
}

template <>
const std::map<std::string, AvgPaths>& setting_names<AvgPaths>() {
    static const std::map<std::string, AvgPaths> names = {{"roulette", AvgPaths::roulette},
                                                          {"fixed", AvgPaths::fixed}};
    return names;
}

template <>
const std::map<std::string, MapProjection>& setting_names<MapProjection>() {
    static const std::map<std::string, MapProjection> names = {{"faces", MapProjection::faces},
                                                               {"paraboloid", MapProjection::paraboloid}};
    return names;
}

template <>
const std::map<std::string, DirectShadows>& setting_names<DirectShadows>() {
    static const std::map<std::string, DirectShadows> names = {{"hard", DirectShadows::hard},
                                                               {"vpl", DirectShadows::vpl},
                                                               {"convolution", DirectShadows::convolution},
                                                               {"ism", DirectShadows::ism}};
    return names;
}

template <>
const std::map<std::string, Splat>& setting_names<Splat>() {
    static const std::map<std::string, Splat> names = {{"disks", Splat::disks},
                                                       {"compute", Splat::compute},
                                                       {"points", Splat::points},
                                                       {"tessellation", Splat::tessellation},
                                                       {"auto", Splat::automatic}};
    return names;
}

template <>
const std::map<std::string, PullPush>& setting_names<PullPush>() {
    static const std::map<std::string, PullPush> names = {
        {"off", PullPush::off}, {"fill", PullPush::fill}, {"paper", PullPush::paper}};
    return names;
}

template <>
const std::map<std::string, Forced>& setting_names<Forced>() {
    static const std::map<std::string, Forced> names = {
        {"nothing", Forced::nothing}, {"exact", Forced::exact}, {"all", Forced::all}};
    return names;
}

template <>
const std::map<std::string, Show>& setting_names<Show>() {
    static const std::map<std::string, Show> names = {{"shaded", Show::shaded},
                                                      {"direct", Show::direct},
                                                      {"indirect", Show::indirect},
                                                      {"rsm-depth", Show::rsm_depth},
                                                      {"rsm-position", Show::rsm_position},
                                                      {"rsm-normal", Show::rsm_normal},
                                                      {"rsm-flux", Show::rsm_flux},
                                                      {"importance", Show::importance},
                                                      {"interpolation", Show::interpolation},
                                                      {"vpls", Show::vpls},
                                                      {"ism-splats", Show::ism_splats},
                                                      {"ism", Show::ism},
                                                      {"vpl-visibility", Show::vpl_visibility},
                                                      {"unblurred", Show::unblurred},
                                                      {"removed", Show::removed},
                                                      {"motion", Show::motion},
                                                      {"avg", Show::avg}};
    return names;
}

template <>
const std::map<std::string, passes::RsmPattern>& setting_names<passes::RsmPattern>() {
    static const std::map<std::string, passes::RsmPattern> names = {
        {"inverse-square", passes::RsmPattern::inverse_square},
        {"uniform-radius", passes::RsmPattern::uniform_radius},
        {"paper-literal", passes::RsmPattern::paper_literal}};
    return names;
}

}  // namespace bounce
