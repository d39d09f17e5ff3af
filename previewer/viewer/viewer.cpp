// SPDX-License-Identifier: Apache-2.0
#include "viewer/viewer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "gl/debug_output.h"
#include "renderer/auto_knobs.h"
#include "renderer/settings_check.h"
#include "viewer/display.h"
#include "viewer/frame_clock.h"
#include "viewer/panels.h"
#include "viewer/screenshot.h"
#include "viewer/state_commands.h"
#include "viewer/user_interface.h"
#include "viewer/viewpoint.h"
#include "viewer/window.h"

namespace bounce::viewer {
namespace {

// How often the scene's file is looked at while nothing happens.
constexpr double k_idle_s = 0.25;
constexpr double k_message_s = 5.0;
// ImGui takes a frame to see an event, one to answer and one to settle its layout.
constexpr int k_redraws = 3;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Viewer {
  public:
    Viewer(const ViewerOptions& options, SceneReloader& reloader, scene::LoadResult loaded,
           const Settings& settings)
        : options_(options),
          reloader_(reloader),
          window_(fmt::format("{} - Bounce", loaded.scene.name), {settings.width, settings.height}),
          device_(gl::initialise_current_context()),
          interface_(window_.handle(), window_.content_scale()),
          stage_(std::make_unique<Stage>(std::move(loaded), options.choose_animation)),
          viewpoint_(stage_->scene().active_camera_node),
          playback_(stage_->scene().frames) {
        if (const std::string refusal = limits_refusal(settings, device_.limits); !refusal.empty()) {
            throw usage_error(refusal);
        }
        state_.settings = chosen_ = settings;
        playback_.seek(options.frame.value_or(playback_.frame()), seconds_now());
        if (!options.camera.empty()) {
            // Refuses a name that is not there with the sentence that bounce render has.
            (void)scene_camera(stage_->scene(), stage_->pose(), options.camera, settings.width,
                               settings.height);
            viewpoint_.look_through(stage_->find_camera(options.camera));
        }
    }

    void run() {
        while (!window_.should_close()) {
            take_events();
            const double now = seconds_now();
            take_reloaded(now);
            picture_changed_ |= playback_.advance(now);
            if (!message_.empty() && now > message_until_s_) {
                message_.clear();
                redraws_ = k_redraws;
            }
            if (picture_changed_ || redraws_ > 0) {
                draw(now);
            }
        }
    }

  private:
    void take_events() {
        if (picture_changed_ || redraws_ > 0) {
            window_.poll();
        } else {
            const double next = playback_.playing() ? playback_.seconds_to_next(seconds_now()) : k_idle_s;
            window_.wait(std::min(next, k_idle_s));
        }
        input_ = window_.take_input();
        if (input_.any) {
            redraws_ = k_redraws;  // so draw() answers it
        }
    }

    // Everything of one turn that ends in a new content of the window.
    void draw(double now) {
        const glm::ivec2 room = window_.framebuffer_size();
        if (room.x < 1 || room.y < 1) {  // minimised: nothing to see, so nothing to do until that changes
            redraws_ = 0;
            picture_changed_ = false;
            window_.wait(k_idle_s);
            return;
        }
        interface_.begin();
        answer_input(now);
        const std::vector<std::string> lights = stage_->shown_lights(state_.settings);
        PanelResult panels = draw_panels(state_, viewpoint_, playback_, facts(lights, now));
        picture_changed_ |= panels.picture_changed;
        for (const Command command : panels.commands) {
            perform(command, now);
        }
        const glm::ivec2 size = glm::max(room / state_.render_divisor, glm::ivec2(1));
        if (picture_changed_ || size != glm::ivec2(state_.settings.width, state_.settings.height)) {
            const bool other_size =
                options_.size_matters && size != glm::ivec2(state_.settings.width, state_.settings.height);
            state_.settings.width = size.x;
            state_.settings.height = size.y;
            if (other_size) {
                choose_again();
            }
            render_picture();
            redraws_ = std::max(redraws_, 2);  // the panels tell about the picture one frame later
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        display_.draw(stage_->renderer().color(), shown_view(state_, stage_->pose().view), room.x, room.y);
        interface_.draw();
        window_.swap();
        redraws_ = std::max(0, redraws_ - 1);
    }

    void answer_input(double now) {
        const Input input = std::exchange(input_, Input{});
        if (input.drag_began) {
            drag_is_panels_ = interface_.wants_mouse();
        }
        if (!interface_.wants_text()) {
            for (const Command command : input.commands) {
                perform(command, now);
            }
        }
        const bool drags = input.drag && !drag_is_panels_ && input.moved != glm::dvec2(0.0);
        const bool scrolls = input.scrolled != 0.0 && !interface_.wants_mouse();
        if (drags && *input.drag == Drag::orbit) {
            free_camera().orbit(input.moved.x, input.moved.y);
        } else if (drags && *input.drag == Drag::pan) {
            free_camera().pan(input.moved.x, input.moved.y, state_.settings.width, state_.settings.height);
        } else if (drags) {
            constexpr double steps_a_height = 20.0;
            free_camera().zoom(-steps_a_height * input.moved.y);
        }
        if (scrolls) {
            free_camera().zoom(input.scrolled);
        }
        picture_changed_ |= drags || scrolls;
    }

    // Settings for this scene and size, as long as those that were chosen before are still in use: what the
    // user has changed stays.
    void choose_again() {
        if (!same_knobs(state_.settings, chosen_)) {
            return;
        }
        try {
            chosen_ = options_.choose_settings(stage_->scene(),
                                               glm::ivec2(state_.settings.width, state_.settings.height));
        } catch (const Error& error) {
            log::warning("settings stay as they are: {}", error.what());
            return;
        }
        take_knobs(chosen_, state_.settings);
    }

    CameraControls& free_camera() {
        return viewpoint_.free(*stage_, state_.settings.width, state_.settings.height);
    }

    void perform(Command command, double now) {
        const Effect effect = perform_on_state(command, state_, playback_, now);
        if (effect != Effect::not_here) {
            picture_changed_ |= effect == Effect::picture_changed;
            return;
        }
        switch (command) {
            case Command::frame_all:
                free_camera().frame_all(stage_->bounds(), state_.settings.width, state_.settings.height);
                break;
            case Command::active_camera:
                viewpoint_.look_through(stage_->scene().active_camera_node);
                break;
            case Command::next_camera:
                next_camera(now);
                break;
            case Command::next_light:
                next_light(now);
                break;
            case Command::screenshot:
                save(now);
                return;
            case Command::quit:
                window_.close();
                return;
            default:
                return;
        }
        picture_changed_ = true;
    }

    void next_camera(double now) {
        if (stage_->cameras().empty()) {
            say("the scene has no camera", now);
            return;
        }
        viewpoint_.look_through_next(*stage_);
        say(fmt::format("camera {}", stage_->camera_name(viewpoint_.node())), now);
    }

    void next_light(double now) {
        const std::vector<std::string> lights = stage_->shown_lights(state_.settings);
        if (lights.empty()) {
            say("no light of the scene sends light", now);
            return;
        }
        state_.settings.shown_light = (state_.settings.shown_light + 1) % static_cast<int>(lights.size());
        say(fmt::format("light {}", lights[static_cast<size_t>(state_.settings.shown_light)]), now);
    }

    void save(double now) {
        if (!stage_->renderer().color()) {
            return;  // asked for before the first frame
        }
        try {
            const auto path = save_screenshot(std::filesystem::current_path(), options_.scene.stem().string(),
                                              playback_.frame(), stage_->renderer().read_color(),
                                              shown_view(state_, stage_->pose().view));
            say(fmt::format("saved {} and its .exr", path.string()), now);
            log::info("saved {} and its .exr", path.string());
        } catch (const Error& error) {
            say(error.what(), now);
            log::error("{}", error.what());
        }
    }

    void say(std::string message, double now) {
        message_ = std::move(message);
        message_until_s_ = now + k_message_s;
        redraws_ = k_redraws;
    }

    [[nodiscard]] PanelFacts facts(const std::vector<std::string>& lights, double now) const {
        return {.stage = *stage_,
                .report = report_,
                .pass_times = report_.passes,
                .lights = lights,
                .device = device_.renderer,
                .message = message_,
                .problem = problem_,
                .note = refusal_.empty() ? why_not_shown(state_.settings, lights.size()) : refusal_,
                .frame_ms = frame_clock_.median_ms(),
                .now_s = now,
                .content_scale = window_.content_scale()};
    }

    void render_picture() {
        stage_->set_time(playback_.time_s());
        const gl::TimingMode timing = !state_.time_passes ? gl::TimingMode::off
                                      : device_.software  ? gl::TimingMode::finish
                                                          : gl::TimingMode::query;
        const CameraView view = viewpoint_.view(*stage_, state_.settings.width, state_.settings.height);
        picture_changed_ = false;
        refusal_ = limits_refusal(state_.settings, device_.limits);
        if (!refusal_.empty()) {
            return;  // the picture before stays
        }
        const double start = seconds_now();
        try {
            report_ = stage_->renderer().render(stage_->pose(), view, state_.settings, timing);
        } catch (const Error& error) {
            if (error.code() != ExitCode::usage) {
                throw;
            }
            refusal_ = error.what();  // settings that this scene and driver do not go with
            return;
        }
        stage_->renderer().keep_frame();
        glFinish();
        frame_clock_.add((seconds_now() - start) * 1000.0);
    }

    // Puts a changed file's scene on stage, or says why not and keeps what is there.
    void take_reloaded(double now) {
        std::optional<SceneReloader::Loaded> reloaded = reloader_.poll(now);
        if (!reloaded) {
            if (reloader_.loading() && message_.empty()) {
                say("the file has changed; loading it", now);
            }
            return;
        }
        redraws_ = k_redraws;
        if (const auto* why_not = std::get_if<std::string>(&*reloaded)) {
            refuse_reloaded(*why_not);
            return;
        }
        try {
            auto stage = std::make_unique<Stage>(std::get<scene::LoadResult>(std::move(*reloaded)),
                                                 options_.choose_animation);
            gl::throw_on_debug_error("uploading the changed scene");
            viewpoint_.move_to(*stage_, *stage);
            playback_.set_range(stage->scene().frames);
            stage_ = std::move(stage);
            choose_again();
        } catch (const Error& error) {
            refuse_reloaded(error.what());
            return;
        } catch (const std::bad_alloc&) {
            refuse_reloaded("there is not enough memory for it beside the one on show");
            return;
        }
        problem_.clear();
        frame_clock_.clear();
        picture_changed_ = true;
        say(fmt::format("loaded {} again", stage_->scene().name), now);
    }

    void refuse_reloaded(const std::string& why) {
        problem_ = fmt::format("the changed file is not shown: {}", why);
        log::warning("{}", problem_);
    }

    const ViewerOptions& options_;
    SceneReloader& reloader_;
    Window window_;  // before all that needs its context
    gl::DeviceInfo device_;
    UserInterface interface_;
    Display display_;
    std::unique_ptr<Stage> stage_;
    Viewpoint viewpoint_;
    Playback playback_;
    ViewState state_;
    Settings chosen_;  // by the options

    Input input_;
    bool drag_is_panels_ = false;
    bool picture_changed_ = true;
    int redraws_ = k_redraws;
    FrameReport report_;
    FrameClock frame_clock_;
    std::string message_;
    double message_until_s_ = 0.0;
    std::string problem_;
    std::string refusal_;  // why the settings chosen cannot be drawn
};

}  // namespace

void run_viewer(const ViewerOptions& options) {
    SceneReloader reloader(options.scene, options.load);
    scene::LoadResult loaded = options.load();
    for (const std::string& warning : loaded.warnings) {
        log::warning("{}", warning);
    }
    const Settings settings = options.choose_settings(loaded.scene, std::nullopt);
    Viewer viewer(options, reloader, std::move(loaded), settings);
    viewer.run();
}

}  // namespace bounce::viewer
