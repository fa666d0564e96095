// SPDX-License-Identifier: MIT
#include "runtime/physics/animation.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace lsys;
using namespace lsys::test;

TEST_CASE("an animation has the poses at its frames") {
    const Skeleton plant = tree(1, 3);
    PhysicsOptions options;
    options.threads = 1;
    options.wind = {{4.0F, 0.0F, 1.0F}, 0.5F};
    PlantPhysics recorded(plant, options);
    const PlantAnimation animation = record(recorded, 5, 20.0F); // three steps of 1/60 s per frame
    CHECK(animation.frame_count == 5);
    CHECK(animation.segment_count == plant.segments.size());
    CHECK(animation.frames_per_second == 20.0F);
    CHECK(animation.places.size() * sizeof(SegmentPlace) ==
          animation_bytes(plant.segments.size(), 5));
    CHECK(recorded.time() == Approx(4.0 / 20.0));

    PlantPhysics stepped(plant, options);
    Skeleton pose;
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        stepped.pose(pose);
        for (std::size_t i = 0; i < pose.segments.size(); ++i) {
            const SegmentPlace& place = animation.frame(frame)[i];
            REQUIRE(glm::length(place.base - pose.segments[i].base) < 1e-6F);
            REQUIRE(glm::length(place.frame - pose.segments[i].frame) < 1e-6F);
        }
        for (int step = 0; step < 3; ++step) {
            stepped.step();
        }
    }
    CHECK(glm::length(animation.frame(4)[5].base - animation.frame(0)[5].base) > 1e-5F);
}

TEST_CASE(
    "steps between frames are at most as long as the step of the options, which does not change") {
    const Skeleton plant = tree(0, 2);
    for (const float rate : {7.0F, 24.0F, 59.0F, 60.0F, 144.0F, 1000.0F}) {
        PhysicsOptions options;
        options.threads = 1;
        PlantPhysics physics(plant, options);
        const PlantAnimation animation = record(physics, 4, rate);
        CHECK(physics.time() == Approx(3.0 / static_cast<double>(rate)));
        CHECK(physics.options().time_step == options.time_step);
        physics.step();
        CHECK(physics.time() == Approx(3.0 / static_cast<double>(rate) + 1.0 / 60.0));
    }
    PlantPhysics physics(plant, {});
    CHECK(record(physics, 0, 24.0F).places.empty());
    CHECK(record(physics, 2, 0.0F).frames_per_second == 24.0F);
    PlantPhysics nothing(Skeleton{}, {});
    CHECK(record(nothing, 3, 24.0F).places.empty());
}

TEST_CASE("objects and corners stay above the ground in all frames") {
    // A limp stalk with large leaves all around; tips of leaves reach the ground first.
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < 12; ++i) {
        last = add_segment(plant, last, leaning(0.05F * static_cast<float>(i)),
                           rod(0.2F, 0.005F, 0.02F, 0.02F));
        for (std::uint32_t side = 0; side < 3; ++side) {
            PlacedObject leaf;
            leaf.kind = TurtleOperation::Leaf;
            leaf.position = tip(plant.segments[last]);
            leaf.frame = glm::angleAxis(2.1F * static_cast<float>(side) + static_cast<float>(i),
                                        glm::vec3(0.0F, 1.0F, 0.0F)) *
                         leaning(1.2F);
            leaf.size = 0.3F;
            leaf.parent = last;
            plant.objects.push_back(leaf);
        }
        Polygon polygon;
        polygon.parent = last;
        polygon.first_corner = static_cast<std::uint32_t>(plant.corners.size());
        polygon.corner_count = 3;
        for (const glm::vec3& corner :
             {glm::vec3(0.0F), glm::vec3(0.1F, 0.0F, -0.25F), glm::vec3(0.1F, 0.0F, 0.25F)}) {
            plant.corners.push_back(tip(plant.segments[last]) + corner);
        }
        plant.polygons.push_back(polygon);
    }
    const auto lowest_in = [](const Skeleton& pose) {
        float lowest = 0.0F;
        for (const PlacedObject& object : pose.objects) {
            const float end = object.position.y + object.size * heading(object.frame).y;
            lowest = std::min({lowest, object.position.y, end});
        }
        for (const glm::vec3& corner : pose.corners) {
            lowest = std::min(lowest, corner.y);
        }
        return lowest;
    };
    for (const bool settled : {false, true}) {
        for (const bool ground : {true, false}) {
            PhysicsOptions options;
            options.threads = 1;
            options.damping = 0.01F;
            options.ground = ground;
            options.wind = {{3.0F, 0.0F, 0.0F}, 0.8F};
            PlantPhysics physics(plant, options);
            if (settled) {
                static_cast<void>(physics.settle(1e-6, 300));
            }
            Skeleton first; // the exported skeleton, which moves with the frames
            physics.pose(first);
            const PlantAnimation animation = record(physics, 60, 24.0F);
            Skeleton pose;
            float lowest = 0.0F;
            for (std::uint32_t frame = 0; frame < 60; ++frame) {
                pose_at(first, animation.frame(frame), pose);
                lowest = std::min(lowest, lowest_in(pose));
                for (std::size_t i = 1; i < pose.segments.size(); ++i) { // segments stay joined
                    REQUIRE(glm::length(pose.segments[i].base - tip(pose.segments[i - 1])) < 1e-4F);
                }
            }
            CAPTURE(settled, ground, lowest);
            CHECK((ground ? lowest >= -1e-5F : lowest < -0.1F));
        }
    }
    PhysicsOptions options;
    options.threads = 1;
    options.wind = {{3.0F, 0.0F, 0.0F}, 0.8F};
    PlantPhysics physics(plant, options);
    const PlantLoop loop = record_loop(physics, 49, 24.0F);
    Skeleton pose;
    for (std::uint32_t frame = 0; frame < 49; ++frame) {
        pose_at(plant, loop.animation.frame(frame), pose);
        REQUIRE(lowest_in(pose) >= -1e-5F);
    }
}

TEST_CASE("a loop ends at its first pose with its first velocity") {
    const Skeleton plant = tree(1, 3);
    PhysicsOptions options;
    options.threads = 1;
    options.wind = {{4.0F, 0.0F, 1.0F}, 0.5F};
    for (const std::uint32_t frames : {25U, 62U}) {
        PlantPhysics physics(plant, options);
        const PlantLoop loop = record_loop(physics, frames, 20.0F);
        const PlantAnimation& clip = loop.animation;
        REQUIRE(clip.frame_count == frames);
        CHECK(physics.options().gust_period == 0.0F);
        CHECK(physics.options().time_step == options.time_step);
        const auto base = [&](std::uint32_t frame, std::size_t segment) {
            return glm::dvec3(clip.frame(frame)[segment].base);
        };
        double max_distance = 0.0; // m, max distance from the first frame
        double step = 0.0;         // m/frame, max change of the velocity between frames
        double seam = 0.0;         // m/frame, max change of the velocity at the seam
        for (std::size_t i = 0; i < plant.segments.size(); ++i) {
            REQUIRE(clip.frame(0)[i].base == clip.frame(frames - 1)[i].base);
            REQUIRE(clip.frame(0)[i].frame == clip.frame(frames - 1)[i].frame);
            for (std::uint32_t frame = 1; frame + 1 < frames; ++frame) {
                max_distance = std::max(max_distance, glm::length(base(frame, i) - base(0, i)));
                step = std::max(step, glm::length(base(frame + 1, i) - 2.0 * base(frame, i) +
                                                  base(frame - 1, i)));
            }
            seam = std::max(seam, glm::length(base(1, i) - 2.0 * base(0, i) + base(frames - 2, i)));
            const std::uint32_t parent = plant.segments[i].parent;
            if (parent < i) { // segments stay joined
                const SegmentPlace& at = clip.frame(frames / 2)[parent];
                const glm::vec3 end = at.base + plant.segments[parent].length * heading(at.frame);
                REQUIRE(glm::length(end - clip.frame(frames / 2)[i].base) < 1e-4F);
            }
        }
        CHECK(max_distance > 0.0);
        CHECK(seam <= 3.0 * step + 1e-6);
        CHECK(loop.mismatch < 0.05);
    }
}

TEST_CASE("gusts repeat after their period") {
    const Skeleton plant = tree(0, 1);
    PhysicsOptions options;
    options.threads = 1;
    options.time_step = 0.05F;
    options.wind = {{3.0F, 0.0F, 0.0F}, 0.8F};
    options.gust_period = 2.0F;
    PlantPhysics physics(plant, options);
    const auto move_on = [&] {
        for (int step = 0; step < 40; ++step) {
            physics.step();
        }
        Skeleton pose;
        physics.pose(pose);
        return tip(pose.segments.back());
    };
    for (int i = 0; i < 100; ++i) {
        move_on();
    }
    const glm::vec3 before = move_on();
    CHECK(glm::length(move_on() - before) < 1e-4F);
    options.gust_period = 0.0F;
    physics.set(options);
    CHECK(move_on() != before);
}

TEST_CASE("placing a plant at its pose changes nothing") {
    Skeleton plant = tree(1, 3);
    PlacedObject leaf;
    leaf.kind = TurtleOperation::Leaf;
    leaf.parent = 2;
    leaf.position = tip(plant.segments[2]);
    plant.objects.push_back(leaf);
    plant.corners = {{0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    plant.polygons.push_back({.first_corner = 0, .corner_count = 3, .parent = 1});
    PhysicsOptions options;
    options.threads = 1;
    options.ground = false;
    options.wind.velocity = {6.0F, 0.0F, 2.0F};
    PlantPhysics physics(plant, options);
    const PlantAnimation clip = record(physics, 5, 20.0F);
    Skeleton expected;
    physics.pose(expected);
    Skeleton posed;
    pose_at(plant, clip.frame(4), posed);
    CHECK(glm::length(posed.objects[0].position - expected.objects[0].position) < 1e-5F);
    CHECK(glm::length(posed.objects[0].frame - expected.objects[0].frame) < 1e-5F);
    CHECK(glm::length(posed.segments[5].base - expected.segments[5].base) < 1e-5F);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(glm::length(posed.corners[i] - expected.corners[i]) < 1e-5F);
    }
}
