// SPDX-License-Identifier: Apache-2.0
//
// Where things land in the picture: cameras, transforms, skins and morph targets on the GPU.
#include "render_fixture.h"

namespace bounce::test {
namespace {

class Geometry : public ::testing::Test {
  protected:
    void SetUp() override { require_context(); }

    static Settings settings(int size) {
        Settings s;
        s.width = s.height = size;
        s.technique = Technique::direct;
        s.antialias = false;  // shares of pixels are counted
        return s;
    }
    // Lit from everywhere alike: what is drawn is white, what is not is black.
    static scene::Scene lit_scene() {
        scene::Scene scene;
        scene.from_blender = true;
        scene::Light sun;
        sun.type = scene::LightType::sun;
        sun.irradiance_w_m2 = static_cast<float>(pi);
        sun.cast_shadow = false;
        add_light(scene, sun, glm::dmat4(1.0));
        return scene;
    }
    // Mean position of what is lit, in metres of a frame `width` wide, y up; and the lit share.
    struct Blob {
        double x, y, share;
    };
    static Blob blob(const Image& image, double width) {
        double x = 0.0;
        double y = 0.0;
        double count = 0.0;
        for (int j = 0; j < image.height; ++j) {
            for (int i = 0; i < image.width; ++i) {
                if (image.rgb[image.offset(i, j)] > 0.5F) {
                    x += (i + 0.5) / image.width - 0.5;
                    y += 0.5 - (j + 0.5) / image.height;
                    count += 1.0;
                }
            }
        }
        return {x / count * width, y / count * width,
                count / (static_cast<double>(image.width) * image.height)};
    }
};

TEST_F(Geometry, OrthographicCameraPlacesASquare) {
    scene::Scene scene = lit_scene();
    add_mesh_node(scene, add_square(scene, 1.0F, add_diffuse(scene)),
                  glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, -0.5, 0.0)));
    const Blob b = blob(draw(scene, camera_from_above(4.0, 10.0), settings(200)).image, 4.0);
    EXPECT_NEAR(b.x, 1.0, 0.02);
    EXPECT_NEAR(b.y, -0.5, 0.02);
    EXPECT_NEAR(b.share, 1.0 / 16.0, 1e-3);
}

TEST_F(Geometry, BlenderSensorAndShift) {
    // 36 mm wide, 50 mm: at 5 m the frame is 3.6 m wide. Shift 0.25 of the width moves the picture by 0.9 m.
    scene::Scene scene = lit_scene();
    add_mesh_node(scene, add_square(scene, 1.0F, add_diffuse(scene)), glm::dmat4(1.0));
    CameraView camera;
    camera.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 5.0));
    camera.camera.sensor = scene::Sensor{};
    camera.camera.sensor->shift_x = 0.25F;
    Settings wide = settings(200);
    wide.height = 100;
    const Rendered r = draw(scene, camera, wide);
    double x = 0.0;
    double count = 0.0;
    for (int i = 0; i < 200; ++i) {
        if (r.at(i, 50).x > 0.5) {
            x += (i + 0.5) / 200.0 - 0.5;
            count += 1.0;
        }
    }
    EXPECT_NEAR(x / count * 3.6, -0.9, 0.02) << "the camera looks to the right, so things move left";
    EXPECT_NEAR(count / 200.0 * 3.6, 1.0, 0.03);
}

TEST_F(Geometry, MirroredAndSingleSided) {
    // A mirrored square (negative scale) still faces the camera with its front; a single-sided one seen from
    // behind is culled in files that are not Blender's.
    scene::Scene scene = lit_scene();
    const int material = add_diffuse(scene);
    add_mesh_node(scene, add_square(scene, 1.0F, material),
                  glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0)));
    scene.materials[static_cast<size_t>(material)].double_sided = false;
    scene.from_blender = false;
    EXPECT_NEAR(blob(draw(scene, camera_from_above(4.0, 10.0), settings(100)).image, 4.0).share, 1.0 / 16.0,
                3e-3);
    scene.nodes.back().matrix = glm::rotate(glm::dmat4(1.0), pi, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(draw(scene, camera_from_above(4.0, 10.0), settings(100)).mean(), 0.0);
}

TEST_F(Geometry, SkinMovesVerticesAsTheJointsSay) {
    scene::Scene scene = lit_scene();
    const int mesh = add_square(scene, 1.0F, add_diffuse(scene));
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(mesh)].primitives[0];
    primitive.joints.assign(4, glm::u16vec4(0, 1, 0, 0));
    primitive.weights.assign(4, glm::vec4(0.25F, 0.75F, 0.0F, 0.0F));
    scene::Node joint_a;
    joint_a.matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 0.0));
    scene::Node joint_b;
    joint_b.matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.0, 0.0));
    scene::Skin skin;
    skin.joints = {add_node(scene, joint_a), add_node(scene, joint_b)};
    skin.joint_from_mesh.assign(2, glm::mat4(1.0F));
    scene.skins.push_back(skin);
    // The skinned node's own transform must not count.
    const int node = add_mesh_node(scene, mesh, glm::translate(glm::dmat4(1.0), glm::dvec3(7.0, 7.0, 0.0)));
    scene.nodes[static_cast<size_t>(node)].skin = 0;
    const Rendered r = draw(scene, camera_from_above(4.0, 10.0), settings(200));
    const Blob b = blob(r.image, 4.0);
    EXPECT_NEAR(b.x, 0.25, 0.02);
    EXPECT_NEAR(b.y, 0.75, 0.02);
    EXPECT_NEAR(b.share, 1.0 / 16.0, 2e-3);
    EXPECT_EQ(r.report.executed.front(), "deform");
}

TEST_F(Geometry, MorphTargetsAddUp) {
    scene::Scene scene = lit_scene();
    const int mesh = add_square(scene, 1.0F, add_diffuse(scene));
    scene::Primitive& primitive = scene.meshes[static_cast<size_t>(mesh)].primitives[0];
    scene::MorphTarget right;
    right.positions.assign(4, glm::vec3(1.0F, 0.0F, 0.0F));
    scene::MorphTarget up;
    up.positions.assign(4, glm::vec3(0.0F, 1.0F, 0.0F));
    primitive.targets = {right, up};
    const int node = add_mesh_node(scene, mesh, glm::dmat4(1.0));
    scene.nodes[static_cast<size_t>(node)].weights = {0.5F, -0.75F};
    const Blob b = blob(draw(scene, camera_from_above(4.0, 10.0), settings(200)).image, 4.0);
    EXPECT_NEAR(b.x, 0.5, 0.02);
    EXPECT_NEAR(b.y, -0.75, 0.02);
}

TEST_F(Geometry, SmoothNormalsOfAScaledMeshStayRight) {
    // Seen from above, a floor under non-uniform scale keeps its normal: radiance is that of a facing plane.
    scene::Scene scene = lit_scene();
    add_mesh_node(
        scene, add_square(scene, 1.0F, add_diffuse(scene)),
        glm::scale(glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0.0, 1.0, 0.0)), glm::dvec3(3.0, 2.0, 0.1)));
    const Rendered r = draw(scene, camera_from_above(4.0, 10.0), settings(51));
    EXPECT_NEAR(r.at(25, 25).x, std::cos(0.3), 1e-3);
}

}  // namespace
}  // namespace bounce::test
