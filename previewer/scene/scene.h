// SPDX-License-Identifier: Apache-2.0
//
// A loaded scene as plain data: no OpenGL, no glTF library types. What moves in time is described by
// animation.h and evaluated into a Pose (pose.h).
//
// Units: metres, seconds, radians, watts; colours are scene-linear Rec. 709. Axes: glTF (Y up).
// Indices into the vectors of Scene are ints; k_none (-1) means "none".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/animation.h"

namespace bounce::scene {

constexpr int k_none = -1;

// ---- geometry ----

// Differences added to the base attribute, scaled by the target's weight; empty or one per vertex.
struct MorphTarget {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

// An axis-aligned box, empty until grown.
struct Box {
    glm::vec3 low{3.4e38F};
    glm::vec3 high{-3.4e38F};
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    void grow(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

// Filled by the loader (primitive_bounds.h), so that bounds of a pose need not visit every vertex.
struct PrimitiveBounds {
    Box all;
    std::vector<Box> targets;  // of each morph target's position differences
    std::vector<Box> joints;   // of the vertices that joint i moves; may be shorter than Skin::joints
};

// A triangle list. Strips, fans and unindexed primitives are converted by the loader; points and lines
// are dropped with a warning. Optional streams are empty or one per vertex. Normals are always there:
// computed flat per face (vertices split) where the file has none.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;  // w is the bitangent's sign
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec4> colors;  // linear
    // Joint indices refer to Skin::joints; four influences a vertex (more in the file: the four
    // largest are kept, renormalised, with a warning).
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;
    std::vector<uint32_t> indices;  // three a triangle, each < positions.size()
    std::vector<MorphTarget> targets;
    int material = k_none;  // k_none: glTF's default material
    PrimitiveBounds bounds;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights;  // default morph weights
};

// ---- images and materials ----

// Decoded pixels, rows from top to bottom, RGBA interleaved; either 8 bit (as stored: sRGB or linear is
// decided by use) or 16-bit per channel.
struct Image {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba8;
    std::vector<uint16_t> rgba16;
    bool opaque = false;  // known to have no alpha below 1
};

enum class Wrap { repeat, clamp_to_edge, mirrored_repeat };
enum class Filter { nearest, linear };

struct Sampler {
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    bool mipmaps = true;
};

struct Texture {
    int image = k_none;
    Sampler sampler;
};

// How a texture's numbers stand for its values: as glTF has it for each use (sRGB for colours, linear for
// data), or as the file's BOUNCE_scene says.
enum class Encoding { by_use, linear, srgb };

// uv' = uv_transform * (u, v, 1), KHR_texture_transform applied.
struct TextureRef {
    int texture = k_none;
    int uv_set = 0;
    glm::mat3 uv_transform{1.0F};
    Encoding encoding = Encoding::by_use;
    [[nodiscard]] bool present() const { return texture != k_none; }
    // color: of a texture that is used as one.
    [[nodiscard]] bool is_srgb(bool color) const {
        return encoding == Encoding::srgb || (encoding == Encoding::by_use && color);
    }
};

enum class AlphaMode { opaque, mask, blend };
enum class DiffuseModel { lambert, disney };

struct Material {
    std::string name;
    glm::vec4 base_color{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
    float specular = 0.5F;  // Principled "Specular": F0 = 0.08 * specular
    DiffuseModel diffuse = DiffuseModel::lambert;
    // Radiance, W/(m^2 sr), is emission * emission_strength. In Scene these are the file's factor and
    // strength, which may be animated apart; in Pose the product stands in emission and 1 in the other.
    glm::vec3 emission{0.0F};
    float emission_strength = 1.0F;
    TextureRef base_color_texture;
    TextureRef metallic_roughness_texture;
    TextureRef normal_texture;
    TextureRef emission_texture;
    float normal_scale = 1.0F;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;
};

// ---- lights, world, cameras ----

enum class LightType { point, spot, sun, area };
enum class AreaShape { square, rectangle, disk, ellipse };
// How a spot falls off from its axis: Cycles before Blender 4.0, Cycles from 4.0, KHR_lights_punctual.
enum class SpotProfile { cycles_3, cycles_4, khronos };

// Radiometric, as Blender means it. A point or spot light of P watts has intensity P/(4 pi) W/sr on
// axis (a spot's cone does not concentrate it); KHR_lights_punctual's candela and lux are divided by
// 683 lm/W on load.
// What an area light's surface sends over its mean, cell by cell of a grid over the rectangle around its
// shape: rows from its -Y to +Y, in them from -X to +X. Not negative; the mean of each channel over the shape
// is 1, or 0 where nothing is sent.
struct LightPattern {
    int width = 0;  // 0: even
    int height = 0;
    std::vector<glm::vec3> cells;
};

struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 color{1.0F};
    float power_w = 0.0F;          // point, spot, area
    float irradiance_w_m2 = 0.0F;  // sun
    float radius_m = 0.0F;         // point, spot
    float angle_rad = 0.0F;        // sun, angular diameter
    float cone_angle_rad = 0.0F;   // spot, full angle
    float blend = 0.0F;            // spot, Blender's; unused by the khronos profile
    float inner_cone_rad = 0.0F;   // spot, khronos profile: half angle from the axis
    SpotProfile profile = SpotProfile::cycles_3;
    AreaShape shape = AreaShape::square;
    float size_x_m = 0.0F;  // area, before the node's scale
    float size_y_m = 0.0F;
    float spread_rad = 3.14159265F;
    LightPattern pattern;
    bool cast_shadow = true;
};

// Radiance, W/(m^2 sr), is color * strength in all directions; with Scene::environment it is that image's
// times strength, and color is the image's mean.
struct World {
    glm::vec3 color{0.0F};
    float strength = 1.0F;
    glm::dquat world_from_environment{1.0, 0.0, 0.0, 0.0};  // turns the image about the scene
};

// An equirectangular image of the world, RGB interleaved, rows from top (up) to bottom, scene-linear; finite
// and not negative. Without a turn the middle of its width is seen along +X (Blender's too), a quarter of it
// along -Z (Blender's +Y).
struct Environment {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<float> rgb;
};

enum class SensorFit { automatic, horizontal, vertical };

// Blender's own description of a lens, where the file carries it: the frame then matches Blender's at
// any resolution.
struct Sensor {
    SensorFit fit = SensorFit::automatic;
    float width_mm = 36.0F;
    float height_mm = 24.0F;
    float focal_length_mm = 50.0F;
    float ortho_scale = 6.0F;
    float shift_x = 0.0F;
    float shift_y = 0.0F;
};

struct Camera {
    std::string name;
    bool perspective = true;
    float yfov_rad = 0.69F;
    float xmag = 1.0F;  // orthographic, half extents in metres
    float ymag = 1.0F;
    float near_m = 0.01F;
    float far_m = 1000.0F;  // infinity where the file leaves it out
    std::optional<Sensor> sensor;
};

// ---- nodes and skins ----

// Double precision: a scene may lie 10^6 units from the origin.
struct Transform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

struct Node {
    std::string name;
    int parent = k_none;
    std::vector<int> children;
    Transform local;                   // used unless matrix is there
    std::optional<glm::dmat4> matrix;  // a node given as a matrix is never animated
    int mesh = k_none;
    int skin = k_none;
    int camera = k_none;
    int light = k_none;                 // into Scene::lights
    bool visible = true;                // KHR_node_visibility; hides the children too
    std::vector<float> weights;         // overrides Mesh::weights where not empty
    std::vector<glm::dmat4> instances;  // EXT_mesh_gpu_instancing: node_from_instance; empty means one
};

struct Skin {
    std::string name;
    std::vector<int> joints;                 // nodes
    std::vector<glm::mat4> joint_from_mesh;  // inverse bind matrices, one a joint
};

// ---- the whole ----

struct FrameRange {
    int start = 1;
    int end = 1;
    double fps = 24.0;
};

struct RenderSettings {
    int width = 960;
    int height = 540;
    float pixel_aspect_x = 1.0F;
    float pixel_aspect_y = 1.0F;
    float film_exposure = 1.0F;
};

struct ViewSettings {
    std::string display_device = "sRGB";
    std::string view_transform = "Standard";
    std::string look = "None";
    float exposure = 0.0F;
    float gamma = 1.0F;
};

struct Unsupported {
    std::string object;
    std::string what;
};

struct Scene {
    std::string name;  // file name without folder
    std::vector<Node> nodes;
    std::vector<int> roots;  // of the glTF scene that is shown
    // Every parent stands before its children, so one pass over this order composes transforms. Nodes
    // that the shown scene does not reach are not in it.
    std::vector<int> topological_order;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<Image> images;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Animation> animations;
    World world;
    std::optional<Environment> environment;
    FrameRange frames;
    RenderSettings render;
    ViewSettings view;
    int active_camera_node = k_none;
    // True where BOUNCE_scene was in the file; otherwise frames, render, view and world are defaults.
    bool from_blender = false;
    std::vector<int> blender_version;  // {3, 4, 1}
    std::vector<Unsupported> unsupported;
};

// Seconds of Blender's frame number (which may be fractional) in the file's time.
[[nodiscard]] inline double time_of_frame(const FrameRange& range, double frame) {
    return (frame - range.start) / range.fps;
}

}  // namespace bounce::scene
