#include "runtime/physics/animation.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

using namespace lsys;
using namespace lsys::test;

TEST_CASE("an animation is the poses at its frames") {
    const Skeleton plant = tree(1, 3);
    PhysicsOptions options;
    options.threads = 1;
    options.wind = {{4.0F, 0.0F, 1.0F}, 0.5F};
    PlantPhysics recorded(plant, options);
    const PlantAnimation animation = record(recorded, 5, 20.0F); // three steps of 1/60 s a frame
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

TEST_CASE("between frames no step is longer than the plant's, which stays as it was") {
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
