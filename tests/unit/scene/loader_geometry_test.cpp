// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

TEST(LoaderGeometry, TriangleGetsAFlatNormal) {
    GltfBuilder builder;
    builder.triangle_node();
    const Scene scene = builder.load().scene;
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Primitive& primitive = scene.meshes[0].primitives.at(0);
    EXPECT_EQ(primitive.positions.size(), 3U);
    EXPECT_EQ(primitive.indices, (std::vector<uint32_t>{0, 1, 2}));
    for (const glm::vec3& normal : primitive.normals) {
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    }
    EXPECT_EQ(primitive.material, k_none);
    EXPECT_EQ(scene.name, "scene.glb");
}

// Two triangles that share an edge and no normals: every stream is split alike.
TEST(LoaderGeometry, FlatNormalsSplitEveryStream) {
    GltfBuilder builder;
    const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1}, "VEC3");
    const int uv = builder.accessor<float>({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
    const int joints = builder.accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0}, "VEC4");
    const int weights = builder.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int deltas = builder.accessor<float>({0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3}, "VEC3");
    const int indices = builder.accessor<uint16_t>({0, 1, 2, 1, 3, 2}, "SCALAR");
    builder.node({{"mesh", builder.add("meshes", {{"primitives",
                                                   {{{"attributes",
                                                      {{"POSITION", positions},
                                                       {"TEXCOORD_0", uv},
                                                       {"JOINTS_0", joints},
                                                       {"WEIGHTS_0", weights}}},
                                                     {"targets", {{{"POSITION", deltas}}}},
                                                     {"indices", indices}}}}})}});
    const Primitive primitive = builder.load().scene.meshes[0].primitives.at(0);
    ASSERT_EQ(primitive.positions.size(), 6U);
    ASSERT_EQ(primitive.uv0.size(), 6U);
    ASSERT_EQ(primitive.joints.size(), 6U);
    ASSERT_EQ(primitive.targets.at(0).positions.size(), 6U);
    const std::vector<uint16_t> old{0, 1, 2, 1, 3, 2};
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(primitive.joints[i].x, old[i]);
        EXPECT_EQ(primitive.targets[0].positions[i].z, static_cast<float>(old[i]));
        EXPECT_EQ(primitive.indices[i], i);
    }
    EXPECT_NEAR(glm::dot(primitive.normals[3], glm::normalize(glm::vec3(-1, -1, 1))), 1.0F, 1e-6F);
}

TEST(LoaderGeometry, StripsAndFansKeepTheirWinding) {
    // A strip over a square: 0 1 2, then 1 3 2. A fan: 1 2 0, then 2 3 0.
    const std::vector<std::pair<int, std::vector<float>>> cases{{5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}},
                                                                {6, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}}};
    for (const auto& [mode, corners] : cases) {
        GltfBuilder builder;
        const int positions = builder.accessor<float>(corners, "VEC3");
        builder.node(
            {{"mesh",
              builder.add("meshes",
                          {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}})}});
        const Primitive primitive = builder.load().scene.meshes[0].primitives.at(0);
        ASSERT_EQ(primitive.indices.size(), 6U) << mode;
        for (const glm::vec3& normal : primitive.normals) {
            EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << mode;
        }
    }
}

TEST(LoaderGeometry, PointsAndLinesAreDroppedWithAWarning) {
    GltfBuilder builder;
    builder.triangle_node();
    builder.root["meshes"][0]["primitives"][0]["mode"] = 0;
    const LoadResult result = builder.load();
    EXPECT_TRUE(result.scene.meshes[0].primitives.empty());
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_TRUE(says(result.warnings[0], "points and lines"));
}

TEST(LoaderGeometry, NormalisedIntegersFollowTheSpecification) {
    GltfBuilder builder;
    builder.triangle_node();
    const int colors = builder.accessor<uint8_t>({255, 0, 51, 255, 0, 51, 255, 0, 51}, "VEC3", true);
    const int normals = builder.accessor<int8_t>({0, 0, 127, 0, 0, 127, 0, 0, -128}, "VEC3", true);
    // 9 bytes a list, so elements are three bytes apart: legal for tightly packed data in tests only.
    json& attributes = builder.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = colors;
    attributes["NORMAL"] = normals;
    const int uv = builder.accessor<uint16_t>({0, 65535, 65535, 0, 13107, 0}, "VEC2", true);
    attributes["TEXCOORD_0"] = uv;
    const Primitive primitive = builder.load().scene.meshes[0].primitives.at(0);
    EXPECT_EQ(primitive.colors[0], glm::vec4(1.0F, 0.0F, 0.2F, 1.0F));
    EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(primitive.normals[2], glm::vec3(0, 0, -1));  // -128 is -1 too
    EXPECT_EQ(primitive.uv0[0], glm::vec2(0, 1));
    EXPECT_FLOAT_EQ(primitive.uv0[2].x, 0.2F);
}

TEST(LoaderGeometry, QuantisedPositionsAreReadAsTheyAre) {
    GltfBuilder builder;
    builder.use_extension("KHR_mesh_quantization");
    const int positions = builder.accessor<int16_t>({0, 0, 0, 100, 0, 0, 0, -100, 0}, "VEC3");
    builder.node(
        {{"mesh", builder.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}})}});
    const LoadResult result = builder.load();
    EXPECT_EQ(result.scene.meshes[0].primitives.at(0).positions[2], glm::vec3(0, -100, 0));
    EXPECT_TRUE(result.warnings.empty());
}

TEST(LoaderGeometry, InterleavedAndSparse) {
    GltfBuilder builder;
    // Position and colour interleaved: a stride of 24 bytes.
    const std::vector<float> interleaved{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1};
    const int view = builder.view(interleaved.data(), interleaved.size() * sizeof(float));
    builder.root["bufferViews"][static_cast<size_t>(view)]["byteStride"] = 24;
    const int positions = builder.add(
        "accessors", {{"bufferView", view}, {"componentType", k_float}, {"count", 3}, {"type", "VEC3"}});
    const int colors = builder.add("accessors", {{"bufferView", view},
                                                 {"byteOffset", 12},
                                                 {"componentType", k_float},
                                                 {"count", 3},
                                                 {"type", "VEC3"}});
    const std::vector<uint16_t> which{2};
    const std::vector<float> value{0, 5, 0};
    const int indices = builder.view(which.data(), 2);
    const int values = builder.view(value.data(), 12);
    builder.root["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", k_unsigned_short}}},
        {"values", {{"bufferView", values}}}};
    // All zeros but one, without a buffer view.
    const int deltas = builder.add("accessors", {{"componentType", k_float}, {"count", 3}, {"type", "VEC3"}});
    builder.root["accessors"][static_cast<size_t>(deltas)]["sparse"] =
        builder.root["accessors"][static_cast<size_t>(positions)]["sparse"];
    builder.node(
        {{"mesh", builder.add("meshes", {{"primitives",
                                          {{{"attributes", {{"POSITION", positions}, {"COLOR_0", colors}}},
                                            {"targets", {{{"POSITION", deltas}}}}}}}})}});
    const Primitive primitive = builder.load().scene.meshes[0].primitives.at(0);
    EXPECT_EQ(primitive.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(primitive.positions[2], glm::vec3(0, 5, 0));
    EXPECT_EQ(primitive.colors[1], glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(primitive.targets[0].positions[1], glm::vec3(0.0F));
    EXPECT_EQ(primitive.targets[0].positions[2], glm::vec3(0, 5, 0));
}

TEST(LoaderGeometry, UnusedVerticesAreDropped) {
    GltfBuilder builder;
    const int positions = builder.accessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 8, 8, 8, 0, 1, 0}, "VEC3");
    const int normals = builder.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1}, "VEC3");
    const int indices = builder.accessor<uint32_t>({4, 1, 2}, "SCALAR");
    builder.node(
        {{"mesh", builder.add("meshes", {{"primitives",
                                          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                            {"indices", indices}}}}})}});
    const Primitive primitive = builder.load().scene.meshes[0].primitives.at(0);
    EXPECT_EQ(primitive.positions,
              (std::vector<glm::vec3>{glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}));
    EXPECT_EQ(primitive.indices, (std::vector<uint32_t>{2, 0, 1}));
    EXPECT_EQ(primitive.normals.size(), 3U);
}

TEST(LoaderGeometry, FourStrongestInfluencesRenormalised) {
    GltfBuilder builder;
    builder.triangle_node();
    const std::vector<uint8_t> joints{0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<uint8_t> more{4, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    json& attributes = builder.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.accessor<uint8_t>(joints, "VEC4");
    attributes["JOINTS_1"] = builder.accessor<uint8_t>(more, "VEC4");
    attributes["WEIGHTS_0"] =
        builder.accessor<float>({0.1F, 0.2F, 0.05F, 0.05F, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] = builder.accessor<float>({0.4F, 0.2F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    const LoadResult result = builder.load();
    const Primitive& primitive = result.scene.meshes[0].primitives.at(0);
    EXPECT_EQ(primitive.joints[0], glm::u16vec4(4, 1, 5, 0));
    EXPECT_NEAR(primitive.weights[0].x, 0.4F / 0.9F, 1e-6F);
    EXPECT_NEAR(primitive.weights[0].w, 0.1F / 0.9F, 1e-6F);
    EXPECT_EQ(primitive.weights[1], glm::vec4(1, 0, 0, 0));  // made to sum to one
    EXPECT_EQ(primitive.weights[2], glm::vec4(1, 0, 0, 0));  // no influence at all: the first joint's
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_TRUE(says(result.warnings[0], "four"));
}

// A square in the xy plane with a picture the right way round: u to the right, v downwards.
TEST(LoaderGeometry, TangentsOnlyForNormalTextures) {
    GltfBuilder builder;
    const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
    const int normals = builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int uv = builder.accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    const int mirrored = builder.accessor<float>({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
    const int indices = builder.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    const std::vector<uint8_t> png{
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
        0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
        0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x00, 0x00, 0x00, 0x82, 0x00, 0x81,
        0x77, 0xcd, 0x72, 0xb6, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    builder.add("images", {{"bufferView", builder.view(png.data(), png.size())}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", 0}});
    const int mapped = builder.add("materials", {{"normalTexture", {{"index", 0}}}});
    const int plain = builder.add("materials", json::object());
    for (const auto& [coordinates, material] : {std::pair{uv, mapped}, {mirrored, mapped}, {uv, plain}}) {
        builder.node(
            {{"mesh",
              builder.add("meshes",
                          {{"primitives",
                            {{{"attributes",
                               {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", coordinates}}},
                              {"material", material},
                              {"indices", indices}}}}})}});
    }
    const Scene scene = builder.load().scene;
    EXPECT_EQ(scene.meshes[0].primitives.at(0).tangents.at(0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(scene.meshes[1].primitives.at(0).tangents.at(0), glm::vec4(-1, 0, 0, -1));
    EXPECT_TRUE(scene.meshes[2].primitives.at(0).tangents.empty());
}

TEST(LoaderGeometry, EmbeddedAndExternalBuffersWithEscapedNames) {
    GltfBuilder builder;
    builder.triangle_node();
    const TemporaryFolder folder;
    EXPECT_EQ(load_gltf(folder.write("embedded.gltf", builder.gltf())).scene.meshes.size(), 1U);

    json external = builder.root;
    external["buffers"] = {{{"byteLength", builder.binary().size()}, {"uri", "my%20data%25.bin"}}};
    folder.write("my data%.bin", builder.binary());
    const Scene scene = load_gltf(folder.write("external.gltf", external.dump())).scene;
    EXPECT_EQ(scene.meshes[0].primitives.at(0).positions[1], glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace bounce::scene::test
