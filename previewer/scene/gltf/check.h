// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace bounce::scene::gltf {

// Refuses JSON whose properties have the wrong type, lie outside their range or refer to something that
// is not there, so that whatever reads it later need not ask again. Numbers written as 1.0 where an
// integer belongs are made integers.
void check_structure(nlohmann::json& root);

}  // namespace bounce::scene::gltf
