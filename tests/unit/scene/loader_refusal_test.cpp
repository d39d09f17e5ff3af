// SPDX-License-Identifier: Apache-2.0
//
// Everything that must be refused with one sentence that names the file and the cause.
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "gltf_builder.h"

namespace bounce::scene::test {
namespace {

using nlohmann::json;

TEST(LoaderRefusal, FilesThatAreNoGltf) {
    const TemporaryFolder folder;
    const auto expect = [&](const std::string& name, const std::string& text, const std::string& cause) {
        const std::string message = refusal_of(folder.write(name, text));
        EXPECT_TRUE(says(message, cause)) << name << ": " << message;
        EXPECT_TRUE(says(message, name)) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    EXPECT_TRUE(says(refusal_of(folder.path() / "missing.glb"), "does not exist"));
    EXPECT_TRUE(says(refusal_of(folder.path()), "is not a regular file"));
    expect("empty.glb", "", "is empty");
    expect("text.gltf", "hello", "neither binary glTF nor JSON");
    expect("list.gltf", "[]", "neither binary glTF nor JSON");
    expect("broken.gltf", "{\"asset\":", "its JSON cannot be read: it breaks off at line 1, column 10");
    expect("other.gltf", "{\"a\": 1}", "no asset.version");
    expect("old.gltf", R"({"asset": {"version": "1.0"}})", "version \"1.0\"");
    expect("new.gltf", R"({"asset": {"version": "2.1", "minVersion": "2.1"}})", "needs glTF");
    expect("short.glb", "glTF", "truncated");
    expect("deep.gltf", "{\"asset\":" + std::string(100000, '['), "levels deep");
    expect("overflow.gltf", R"({"asset": {"version": "2.0"}, "x": 1e999})",
           "its JSON cannot be read: the number 1e999 in it is too large");
    expect("latin.gltf", "{\"asset\": {\"version\": \"2.0\", \"generator\": \"\xff\"}}",
           "its JSON cannot be read: it is no valid JSON at line 1, column 44");
}

TEST(LoaderRefusal, TruncatedAnywhere) {
    GltfBuilder builder;
    builder.triangle_node();
    const std::vector<uint8_t> whole = builder.glb();
    const TemporaryFolder folder;
    for (size_t length = 0; length < whole.size(); ++length) {
        const auto path = folder.write(
            "cut.glb",
            std::vector<uint8_t>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
        EXPECT_FALSE(refusal_of(path).empty()) << length;
    }
}

struct Fault {
    std::string name;
    std::function<void(GltfBuilder&)> make;
    std::string cause;
};

void PrintTo(const Fault& fault, std::ostream* out) {
    *out << fault.name;
}

class LoaderRefusalOf : public testing::TestWithParam<Fault> {};

// A triangle with indices, normals, a skin, a morph target and an animation: the faults are put in one
// by one.
GltfBuilder valid_file() {
    GltfBuilder builder;
    const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");                   // 0
    const int indices = builder.accessor<uint16_t>({0, 1, 2}, "SCALAR");                                  // 1
    const int joints = builder.accessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");           // 2
    const int weights = builder.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");            // 3
    const int deltas = builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");                      // 4
    const int binds = builder.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");  // 5
    const int times = builder.accessor<float>({0, 1}, "SCALAR");                                          // 6
    const int values = builder.accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3");                               // 7
    builder.add("meshes",
                {{"primitives",
                  {{{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                    {"targets", {{{"POSITION", deltas}}}},
                    {"indices", indices}}}}});
    builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
    builder.add("materials", json::object());
    const int joint = builder.node(json::object());
    builder.add("skins", {{"joints", {joint}}, {"inverseBindMatrices", binds}});
    builder.node({{"mesh", 0}, {"skin", 0}});
    builder.add("animations",
                {{"samplers", {{{"input", times}, {"output", values}}}},
                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    return builder;
}

TEST_P(LoaderRefusalOf, Fault) {
    GltfBuilder builder = valid_file();
    GetParam().make(builder);
    const std::string message = builder.refusal();
    EXPECT_TRUE(says(message, GetParam().cause)) << message;
    EXPECT_TRUE(says(message, "scene.glb cannot be loaded: ")) << message;
}

TEST(LoaderRefusal, TheFileWithoutFaultsLoads) {
    EXPECT_EQ(valid_file().refusal(), "");
}

json& primitive(GltfBuilder& builder) {
    return builder.root["meshes"][0]["primitives"][0];
}

json& accessor(GltfBuilder& builder, int index) {
    return builder.root["accessors"][static_cast<size_t>(index)];
}

void animate(GltfBuilder& builder, const std::vector<float>& times, const std::vector<float>& values) {
    builder.root["animations"][0]["samplers"][0]["input"] = builder.accessor<float>(times, "SCALAR");
    builder.root["animations"][0]["samplers"][0]["output"] = builder.accessor<float>(values, "VEC3");
}

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    All, LoaderRefusalOf,
    testing::Values(
        Fault{"RequiredExtension",
              [](GltfBuilder& b) { b.root["extensionsRequired"] = {"KHR_texture_basisu"}; },
              "requires the extension KHR_texture_basisu"},
        Fault{"AccessorPastItsView", [](GltfBuilder& b) { accessor(b, 0)["count"] = 4; },
              "accessor 0 needs 48 bytes"},
        Fault{"AccessorOffset", [](GltfBuilder& b) { accessor(b, 0)["byteOffset"] = 4; },
              "accessor 0 needs 36 bytes"},
        Fault{"HugeOffset", [](GltfBuilder& b) { accessor(b, 0)["byteOffset"] = 9007199254740991; },
              "accessor 0 needs"},
        Fault{"NegativeOffset", [](GltfBuilder& b) { accessor(b, 0)["byteOffset"] = -4; }, "outside"},
        Fault{"HugeCount", [](GltfBuilder& b) { accessor(b, 0)["count"] = 4000000000U; },
              "accessors/0/count"},
        Fault{"ZeroCount", [](GltfBuilder& b) { accessor(b, 0)["count"] = 0; }, "accessors/0/count is 0"},
        Fault{"FractionalCount", [](GltfBuilder& b) { accessor(b, 0)["count"] = 2.5; }, "not an integer"},
        Fault{"WrongType", [](GltfBuilder& b) { accessor(b, 0)["type"] = "VEC2"; },
              "accessor 0 has 2 numbers"},
        Fault{"UnknownType", [](GltfBuilder& b) { accessor(b, 0)["type"] = "VEC9"; }, "VEC9"},
        Fault{"ComponentType", [](GltfBuilder& b) { accessor(b, 0)["componentType"] = 5124; },
              "component type 5124"},
        Fault{"FloatIndices", [](GltfBuilder& b) { primitive(b)["indices"] = 6; }, "floats where integers"},
        Fault{"IndexOutOfRange",
              [](GltfBuilder& b) {
                  primitive(b)["indices"] = b.accessor<uint16_t>({0, 1, 3}, "SCALAR");
              },
              "refers to vertex 3"},
        Fault{"NanPosition",
              [](GltfBuilder& b) {
                  primitive(b)["attributes"]["POSITION"] =
                      b.accessor<float>({0, 0, 0, 1, 0, 0, 0, k_nan, 0}, "VEC3");
              },
              "positions that are not finite"},
        Fault{"InfiniteMorph",
              [](GltfBuilder& b) {
                  primitive(b)["targets"][0]["POSITION"] = b.accessor<float>(
                      {0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::infinity(), 0}, "VEC3");
              },
              "morph target"},
        Fault{"AttributeCount",
              [](GltfBuilder& b) {
                  primitive(b)["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC3");
              },
              "but 2 of NORMAL"},
        Fault{"MorphCount",
              [](GltfBuilder& b) {
                  primitive(b)["targets"][0]["POSITION"] = b.accessor<float>({0, 0, 1}, "VEC3");
              },
              "morph target"},
        Fault{"MorphTargetsDiffer",
              [](GltfBuilder& b) {
                  b.root["meshes"][0]["primitives"].push_back(primitive(b));
                  b.root["meshes"][0]["primitives"][1].erase("targets");
              },
              "different numbers of morph targets"},
        Fault{"WeightCount",
              [](GltfBuilder& b) {
                  b.root["meshes"][0]["weights"] = {1, 2, 3};
              },
              "3 weights for 1 morph targets"},
        Fault{"NodeWeightCount",
              [](GltfBuilder& b) {
                  b.root["nodes"][1]["weights"] = {1, 2};
              },
              "has 2 weights"},
        Fault{"SparseIndexOutOfRange",
              [](GltfBuilder& b) {
                  const std::vector<uint8_t> which{3};
                  const std::vector<float> value{0, 0, 0};
                  accessor(b, 0)["sparse"] = {
                      {"count", 1},
                      {"indices",
                       {{"bufferView", b.view(which.data(), 1)}, {"componentType", k_unsigned_byte}}},
                      {"values", {{"bufferView", b.view(value.data(), 12)}}}};
              },
              "replaces element 3 of 3"},
        Fault{"SparseCount",
              [](GltfBuilder& b) {
                  const std::vector<uint8_t> which{0, 1, 2, 0};
                  const std::vector<float> value(12);
                  accessor(b, 0)["sparse"] = {
                      {"count", 4},
                      {"indices",
                       {{"bufferView", b.view(which.data(), 4)}, {"componentType", k_unsigned_byte}}},
                      {"values", {{"bufferView", b.view(value.data(), 48)}}}};
              },
              "replaces 4 of its 3"},
        Fault{"ZeroBomb",
              [](GltfBuilder& b) {
                  accessor(b, 0).erase("bufferView");
                  accessor(b, 0)["count"] = 100000000;
              },
              "no buffer view"},
        Fault{"ViewPastBuffer", [](GltfBuilder& b) { b.root["bufferViews"][0]["byteLength"] = 100000; },
              "reads past the end of buffer 0"},
        Fault{"ViewOffset", [](GltfBuilder& b) { b.root["bufferViews"][0]["byteOffset"] = 9007199254740990; },
              "reads past the end of buffer 0"},
        Fault{"NegativeView", [](GltfBuilder& b) { b.root["bufferViews"][0]["byteLength"] = -1; }, "outside"},
        Fault{"SmallStride", [](GltfBuilder& b) { b.root["bufferViews"][0]["byteStride"] = 8; },
              "stride of 8"},
        Fault{"ShortBuffer",
              [](GltfBuilder& b) {
                  b.root["buffers"] = {{{"byteLength", 100000}}};
              },
              "buffer 0 is truncated"},
        Fault{"MissingBuffer",
              [](GltfBuilder& b) {
                  b.root["buffers"] = {{{"byteLength", 4}, {"uri", "gone.bin"}}};
              },
              "gone.bin does not exist"},
        Fault{"RemoteBuffer",
              [](GltfBuilder& b) {
                  b.root["buffers"] = {{{"byteLength", 4}, {"uri", "https://example.org/a.bin"}}};
              },
              "only files beside the scene"},
        Fault{
            "BadBase64",
            [](GltfBuilder& b) {
                b.root["buffers"] = {{{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,A!"}}};
            },
            "not valid base64"},
        Fault{"NoSuchAccessor", [](GltfBuilder& b) { primitive(b)["attributes"]["POSITION"] = 99; },
              "accessors 99"},
        Fault{"NegativeIndex", [](GltfBuilder& b) { b.root["nodes"][1]["mesh"] = -1; }, "meshes -1"},
        Fault{"NoSuchMaterial", [](GltfBuilder& b) { primitive(b)["material"] = 1; }, "materials 1"},
        Fault{"NoSuchBuffer", [](GltfBuilder& b) { b.root["bufferViews"][0]["buffer"] = 1; }, "buffers 1"},
        Fault{"Cycle",
              [](GltfBuilder& b) {
                  b.node({{"children", {3}}}, false);
                  b.node({{"children", {2}}}, false);
              },
              "cyclic"},
        Fault{"OwnChild",
              [](GltfBuilder& b) {
                  b.node({{"children", {2}}}, false);
              },
              "cyclic"},
        Fault{"TwoParents",
              [](GltfBuilder& b) {
                  b.node({{"children", {0}}}, false);
                  b.node({{"children", {0}}}, false);
              },
              "node 0 has two parents, 2 and 3"},
        Fault{"RootWithParent",
              [](GltfBuilder& b) {
                  b.node({{"children", {0}}});
              },
              "not a root"},
        Fault{"RootTwice", [](GltfBuilder& b) { b.root["scenes"][0]["nodes"].push_back(0); },
              "lists node 0 twice"},
        Fault{"Matrix",
              [](GltfBuilder& b) {
                  b.root["nodes"][0]["matrix"] = {1, 2};
              },
              "16 numbers"},
        Fault{"TextScale",
              [](GltfBuilder& b) {
                  b.root["nodes"][0]["scale"] = {1, "a", 1};
              },
              "not a finite number"},
        Fault{"JointOutOfRange",
              [](GltfBuilder& b) {
                  primitive(b)["attributes"]["JOINTS_0"] =
                      b.accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
              },
              "refers to joint 1"},
        Fault{"JointsWithoutWeights", [](GltfBuilder& b) { primitive(b)["attributes"].erase("WEIGHTS_0"); },
              "without the other"},
        Fault{"BindMatrices",
              [](GltfBuilder& b) {
                  b.root["skins"][0]["joints"] = {0, 1};
              },
              "inverse bind matrices"},
        Fault{"NoJoints", [](GltfBuilder& b) { b.root["skins"][0]["joints"] = json::array(); },
              "has 0 joints"},
        Fault{"SamplerIndex", [](GltfBuilder& b) { b.root["animations"][0]["channels"][0]["sampler"] = 7; },
              "refers to sampler 7"},
        Fault{"BackInTime",
              [](GltfBuilder& b) {
                  animate(b, {1, 0}, {0, 0, 0, 1, 1, 1});
              },
              "back in time"},
        Fault{"NanTime",
              [](GltfBuilder& b) {
                  animate(b, {0, k_nan}, {0, 0, 0, 1, 1, 1});
              },
              "not finite"},
        Fault{"KeyCount",
              [](GltfBuilder& b) {
                  animate(b, {0, 1, 2}, {0, 0, 0, 1, 1, 1});
              },
              "6 numbers for 3 keys"},
        Fault{"Interpolation",
              [](GltfBuilder& b) { b.root["animations"][0]["samplers"][0]["interpolation"] = "MAGIC"; },
              "MAGIC"},
        Fault{"PointerToNothing",
              [](GltfBuilder& b) {
                  b.root["animations"][0]["channels"][0]["target"] = {
                      {"path", "pointer"},
                      {"extensions",
                       {{"KHR_animation_pointer", {{"pointer", "/materials/9/emissiveFactor"}}}}}};
              },
              "/materials/9/emissiveFactor, which is not there"},
        Fault{"FieldOfViewOfZero", [](GltfBuilder& b) { b.root["cameras"][0]["perspective"]["yfov"] = 0; },
              "cameras/0/perspective/yfov"},
        Fault{"CameraType", [](GltfBuilder& b) { b.root["cameras"][0]["type"] = "fisheye"; }, "fisheye"},
        Fault{"FarBeforeNear", [](GltfBuilder& b) { b.root["cameras"][0]["perspective"]["zfar"] = 0.01; },
              "far plane"},
        Fault{"DracoGarbage",
              [](GltfBuilder& b) {
                  const std::vector<uint8_t> garbage(64, 0x5A);
                  primitive(b)["extensions"]["KHR_draco_mesh_compression"] = {
                      {"bufferView", b.view(garbage.data(), garbage.size())},
                      {"attributes", {{"POSITION", 0}}}};
              },
              "Draco data"},
        Fault{"MeshoptGarbage",
              [](GltfBuilder& b) {
                  b.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
                      {"buffer", 0},      {"byteOffset", 0}, {"byteLength", 36},
                      {"byteStride", 12}, {"count", 3},      {"mode", "ATTRIBUTES"}};
              },
              "cannot be decompressed"},
        Fault{"MeshoptBomb",
              [](GltfBuilder& b) {
                  b.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
                      {"buffer", 0},       {"byteOffset", 0},    {"byteLength", 36},
                      {"byteStride", 256}, {"count", 200000000}, {"mode", "ATTRIBUTES"}};
              },
              "not believable"},
        Fault{"InstanceCounts",
              [](GltfBuilder& b) {
                  const int three = b.accessor<float>({0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
                  const int one = b.accessor<float>({1, 1, 1}, "VEC3");
                  b.root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
                      {"TRANSLATION", three}, {"SCALE", one}};
              },
              "3 and 1 attributes"},
        Fault{"LightType",
              [](GltfBuilder& b) {
                  b.root["extensions"]["BOUNCE_scene"] = {{"version", 1},
                                                          {"lights", json::array({json{{"type", "laser"}}})}};
              },
              "laser"},
        Fault{"PatternOfOtherSize",
              [](GltfBuilder& b) {
                  const json pattern{{"width", 2}, {"height", 2}, {"rgb", {1, 1, 1}}};
                  b.root["extensions"]["BOUNCE_scene"] = {
                      {"version", 1},
                      {"lights", json::array({json{{"type", "area"}, {"pattern", pattern}}})}};
              },
              "pattern of 2 x 2 with 3 numbers"},
        Fault{"PatternBelowZero",
              [](GltfBuilder& b) {
                  const json pattern{{"width", 1}, {"height", 1}, {"rgb", {1, -1, 1}}};
                  b.root["extensions"]["BOUNCE_scene"] = {
                      {"version", 1},
                      {"lights", json::array({json{{"type", "area"}, {"pattern", pattern}}})}};
              },
              "values below 0"},
        Fault{"FramesBackwards",
              [](GltfBuilder& b) {
                  b.root["extensions"]["BOUNCE_scene"] = {
                      {"version", 1}, {"frames", {{"start", 5}, {"end", 1}, {"fps", 24}}}};
              },
              "before it starts"},
        Fault{"ListIsNoList", [](GltfBuilder& b) { b.root["nodes"] = 5; }, "nodes is not a list"},
        Fault{"NodeIsNoObject", [](GltfBuilder& b) { b.root["nodes"][0] = "node"; },
              "nodes/0 is not an object"}),
    [](const testing::TestParamInfo<Fault>& fault) { return fault.param.name; });

TEST(LoaderRefusal, OddButUsableFilesLoad) {
    GltfBuilder builder = valid_file();
    builder.root["nodes"][0]["name"] = std::string(1000, '[') + "\\\"";  // no nesting
    builder.root["nodes"][0]["matrix"] = std::vector<float>(16, 0.0F);   // singular
    builder.root["nodes"][1]["scale"] = {1e-40, 1e-40, 1e-40};           // denormal
    EXPECT_EQ(builder.refusal(), "");
}

}  // namespace
}  // namespace bounce::scene::test
