// SPDX-License-Identifier: Apache-2.0
#include "renderer/auto_knobs.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/setting_names.h"

namespace bounce {
namespace {

// Off and on of a setting that is no number.
constexpr int k_off = 0;
constexpr int k_on = 1;

// Where little of the light counts for what is seen, every step costs so many times as much: the ratio of the
// colonnade's steps to the others'.
constexpr double k_little_factor = 4.0;

// Errors are of docs/auto.md, "What a step costs": 96x54, the six examples.

KnobCurve vpl_curve() {
    return {Knob::vpls,
            {{1024, 0.0}, {512, 2e-4}, {256, 5e-4, true}, {128, 8e-4}, {64, 1.4e-3}, {32, 4e-3}, {16, 8e-3}}};
}

KnobCurve importance_curve(const AutoScene& scene) {
    // Plainly better where the camera sees little of what is lit, and not worse elsewhere.
    const bool little = scene.seen_share < k_little_seen;
    return {Knob::importance,
            {{static_cast<int>(Importance::view), 0.0, little},
             {static_cast<int>(Importance::flux), little ? 8e-3 : 2e-4, !little}}};
}

KnobCurve shadow_curve(const AutoScene& scene) {
    // A sun's map is as wide as the scene; a lamp's as its cone.
    const bool wide = scene.features.sun_lights > 0 && scene.seen_share < k_little_seen;
    return wide ? KnobCurve{Knob::shadow_size, {{2048, 0.0, true}, {1024, 1.7e-3}, {512, 5e-3}, {256, 2.8e-2}}}
                : KnobCurve{Knob::shadow_size, {{2048, 0.0, true}, {1024, 3e-5}, {512, 1e-4}, {256, 2e-4}}};
}

KnobCurve world_curve(Technique technique) {
    // Where bounced light is missing, the world's that nothing hides stands for some of it.
    return technique == Technique::direct
               ? KnobCurve{Knob::world_vpls, {{0, 0.0}, {256, 1e-2, true}, {64, 1e-2}, {16, 1e-2}}}
               : KnobCurve{Knob::world_vpls, {{256, 0.0, true}, {64, 2e-5}, {16, 1e-4}, {0, 3e-2}}};
}

// docs/lights.md has the measurement ("Soft shadows").
KnobCurve soft_curve(Knob knob) {
    return knob == Knob::shadow_samples ? KnobCurve{knob, {{64, 0.0, true}, {32, 1.7e-4}, {16, 4.5e-4}}}
                                        : KnobCurve{knob, {{512, 0.0, true}, {256, 1.8e-3}}};
}

}  // namespace

std::vector<KnobCurve> knob_curves(const AutoScene& scene, Technique technique) {
    std::vector<KnobCurve> out;
    const bool ism = technique == Technique::ism;
    out.push_back({Knob::antialias, {{k_on, 0.0, true}, {k_off, 6e-3}}});
    if (scene.lights() > 0) {
        out.push_back(shadow_curve(scene));
    }
    if (scene.sized_planar + scene.sized_cube > 0) {
        out.push_back(soft_curve(Knob::shadow_samples));
        out.push_back(soft_curve(Knob::soft_shadow_size));
    }
    if (scene.world()) {
        out.push_back(world_curve(technique));
    }
    if (scene.emitters) {
        out.push_back({Knob::emitter_vpls, {{256, 0.0, true}, {64, 9e-4}, {16, 8e-3}}});
    }
    if (technique == Technique::rsm && scene.lights() > 0) {
        out.push_back({Knob::rsm_samples, {{448, 0.0}, {224, 1e-4, true}, {64, 6e-4}}});
        out.push_back({Knob::rsm_size, {{512, 0.0, true}, {256, 2e-4}, {128, 5e-4}}});
    }
    if (ism && scene.lights() > 0) {
        out.push_back(vpl_curve());
        out.push_back(importance_curve(scene));
        out.push_back({Knob::rsm_size, {{256, 0.0, true}, {128, 2e-4}, {64, 5e-4}}});
    }
    if (ism) {
        out.push_back({Knob::ism_size, {{128, 0.0}, {64, 3e-5, true}, {32, 2e-4}}});
        out.push_back({Knob::interleave, {{1, 0.0}, {2, 3e-4}, {4, 2e-3, true}, {8, 6e-3}}});
        if (scene.world() || scene.emitters) {
            out.push_back({Knob::bounce_vpls, {{128, 0.0, true}, {64, 2e-5}, {32, 8e-5}, {16, 1.5e-4}}});
        }
    }
    if (scene.seen_share < k_little_seen) {
        for (KnobCurve& curve : out) {
            for (KnobLevel& level : curve.levels) {
                level.error *= k_little_factor;
            }
        }
    }
    return out;
}

double least_error(const AutoScene& scene, Technique technique) {
    const bool little = scene.seen_share < k_little_seen;
    const double exact = little ? 3e-2 : 3e-3;
    if (!scene.lit() || !scene.features.reflects) {
        return exact;
    }
    switch (technique) {
        case Technique::direct:
            return little ? 2e-1 : 7e-2;
        case Technique::rsm:
            // Nothing hides its light, and mirrors and metals show none of it: from as good as the best
            // (cornell) to worse than none (u_room).
            return little ? 6e-2 : 3e-2;
        case Technique::ism:
            break;
    }
    return exact;
}

void set_knob(Settings& s, Knob knob, int value) {
    switch (knob) {
        case Knob::technique:
            s.technique = static_cast<Technique>(value);
            break;
        case Knob::vpls:
            s.vpls = value;
            break;
        case Knob::importance:
            s.vpl_importance = static_cast<Importance>(value);
            break;
        case Knob::ism_size:
            s.ism_size = value;
            break;
        case Knob::interleave:
            s.interleave = value;
            break;
        case Knob::antialias:
            s.antialias = value != k_off;
            break;
        case Knob::shadow_size:
            s.shadow_size = value;
            break;
        case Knob::rsm_size:
            // What a technique takes by itself stays unsaid.
            s.rsm_size = 0;
            s.rsm_size = value == s.used_rsm_size() ? 0 : value;
            break;
        case Knob::rsm_samples:
            s.rsm_samples = value;
            break;
        case Knob::world_vpls:
            s.world_vpls = value;
            break;
        case Knob::bounce_vpls:
            s.bounce_vpls = value;
            break;
        case Knob::emitter_vpls:
            s.emitter_vpls = value;
            break;
        case Knob::shadow_samples:
            s.shadow_samples = value == Settings{}.used_shadow_samples() ? 0 : value;
            break;
        case Knob::soft_shadow_size:
            s.soft_shadow_size = value == Settings{}.used_soft_shadow_size() ? 0 : value;
            break;
    }
}

int get_knob(const Settings& s, Knob knob) {
    switch (knob) {
        case Knob::technique:
            return static_cast<int>(s.technique);
        case Knob::vpls:
            return s.vpls;
        case Knob::importance:
            return static_cast<int>(s.vpl_importance);
        case Knob::ism_size:
            return s.ism_size;
        case Knob::interleave:
            return s.interleave;
        case Knob::antialias:
            return s.antialias ? k_on : k_off;
        case Knob::shadow_size:
            return s.shadow_size;
        case Knob::rsm_size:
            return s.used_rsm_size();
        case Knob::rsm_samples:
            return s.rsm_samples;
        case Knob::world_vpls:
            return s.world_vpls;
        case Knob::bounce_vpls:
            return s.bounce_vpls;
        case Knob::emitter_vpls:
            return s.emitter_vpls;
        case Knob::shadow_samples:
            return s.used_shadow_samples();
        case Knob::soft_shadow_size:
            break;
    }
    return s.used_soft_shadow_size();
}

bool same_knobs(const Settings& a, const Settings& b) {
    for (size_t knob = 0; knob < k_knobs; ++knob) {
        if (get_knob(a, static_cast<Knob>(knob)) != get_knob(b, static_cast<Knob>(knob))) {
            return false;
        }
    }
    return true;
}

void take_knobs(const Settings& from, Settings& to) {
    for (size_t knob = 0; knob < k_knobs; ++knob) {
        set_knob(to, static_cast<Knob>(knob), get_knob(from, static_cast<Knob>(knob)));
    }
}

std::string knob_option(Knob knob, int value) {
    switch (knob) {
        case Knob::technique:
            return fmt::format("--technique {}", name_of(static_cast<Technique>(value)));
        case Knob::vpls:
            return fmt::format("--vpls {}", value);
        case Knob::importance:
            return fmt::format("--vpl-importance {}", name_of(static_cast<Importance>(value)));
        case Knob::ism_size:
            return fmt::format("--ism-size {}", value);
        case Knob::interleave:
            return fmt::format("--interleave {}", value);
        case Knob::antialias:
            return fmt::format("--antialias {}", value == k_off ? "off" : "on");
        case Knob::shadow_size:
            return fmt::format("--shadow-size {}", value);
        case Knob::rsm_size:
            return fmt::format("--rsm-size {}", value);
        case Knob::rsm_samples:
            return fmt::format("--rsm-samples {}", value);
        case Knob::world_vpls:
            return fmt::format("--world-vpls {}", value);
        case Knob::bounce_vpls:
            return fmt::format("--bounce-vpls {}", value);
        case Knob::emitter_vpls:
            return fmt::format("--emitter-vpls {}", value);
        case Knob::shadow_samples:
            return fmt::format("--shadow-samples {}", value);
        case Knob::soft_shadow_size:
            break;
    }
    return fmt::format("--soft-shadow-size {}", value);
}

std::string knob_words(Knob knob, int value) {
    switch (knob) {
        case Knob::technique:
            return value == static_cast<int>(Technique::direct) ? "no bounced light"
                   : value == static_cast<int>(Technique::rsm)  ? "bounced light that nothing hides"
                                                                : "bounced light with shadows";
        case Knob::vpls:
            return fmt::format("{} small lights that stand for bounced light", value);
        case Knob::importance:
            return value == static_cast<int>(Importance::view) ? "lights placed by what the camera sees"
                                                               : "lights placed by how bright surfaces are";
        case Knob::ism_size:
            return fmt::format("their shadow maps {} texels wide", value);
        case Knob::interleave:
            return value == 1 ? std::string("every pixel looks at all of them")
                              : fmt::format("neighbouring pixels share them {} by {}", value, value);
        case Knob::antialias:
            return value == k_off ? "outlines are jagged" : "outlines are smooth";
        case Knob::shadow_size:
            return fmt::format("lamps' shadow maps {} texels wide", value);
        case Knob::rsm_size:
            return fmt::format("what lamps light is looked at {} by {}", value, value);
        case Knob::rsm_samples:
            return fmt::format("{} samples of bounced light a pixel", value);
        case Knob::world_vpls:
            return value == 0 ? std::string("the world's light throws no shadow")
                              : fmt::format("{} lights for the world", value);
        case Knob::bounce_vpls:
            return fmt::format("{} lights for each further bounce", value);
        case Knob::emitter_vpls:
            return fmt::format("{} lights for glowing surfaces", value);
        case Knob::shadow_samples:
            return fmt::format("{} places on a lamp for its soft shadow", value);
        case Knob::soft_shadow_size:
            break;
    }
    return fmt::format("soft shadows from maps {} texels wide", value);
}

}  // namespace bounce
