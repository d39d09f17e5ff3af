// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

// 2 x 1 pixels, RGBA, 8 bit: half transparent red, opaque green.
const std::vector<uint8_t> k_png{0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
                                 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x06,
                                 0x00, 0x00, 0x00, 0xf4, 0x22, 0x7f, 0x8a, 0x00, 0x00, 0x00, 0x11, 0x49, 0x44,
                                 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xd0, 0xc0, 0xf0, 0x9f, 0xe1,
                                 0x3f, 0x00, 0x0e, 0x7d, 0x03, 0x7e, 0xea, 0xf6, 0x93, 0xc0, 0x00, 0x00, 0x00,
                                 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

GltfBuilder textured_file() {
    GltfBuilder builder;
    builder.triangle_node();
    builder.add("images",
                {{"bufferView", builder.view(k_png.data(), k_png.size())}, {"mimeType", "image/png"}});
    builder.add("textures", {{"source", 0}});
    builder.root["meshes"][0]["primitives"][0]["material"] =
        builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return builder;
}

TEST(LoaderTexture, PixelsAreAsStored) {
    const Scene scene = textured_file().load().scene;
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].width, 2);
    EXPECT_EQ(scene.images[0].height, 1);
    // Alpha is not multiplied into the colour.
    EXPECT_EQ(scene.images[0].rgba8, (std::vector<uint8_t>{255, 0, 0, 128, 0, 255, 0, 255}));
    EXPECT_TRUE(scene.images[0].rgba16.empty());
    const Sampler& sampler = scene.textures.at(0).sampler;
    EXPECT_EQ(sampler.wrap_u, Wrap::repeat);
    EXPECT_TRUE(sampler.mipmaps);
}

TEST(LoaderTexture, DataUrisAndFiles) {
    const TemporaryFolder folder;
    for (const std::string& uri : {"data:image/png;base64," + base64(k_png), std::string("a%20b.png")}) {
        GltfBuilder builder = textured_file();
        builder.root["images"][0] = {{"uri", uri}};
        folder.write("a b.png", k_png);
        const Scene scene = load_gltf(folder.write("scene.glb", builder.glb())).scene;
        EXPECT_EQ(scene.images.at(0).rgba8.size(), 8U) << uri;
    }
}

TEST(LoaderTexture, SamplerAndTransform) {
    GltfBuilder builder = textured_file();
    builder.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9729}});
    builder.root["textures"][0]["sampler"] = 0;
    json& info = builder.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    info["texCoord"] = 0;
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 1.5707963}, {"texCoord", 1}};
    const Scene scene = builder.load().scene;
    const Sampler& sampler = scene.textures.at(0).sampler;
    EXPECT_EQ(sampler.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(sampler.wrap_v, Wrap::mirrored_repeat);
    EXPECT_EQ(sampler.magnify, Filter::nearest);
    EXPECT_EQ(sampler.minify, Filter::linear);
    EXPECT_FALSE(sampler.mipmaps);
    const TextureRef& ref = scene.materials[0].base_color_texture;
    EXPECT_EQ(ref.uv_set, 1);
    // Scaled to (2, 3), turned a quarter counter-clockwise as seen with v running down: (3, -2).
    const glm::vec3 moved = ref.uv_transform * glm::vec3(1, 1, 1);
    EXPECT_NEAR(moved.x, 3.5F, 1e-5F);
    EXPECT_NEAR(moved.y, -1.75F, 1e-5F);
}

TEST(LoaderTexture, UnusedImagesMayBeMissing) {
    GltfBuilder builder = textured_file();
    builder.add("images", {{"uri", "missing.png"}});
    builder.add("textures", {{"source", 1}});
    EXPECT_EQ(builder.load().scene.images.size(), 1U);
    builder.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    EXPECT_TRUE(says(builder.refusal(), "missing.png does not exist"));
}

TEST(LoaderTexture, SharedImagesAreDecodedOnce) {
    GltfBuilder builder = textured_file();
    builder.add("textures", {{"source", 0}});
    builder.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    const Scene scene = builder.load().scene;
    EXPECT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.textures.size(), 2U);
}

TEST(LoaderTexture, UnreadableImagesAreRefused) {
    GltfBuilder builder = textured_file();
    std::vector<uint8_t> broken = k_png;
    broken.resize(45);
    builder.root["images"][0] = {{"uri", "data:image/png;base64," + base64(broken)}};
    EXPECT_TRUE(says(builder.refusal(), "image 0 cannot be decoded"));
    builder.root["images"][0] = {{"uri", "data:image/png;base64,R0lGODlh"}};
    EXPECT_TRUE(says(builder.refusal(), "not a PNG, JPEG or WebP"));
    builder.root["images"][0] = json::object();
    EXPECT_TRUE(says(builder.refusal(), "neither a URI nor a buffer view"));
}

// An image header may claim any size.
TEST(LoaderTexture, HugeImagesAreRefusedBeforeTheyAreDecoded) {
    GltfBuilder builder = textured_file();
    const std::vector<uint8_t> huge{0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d,
                                    0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0xea, 0x60, 0x00, 0x00, 0xea, 0x60,
                                    0x08, 0x06, 0x00, 0x00, 0x00, 0x80, 0xd2, 0x75, 0x42, 0x00, 0x00, 0x00,
                                    0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x64, 0x62, 0x66,
                                    0x01, 0x00, 0x00, 0x19, 0x00, 0x0b, 0xe7, 0x5a, 0x46, 0xa4, 0x00, 0x00,
                                    0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    builder.root["images"][0] = {{"uri", "data:image/png;base64," + base64(huge)}};
    const std::string message = builder.refusal();
    EXPECT_TRUE(says(message, "60000 by 60000")) << message;
}

TEST(LoaderTexture, MoreThanTwoSetsOfCoordinates) {
    GltfBuilder builder = textured_file();
    builder.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
    const LoadResult result = builder.load();
    EXPECT_FALSE(result.scene.materials[0].base_color_texture.present());
    EXPECT_EQ(result.warnings.size(), 1U);
}

}  // namespace
}  // namespace bounce::scene::test
