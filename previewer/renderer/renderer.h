// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frame_graph/frame_graph.h"
#include "gl/context.h"
#include "gl/pass_timer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gpu/emitter_store.h"
#include "gpu/gpu_scene.h"
#include "gpu/lobe_table.h"
#include "gpu/point_store.h"
#include "gpu/triangle_patches.h"
#include "gpu/uniform_arena.h"
#include "image/image.h"
#include "renderer/avg_rays.h"
#include "renderer/camera_view.h"
#include "renderer/environment_world.h"
#include "renderer/frame_plan.h"
#include "renderer/light_history.h"
#include "renderer/light_setup.h"
#include "renderer/pipeline.h"
#include "renderer/previous_frame.h"
#include "renderer/receivers.h"
#include "renderer/settings.h"
#include "renderer/splat_choice.h"

namespace bounce {

// What a frame did and cost.
struct FrameReport {
    std::vector<gl::PassTime> passes;  // empty where timing is off
    std::vector<std::string> executed;
    std::vector<LeftOut> left_out;  // planned and culled
    std::vector<std::string> approximations;
    size_t triangles = 0;
    size_t simplified_triangles = 0;  // of the simplified meshes, where some pass draws them
    double simplified_error_m = 0.0;  // the largest distance a surface moved when it was simplified
    int rsm_samples = 0;              // a pixel, over all lights
    int lights = 0;
    int gathered_pixels = -1;  // evaluated in full after interpolation; -1 where not counted

    // Virtual point lights and their shadow maps; 0 where there are none.
    int vpls = 0;          // of all bounces
    int points_a_map = 0;  // splatted into each map
    size_t points = 0;     // in the sequence that maps take theirs from
    size_t large_triangles = 0;
    int shadow_points_a_map = 0;  // into each imperfect map of a place on a light
    int map_size = 0;             // texels a side
    int atlas_width = 0;          // of the first bounce's maps
    int atlas_height = 0;
    std::optional<passes::RemovedLight> removed;  // where the settings ask for it
    std::vector<std::string> notes;               // why the picture lacks what was asked for
    // Where the plan reuses light: the share of pixels with a surface that took light of the frame before (-1
    // where it was not counted, Settings::count_gathered_pixels), and why none could.
    struct Reuse {
        double share = -1.0;
        std::string reason;
    };
    std::optional<Reuse> reuse;
    // Textures and buffers, bytes: of the scene and what outlives frames, and what this frame's passes have
    // at once.
    struct Memory {
        size_t lasting = 0;
        size_t passes = 0;
        [[nodiscard]] size_t peak() const { return lasting + passes; }
    };
    std::optional<Memory> memory;      // of Renderer::plan()
    std::optional<SplatChoice> splat;  // where Splat::automatic was asked for and maps are drawn
};

// Draws a scene. Needs a current context set up by gl::initialise_current_context() for its whole life.
class Renderer {
  public:
    explicit Renderer(const scene::Scene& scene);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    Renderer(Renderer&&) = delete;
    Renderer& operator=(Renderer&&) = delete;

    // Draws one frame into color(). Does not wait for the GPU unless timing or counting asks for it.
    // Throws Error(failed) with the pass's name on an OpenGL error. before: the frame before, which only the
    // layer that shows motion looks at; null: nothing has moved.
    FrameReport render(const scene::Pose& pose, const CameraView& camera, const Settings& settings,
                       gl::TimingMode timing = gl::TimingMode::off, const Moment* before = nullptr);

    // The same as one of many pictures of one moment, whose mean is sought (renderer/converge.h): from the
    // second on the scene must stand as it did for the first, and the size and the lights' settings be the
    // same. Blended surfaces count. Throws the same.
    FrameReport render_one_of_many(const scene::Pose& pose, const CameraView& camera,
                                   const Settings& settings, gl::TimingMode timing, uint32_t number,
                                   float extent);
    // The best picture of those so far, into color(), and its estimated error, as passes::resolve_means() has
    // them: red, green, blue and error, top row first.
    [[nodiscard]] std::vector<glm::vec4> resolve_many();

    // What render() would do, without drawing: executed and left_out are those of a frame for which nothing
    // was kept, and the memory is what it would allocate. Points and buffers of the scene are made. Throws
    // the same.
    FrameReport plan(const scene::Pose& pose, const CameraView& camera, const Settings& settings);

    // Whether more frames of this scene are to come: what passes made and what is still the same in the frame
    // after keep_frame() is then not made again. A picture is the same either way, to the bit.
    void expect_frames(bool more) { contents_.set_on(more, pool_); }
    // The frame that was drawn last is the frame before the next one, for all that goes on from frame to
    // frame. A frame may be drawn several times before: each starts from the same. With
    // Settings::temporal_reuse each frame takes light of the one that was drawn last before keep_frame(), so
    // that a frame drawn twice is the same twice; none after forget_history(), nor after a frame without that
    // setting.
    void keep_frame();
    void forget_history();

    // Scene-linear radiance times film exposure, RGBA32F, bottom row first; of the last frame.
    [[nodiscard]] const gl::Texture& color() const { return color_; }
    // The same on the CPU, top row first.
    [[nodiscard]] Image read_color() const;

    [[nodiscard]] const gpu::GpuScene& gpu_scene() const { return gpu_scene_; }
    // Forgets compiled shaders, so that changed sources ($BOUNCE_SHADER_DIR) are compiled again.
    void reload_shaders() {
        programs_.clear();
        contents_.clear(pool_);
    }

  private:
    // Which of all that could be chosen are the virtual point lights.
    struct LightChoice {
        uint32_t seed = 0;        // VplSet's
        uint32_t image_seed = 0;  // of the world's image, whose glossy reflection looks up their maps
        bool middle = false;      // VplSet's
        float extent = 1.0F;      // the same
    };
    struct LitBounces {
        std::vector<Bounce> bounces;  // of the scene's lights
        Bounce world;                 // its own lights, where they are planned
        passes::SphereSource sphere;  // that they are drawn from, where they are
        std::vector<Bounce> world_bounces;
        Bounce emitters;  // likewise
        std::vector<Bounce> emitter_bounces;
        Splat splat = Splat::disks;                  // never automatic
        passes::TessellatedPoints tessellated;       // where splat is tessellation
        passes::TessellatedPoints soft_tessellated;  // the same in imperfect maps of places on lights
        int triangles = 0;                           // large ones in the maps of lights within the scene
        int soft_points = 0;                         // in each imperfect map of a place on a light
    };
    // The cells of the sphere, uploaded where they changed.
    [[nodiscard]] passes::SphereSource prepare_sphere(const scene::World& world);
    // A light whose soft shadow has imperfect maps: which of the frame's, and where it stands.
    struct Imperfect {
        size_t light = 0;
        LightSetup setup;
        scene::Light of;
    };
    FrameReport render_whole(const scene::Pose& pose, const CameraView& camera, const Settings& settings,
                             gl::TimingMode timing, const Moment* before, const OneOfMany* one_of_many);
    // own_lights: as many of the pose's light instances, the first, are the scene's; the others are suns of
    // the world's image.
    FrameReport render_lit(const scene::Pose& pose, const CameraView& camera, const Settings& settings,
                           gl::TimingMode timing, const Moment* before, size_t own_lights,
                           const OneOfMany* one_of_many = nullptr);
    // Samples the points that the plan needs and lays out its bounces; drops occlusion where nothing
    // occludes.
    LitBounces prepare_bounces(const scene::Pose& pose, std::span<const scene::EmissivePanel> panels,
                               const Settings& settings, FramePlan& plan, FrameReport& report,
                               const LightChoice& chosen);
    // The pose with what the settings have drawn as area lights; nothing where that is nothing.
    std::optional<scene::PanelPose> light_panels(const scene::Pose& pose, const Settings& settings);
    // Places the plan's lights on emissive surfaces; drops them from it where textures leave none.
    void place_emitters(const scene::Pose& pose, std::span<const scene::EmissivePanel> panels,
                        const Settings& settings, FramePlan& plan, uint32_t seed);
    // Their maps, parallel to the frame's `lights`; empty where nothing can throw a shadow. Of the points
    // that prepare_bounces() has placed, `points` each.
    std::vector<passes::ImperfectMaps> prepare_imperfect(const std::vector<Imperfect>& imperfect,
                                                         const std::vector<Region>& receivers, size_t lights,
                                                         int points, const Settings& settings,
                                                         const passes::TessellatedPoints& tessellated,
                                                         FramePlan& plan);
    // Splat::automatic made one of the others, for so many points a map.
    [[nodiscard]] SplatChoice chosen_splat(const Settings& settings, const FramePlan& plan, int points_a_map,
                                           int soft_lights, int soft_points) const;
    // The approximate visibility grid of this pose, where it is planned, and what is traced through it: rays
    // of the lights, which stand at their middles, not at their bounces' places.
    AvgInputs prepare_avg(const std::vector<AvgRayLight>& lights, const Settings& settings,
                          const FramePlan& plan);
    const gl::Buffer& pattern(passes::RsmPattern kind, int samples);

    const scene::Scene& scene_;
    gpu::GpuScene gpu_scene_;
    std::unique_ptr<gpu::PointStore> points_;        // made when a frame first needs it
    std::unique_ptr<gpu::EmitterStore> emitters_;    // the same
    std::unique_ptr<gpu::TrianglePatches> patches_;  // the same
    gl::ProgramCache programs_;
    TransientPool pool_;
    KeptContents contents_;
    bool plans_only_ = false;  // nothing is drawn
    gpu::UniformArena uniforms_;
    std::unique_ptr<PreviousFrameSource> previous_;  // made when motion is first asked for
    std::unique_ptr<LightHistory> history_;          // made when light is first reused, gone when it is not
    gl::Texture color_;
    passes::PictureMeans means_;
    KeptMaps kept_;
    // Sample patterns by kind and count, each made once.
    std::map<std::pair<passes::RsmPattern, int>, gl::Buffer> patterns_;
    gl::Buffer world_lights_;
    ContentKey world_content_;  // of these
    gl::Buffer sphere_cells_;
    ContentKey sphere_content_;
    glm::ivec2 sphere_grid_{0};         // cells across and down
    glm::vec3 sphere_radiance_{-1.0F};  // that the cells were made of; of an image: 0
    scene::Bounds first_bounds_;        // where the animation begins
    gl::Buffer avg_rays_;
    gl::Buffer avg_numbers_;
    std::vector<gl::Buffer> places_;                 // on lights, for imperfect maps
    std::vector<ContentKey> places_content_;         // of these
    std::unique_ptr<EnvironmentWorld> environment_;  // where the scene has an image of its world
    std::unique_ptr<gpu::LobeTable> lobes_;  // made when a glossy surface first meets a light with a size
    scene::EmissivePanels panels_;           // of so many sides at most
    int most_panels_ = -1;
};

// The view of the scene's active camera at the pose; framing_camera() where the scene has none.
// name picks another camera node by its name. Throws usage_error for an unknown name.
[[nodiscard]] CameraView scene_camera(const scene::Scene& scene, const scene::Pose& pose,
                                      const std::string& name, int width, int height);

}  // namespace bounce
