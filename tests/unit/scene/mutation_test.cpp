// SPDX-License-Identifier: Apache-2.0
//
// A valid file with a bit of everything, damaged at random: whatever comes of it, it is not a crash.
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "gltf_builder.h"
#include "scene/pose.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

GltfBuilder everything() {
    GltfBuilder builder;
    const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    const int normals =
        builder.accessor<int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC4", true);
    builder.root["accessors"][static_cast<size_t>(normals)]["type"] = "VEC3";
    builder.root["bufferViews"].back()["byteStride"] = 4;
    const int uv = builder.accessor<uint16_t>({0, 0, 65535, 0, 0, 65535, 65535, 65535}, "VEC2", true);
    const int colors = builder.accessor<uint8_t>(std::vector<uint8_t>(16, 200), "VEC4", true);
    const int joints = builder.accessor<uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int weights = builder.accessor<float>({1, 1, 0, 0, 1, 0, 0, 0, 1, 3, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int deltas = builder.accessor<float>(std::vector<float>(12, 0.5F), "VEC3");
    const int indices = builder.accessor<uint16_t>({0, 1, 2, 3}, "SCALAR");
    const std::vector<uint16_t> which{1, 2};
    const std::vector<float> values{1, 2, 3, 4, 5, 6};
    builder.root["accessors"][static_cast<size_t>(deltas)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", builder.view(which.data(), 4)}, {"componentType", k_unsigned_short}}},
        {"values", {{"bufferView", builder.view(values.data(), 24)}}}};
    builder.add(
        "images",
        {{"uri",
          "data:image/"
          "png;base64,"
          "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}});
    builder.add("textures", {{"source", 0}, {"sampler", 0}});
    builder.add("samplers", {{"wrapS", 33071}});
    builder.add("materials", {{"normalTexture", {{"index", 0}}},
                              {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.add("meshes", {{"primitives",
                            {{{"attributes",
                               {{"POSITION", positions},
                                {"NORMAL", normals},
                                {"TEXCOORD_0", uv},
                                {"COLOR_0", colors},
                                {"JOINTS_0", joints},
                                {"WEIGHTS_0", weights}}},
                              {"targets", {{{"POSITION", deltas}}}},
                              {"mode", 5},
                              {"material", 0},
                              {"indices", indices}}}}});
    const int binds = builder.accessor<float>(std::vector<float>(32, 1.0F), "MAT4");
    builder.node({{"name", "hip"}});
    builder.node({{"name", "knee"}, {"rotation", {0, 0, 0, 1}}}, false);
    builder.root["nodes"][0]["children"] = {1};
    builder.add("skins", {{"joints", {0, 1}}, {"inverseBindMatrices", binds}});
    builder.node({{"mesh", 0}, {"skin", 0}});
    const int places = builder.accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3");
    builder.node(
        {{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    builder.node({{"camera", 0}});
    builder.root["extensions"]["BOUNCE_scene"] = {
        {"version", 1},
        {"frames", {{"start", 1}, {"end", 10}, {"fps", 24}}},
        {"world", {{"color", {1, 1, 1}}, {"strength", 1}}},
        {"lights", json::array({json{{"type", "area"}, {"power_w", 10}, {"size_x_m", 1}, {"size_y_m", 1}}})}};
    builder.node({{"extensions", {{"BOUNCE_scene", {{"light", 0}}}}}});
    const int times = builder.accessor<float>({0, 1}, "SCALAR");
    const int turns = builder.accessor<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const int powers = builder.accessor<float>({0, 10}, "SCALAR");
    builder.add(
        "animations",
        {{"samplers", {{{"input", times}, {"output", turns}}, {{"input", times}, {"output", powers}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}},
           {{"sampler", 1},
            {"target",
             {{"path", "pointer"},
              {"extensions",
               {{"KHR_animation_pointer",
                 {{"pointer", "/extensions/BOUNCE_scene/lights/0/power_w"}}}}}}}}}}});
    return builder;
}

// Loads and, where that works, uses what was loaded.
bool survives(const TemporaryFolder& folder, const std::vector<uint8_t>& bytes) {
    try {
        const Scene scene = load_gltf(folder.write("damaged.glb", bytes)).scene;
        for (const double time_s : {0.0, 0.5}) {
            (void)world_bounds(scene, evaluate_pose(scene, time_s));
        }
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_refused) << error.what();
        return false;
    }
}

TEST(Mutation, TheUndamagedFileLoads) {
    const TemporaryFolder folder;
    EXPECT_EQ(everything().refusal(), "");
    EXPECT_TRUE(survives(folder, everything().glb()));
}

// Where the binary chunk starts, as the file's header says.
size_t binary_start(const std::vector<uint8_t>& glb) {
    return 20 + glb[12] + 256U * glb[13] + 65536U * glb[14] + 8;
}

TEST(Mutation, FlippedBytes) {
    const TemporaryFolder folder;
    const std::vector<uint8_t> whole = everything().glb();
    int loaded = 0;
    for (unsigned seed = 0; seed < 1500; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<uint8_t> bytes = whole;
        // Damage to the JSON seldom passes the parser, so half of the files keep theirs.
        const size_t start = seed % 2 == 0 ? 0 : binary_start(whole);
        for (auto flips = 1 + random() % 8; flips > 0; --flips) {
            bytes[start + random() % (bytes.size() - start)] = static_cast<uint8_t>(random());
        }
        loaded += survives(folder, bytes) ? 1 : 0;
    }
    EXPECT_GT(loaded, 100);
}

// Digits of the JSON changed into other digits: still JSON, but other indices, counts and offsets.
TEST(Mutation, ChangedNumbers) {
    const TemporaryFolder folder;
    const std::vector<uint8_t> whole = everything().glb();
    const size_t json_end = binary_start(whole) - 8;
    for (unsigned seed = 0; seed < 1500; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::vector<uint8_t> bytes = whole;
        for (auto changes = 1 + random() % 4; changes > 0;) {
            uint8_t& byte = bytes[20 + random() % (json_end - 20)];
            if (byte >= '0' && byte <= '9') {
                byte = static_cast<uint8_t>('0' + random() % 10);
                --changes;
            }
        }
        survives(folder, bytes);
    }
}

TEST(Mutation, Truncated) {
    const TemporaryFolder folder;
    const std::vector<uint8_t> whole = everything().glb();
    for (size_t length = 0; length < whole.size(); length += 7) {
        EXPECT_FALSE(survives(folder, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)}));
    }
}

}  // namespace
}  // namespace bounce::scene::test
