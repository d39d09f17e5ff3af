// SPDX-License-Identifier: Apache-2.0
//
// What settings with a few values are called: on the command line, in statistics and in messages.
#pragma once

#include <map>
#include <string>

#include "renderer/settings.h"

namespace bounce {

// For Technique, Visibility, Shading, VplSampling, Importance, WorldSampling, BounceSource, AvgHits,
// AvgPaths, MapProjection, DirectShadows, Splat, PullPush, Forced, Show and passes::RsmPattern.
template <typename T>
[[nodiscard]] const std::map<std::string, T>& setting_names();

template <typename T>
[[nodiscard]] std::string name_of(T value) {
    for (const auto& [name, named] : setting_names<T>()) {
        if (named == value) {
            return name;
        }
    }
    return {};
}

template <>
[[nodiscard]] const std::map<std::string, Technique>& setting_names<Technique>();
template <>
[[nodiscard]] const std::map<std::string, Visibility>& setting_names<Visibility>();
template <>
[[nodiscard]] const std::map<std::string, Shading>& setting_names<Shading>();
template <>
[[nodiscard]] const std::map<std::string, VplSampling>& setting_names<VplSampling>();
template <>
[[nodiscard]] const std::map<std::string, Importance>& setting_names<Importance>();
template <>
[[nodiscard]] const std::map<std::string, WorldSampling>& setting_names<WorldSampling>();
template <>
[[nodiscard]] const std::map<std::string, BounceSource>& setting_names<BounceSource>();
template <>
[[nodiscard]] const std::map<std::string, AvgHits>& setting_names<AvgHits>();
template <>
[[nodiscard]] const std::map<std::string, AvgPaths>& setting_names<AvgPaths>();
template <>
[[nodiscard]] const std::map<std::string, MapProjection>& setting_names<MapProjection>();
template <>
[[nodiscard]] const std::map<std::string, DirectShadows>& setting_names<DirectShadows>();
template <>
[[nodiscard]] const std::map<std::string, Splat>& setting_names<Splat>();
template <>
[[nodiscard]] const std::map<std::string, PullPush>& setting_names<PullPush>();
template <>
[[nodiscard]] const std::map<std::string, Forced>& setting_names<Forced>();
template <>
[[nodiscard]] const std::map<std::string, Show>& setting_names<Show>();
template <>
[[nodiscard]] const std::map<std::string, passes::RsmPattern>& setting_names<passes::RsmPattern>();

}  // namespace bounce
