// SPDX-License-Identifier: Apache-2.0
#include "bench/experiments.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/room.h"
#include "core/error.h"
#include "scene/pose.h"

namespace bounce::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

MeasuredFrame example() {
    MeasuredFrame frame;
    frame.frame.ms = {20.0, 22.0};
    frame.passes = {{"gbuffer", Part::direct, {{5.0, 6.0}}},
                    {"rsm: Spot", Part::rsm, {{1.0, 1.0}}},
                    {"ism disks", Part::maps, {{3.0, 4.0}}},
                    {"ism pull-push", Part::maps, {{2.0, 0.5}}}};
    return frame;
}

TEST(MapsTooLarge, NamesTheAtlasAndTheLimit) {
    const auto refusal = [](int vpls, int map_size, int texture_size) {
        return maps_too_large({.vpls = vpls, .ism_size = map_size, .interleave = 1}, texture_size);
    };
    EXPECT_EQ(refusal(256, 1024, 16384), "") << "exactly 1 GiB";
    EXPECT_EQ(refusal(1024, 512, 16384), "");
    EXPECT_THAT(refusal(1024, 1024, 16384),
                HasSubstr("atlas of 32768x32768, 4 GiB; this OpenGL driver holds 16384"));
    EXPECT_THAT(refusal(1024, 1024, 32768), HasSubstr("no more than 1"));
    EXPECT_THAT(refusal(256, 512, 4096), HasSubstr("holds 4096"));
}

TEST(PassParts, AreToldByWhatOtherFramesRun) {
    const PassParts parts({"gbuffer", "shadow map: rsm", "composite"},
                          {"gbuffer", "shadow map: rsm", "rsm: Spot", "vpl importance", "vpls", "vpl gather",
                           "near field", "blur, vertical", "composite"});
    EXPECT_EQ(parts.part_of("gbuffer"), Part::direct);
    EXPECT_EQ(parts.part_of("shadow map: rsm"), Part::direct);
    EXPECT_EQ(parts.part_of("rsm: Spot"), Part::rsm);
    EXPECT_EQ(parts.part_of("vpl importance"), Part::vpls);
    EXPECT_EQ(parts.part_of("vpls"), Part::vpls);
    EXPECT_EQ(parts.part_of("vpl gather"), Part::gather);
    EXPECT_EQ(parts.part_of("near field"), Part::finish);
    EXPECT_EQ(parts.part_of("blur, vertical"), Part::finish);
    EXPECT_EQ(parts.part_of("whatever draws shadow maps"), Part::maps);
}

TEST(MeasuredFrame, SumsPartsFrameByFrame) {
    EXPECT_THAT(example().part(Part::maps).ms, ElementsAre(5.0, 4.5));
    EXPECT_THAT(example().indirect().ms, ElementsAre(6.0, 5.5));
    EXPECT_TRUE(example().part(Part::gather).ms.empty());
}

TEST(PartRow, StandsUnderItsColumns) {
    const auto columns = part_columns({"VPLs", ""});
    const auto row = part_row(256.0, example());
    ASSERT_EQ(row.size(), columns.size());
    EXPECT_EQ(row[0].number, 256.0);
    EXPECT_EQ(row[1].number, 20.0);
    EXPECT_EQ(row[2].number, 21.0);
    for (size_t i = 0; i < columns.size(); ++i) {
        if (columns[i].name == part_name(Part::maps)) {
            EXPECT_EQ(row[i].number, 4.5);
        } else if (columns[i].name == part_name(Part::gather)) {
            EXPECT_EQ(row[i].kind, Cell::Kind::empty);
        }
    }
}

TEST(Experiments, AnUnknownOneListsThoseThereAre) {
    EXPECT_EQ(find_experiment("ism-fig4").name, "ism-fig4");
    try {
        (void)find_experiment("ism-fig5");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        for (const Experiment& experiment : experiments()) {
            EXPECT_THAT(error.what(), HasSubstr(std::string(experiment.name)));
        }
    }
}

TEST(Room, IsClosedAndHoldsWhatItSays) {
    const scene::Scene room = make_room();
    const scene::Pose pose = scene::evaluate_pose(room, 0.0);
    size_t triangles = 0;
    glm::dvec3 flux(0.0);  // of the outer walls' area vectors: zero where they close
    for (const scene::DrawInstance& draw : pose.draws) {
        for (const scene::Primitive& primitive : room.meshes[static_cast<size_t>(draw.mesh)].primitives) {
            triangles += primitive.indices.size() / 3;
            for (size_t i = 0; i < primitive.indices.size(); i += 3) {
                const glm::dvec3 a(primitive.positions[primitive.indices[i]]);
                const glm::dvec3 b(primitive.positions[primitive.indices[i + 1]]);
                const glm::dvec3 c(primitive.positions[primitive.indices[i + 2]]);
                const glm::dvec3 face = glm::cross(b - a, c - a);
                const glm::dvec3 normal(primitive.normals[primitive.indices[i]]);
                // At a sphere's poles a triangle has no area.
                EXPECT_GE(glm::dot(face, normal), 0.0);
                flux += face;
            }
        }
    }
    EXPECT_EQ(triangles, 49176U);
    EXPECT_NEAR(glm::length(flux), 0.0, 1e-4);
    EXPECT_EQ(pose.light_instances.size(), 1U);
    // Walls look inwards: the floor's normal is up.
    EXPECT_EQ(room.meshes[0].primitives[0].normals[0], glm::vec3(0, 1, 0));
    const glm::dvec3 size = scene::world_bounds(room, pose).high - scene::world_bounds(room, pose).low;
    EXPECT_NEAR(size.x, 6.0, 1e-6) << "nothing sticks out of the room";
    EXPECT_NEAR(size.y, 3.0, 1e-6);
    EXPECT_NEAR(size.z, 4.0, 1e-6);
}

}  // namespace
}  // namespace bounce::bench
