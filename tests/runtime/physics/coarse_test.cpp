// SPDX-License-Identifier: MIT
// Falling plants settle in stages: first coarse plants, then the whole plant from their pose.
#include "runtime/physics/impl/coarse.h"
#include "runtime/physics/physics.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

/// A limp stalk of five segments, with a shorter stalk at the tip of each segment, and so on: five
/// orders of stalks, 3905 segments.
Skeleton limp_plant() {
    Skeleton plant;
    std::vector<std::uint32_t> tips = {kNoSegment};
    float scale = 1.0F;
    for (int order = 0; order < 5; ++order) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t tip : tips) {
            std::uint32_t last = tip;
            for (int i = 0; i < 5; ++i) {
                const auto turn = static_cast<float>(order + i) * 1.3F;
                const glm::quat frame =
                    glm::angleAxis(turn, glm::vec3(0.0F, 1.0F, 0.0F)) * leaning(0.25F);
                last = add_segment(plant, last, frame,
                                   rod(0.3F * scale, 0.005F, 2e-3F * scale, 0.05F * scale));
                next.push_back(last);
            }
        }
        tips = next;
        scale *= 0.6F;
    }
    return plant;
}

/// A dragon curve in the plane z = 0 from 1 m above the ground: 2^order limp segments of 1 m, each
/// at a right angle to the one before it, and no branch.
Skeleton limp_curve(std::uint32_t order) {
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    float turn = 0.0F;
    for (std::uint32_t i = 0; i < (1U << order); ++i) {
        last = add_segment(plant, last, leaning(turn), rod(1.0F, 0.05F, 2e4F, 5.0F));
        const std::uint32_t corner = i + 1;
        const std::uint32_t lowest_bit = corner & (~corner + 1);
        const bool left = (corner & (lowest_bit << 1U)) != 0;
        turn += left ? 1.5707963F : -1.5707963F;
    }
    float lowest = 0.0F;
    for (const Segment& segment : plant.segments) {
        lowest = std::min(lowest, tip(segment).y);
    }
    for (Segment& segment : plant.segments) {
        segment.base.y += 1.0F - lowest;
    }
    return plant;
}

/// Sum over segments of mass times height of the centre of mass, kg m.
double mass_times_height(const Skeleton& plant) {
    double sum = 0.0;
    for (const Segment& segment : plant.segments) {
        sum += static_cast<double>(segment.mass) *
               static_cast<double>(0.5F * (segment.base.y + tip(segment).y));
    }
    return sum;
}

} // namespace

TEST_CASE("a coarse plant bears the loads of the whole one") {
    const Bodies whole = make_bodies(limp_plant(), 0.2);
    const std::vector<CoarsePlant> stages = coarse_plants(whole);
    REQUIRE(stages.size() == 1);
    double mass = 0.0;
    for (const Body& body : whole.bodies) {
        mass += body.mass;
    }
    for (const CoarsePlant& stage : stages) {
        const std::vector<Body>& bodies = stage.bodies.bodies;
        REQUIRE(bodies.size() == stage.run_bodies.size()); // each run is one body
        REQUIRE(bodies.size() == stage.run_ends.size());
        REQUIRE(bodies.size() >= 100);
        CHECK(bodies.size() * 3 <= whole.bodies.size());
        CHECK(stage.bodies.level_ends.back() == bodies.size());
        // Recompute Body::moment from the bodies of the stage alone.
        std::vector<double> carried(bodies.size(), 0.0);
        double stage_mass = 0.0;
        for (std::size_t b = bodies.size(); b-- > 0;) {
            const Body& body = bodies[b];
            stage_mass += body.mass;
            carried[b] += body.mass;
            glm::dvec3 moment = body.mass * body.centre;
            for (std::uint32_t c = body.first_child; c < body.first_child + body.child_count; ++c) {
                REQUIRE(bodies[c].parent == b);
                carried[b] += carried[c];
                moment += carried[c] * bodies[c].offset;
            }
            const Body& original = whole.bodies[stage.run_bodies[b]];
            CHECK(glm::length(moment - original.moment) <= 1e-12 * mass);
            CHECK(body.spring == original.spring);
            const bool is_root = original.parent == kNoSegment;
            CHECK((body.parent == kNoSegment) == is_root);
            CHECK((is_root || stage.run_bodies[body.parent] == original.parent));
        }
        CHECK(stage_mass == Approx(mass));
    }
    CHECK(coarse_plants(make_bodies(Skeleton{}, 0.2)).empty());
}

TEST_CASE("the runs of a curve have the masses, contacts and energy of the joints of the curve") {
    const Bodies whole = make_bodies(limp_curve(13), 0.2);
    const std::vector<CoarsePlant> stages = coarse_plants(whole);
    REQUIRE(stages.size() == 2);
    double mass = 0.0;
    for (const Body& body : whole.bodies) {
        mass += body.mass;
    }
    std::uint32_t members = 0;
    for (const CoarsePlant& stage : stages) {
        const std::vector<Body>& bodies = stage.bodies.bodies;
        REQUIRE(bodies.size() == stage.run_ends.size());
        REQUIRE(stage.run_ends.back() == stage.run_bodies.size());
        CHECK(bodies.size() * 3 <= whole.bodies.size());
        CHECK(stage.run_bodies.size() * 10 >= whole.bodies.size() * 9);
        members = stage.run_ends.front();
        double stage_mass = 0.0;
        double energy = 0.0; // of the stage bent by 0.01 at each joint
        std::vector<BodyPose> runs(bodies.size());
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            stage_mass += bodies[b].mass;
            energy += 0.5e-4 * bodies[b].spring;
            runs[b].turn =
                glm::angleAxis(0.01 * static_cast<double>(b + 1), glm::dvec3(0.0, 0.0, 1.0));
            REQUIRE(bodies[b].parent == (b == 0 ? kNoSegment : b - 1));
            REQUIRE(bodies[b].contact_count <= std::min(members, 14U));
            REQUIRE((bodies[b].contact_count > 0 || bodies[b].contact.spring > 0.0));
        }
        CHECK(stage_mass == Approx(mass));
        // First moment of mass of the root: its own mass at its centre, and the mass of all other
        // runs at its end.
        const Body& root = bodies.front();
        const glm::dvec3 moment =
            root.mass * root.centre + (stage_mass - root.mass) * bodies[1].offset;
        CHECK(glm::length(moment - root.moment) <= 1e-9 * mass);
        // Spread over the members, the bend has the same energy, and coarse_poses() returns the
        // poses of the runs.
        std::vector<BodyPose> poses(whole.bodies.size());
        spread_poses(stage, runs, poses);
        double spread = 0.0;
        glm::dquat before(1.0, 0.0, 0.0, 0.0);
        for (const std::uint32_t b : stage.run_bodies) {
            const double half = std::acos(std::min(std::abs(glm::dot(before, poses[b].turn)), 1.0));
            spread += 0.5 * whole.bodies[b].spring * 4.0 * half * half;
            before = poses[b].turn;
        }
        // Approximate, because a member in the middle bends with two joints of the stage.
        CHECK(spread == Approx(energy).epsilon(0.08));
        const std::vector<BodyPose> back = coarse_poses(stage, poses);
        for (std::size_t b = 2; b + 2 < bodies.size(); ++b) {
            REQUIRE(std::abs(glm::dot(back[b].turn, runs[b].turn)) >= 1.0 - 1e-7);
        }
    }
}

TEST_CASE("long curves without branches settle in few rounds") {
    // Without stages, settling took 300 and 200 rounds.
    struct Curve {
        std::uint32_t order, rounds;
    };
    for (const auto& [order, rounds] : {Curve{12, 80}, Curve{14, 20}}) {
        const Skeleton plant = limp_curve(order);
        std::string expected;
        for (const std::uint32_t threads : {1U, 3U}) {
            PhysicsOptions options;
            options.threads = threads;
            PlantPhysics physics(plant, options);
            CAPTURE(order, threads);
            REQUIRE(physics.settle(1e-6, rounds));
            CHECK(physics.energy() < 0.0);
            Skeleton bent;
            physics.pose(bent);
            const std::string seen = place_bytes(bent) + std::to_string(physics.energy());
            expected = threads == 1 ? seen : expected;
            CHECK((seen == expected));
            for (const Segment& segment : bent.segments) {
                REQUIRE(tip(segment).y >= -1e-3F);
            }
            CHECK(mass_times_height(bent) < 0.1 * mass_times_height(plant));
            const double settled = physics.energy();
            CHECK(physics.settle(1e-6, rounds));
            CHECK(physics.energy() <= settled);
        }
    }
}

TEST_CASE("twigs keep their bend when poses are completed") {
    const Bodies plant = make_bodies(limp_plant(), 0.2);
    const std::size_t count = plant.bodies.size();
    std::vector<BodyPose> before(count);
    for (std::size_t b = 0; b < count; ++b) { // each joint is bent by 0.1 rad
        const std::uint32_t parent = plant.bodies[b].parent;
        const glm::dquat turn = glm::angleAxis(0.1, glm::dvec3(0.0, 0.0, 1.0));
        before[b].turn = parent == kNoSegment ? turn : glm::normalize(before[parent].turn * turn);
    }
    std::vector<char> known(count, 0);
    std::vector<BodyPose> poses(count);
    known[0] = 1; // the root turns about another axis
    poses[0].turn = glm::angleAxis(0.7, glm::dvec3(1.0, 0.0, 0.0));
    complete_poses(plant, known, before, false, poses);
    for (std::size_t b = 1; b < count; ++b) {
        const std::uint32_t parent = plant.bodies[b].parent;
        const glm::dquat bend = glm::conjugate(poses[parent].turn) * poses[b].turn;
        REQUIRE(std::abs(bend.w - std::cos(0.05)) <= 1e-12);
        REQUIRE(std::abs(bend.z - std::sin(0.05)) <= 1e-12);
        const glm::dvec3 joint = poses[parent].shift - poses[b].shift +
                                 poses[parent].turn * plant.bodies[b].offset -
                                 plant.bodies[b].offset;
        REQUIRE(glm::length(joint) <= 1e-12);
    }
}

TEST_CASE(
    "a large falling plant settles in few rounds, to the same pose for any number of threads") {
    const Skeleton plant = limp_plant();
    REQUIRE(plant.segments.size() >= kMinCoarsened);
    std::string expected;
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        PhysicsOptions options;
        options.threads = threads;
        PlantPhysics physics(plant, options);
        const double energy = physics.energy();
        REQUIRE(physics.settle(1e-6, 60));
        CHECK(physics.energy() < energy);
        Skeleton bent;
        physics.pose(bent);
        const std::string seen = place_bytes(bent) + std::to_string(physics.energy());
        expected = threads == 1 ? seen : expected;
        CHECK((seen == expected));
        for (const Segment& segment : bent.segments) {
            REQUIRE(segment.base.y >= -1e-5F);
            REQUIRE(tip(segment).y >= -1e-5F);
        }
        CHECK(mass_times_height(bent) < 0.2 * mass_times_height(plant));
        // Further rounds do not increase the energy.
        const double settled = physics.energy();
        CHECK(physics.settle(1e-6, 60));
        CHECK(physics.energy() <= settled);
    }
}

TEST_CASE("the number of rounds of settling depends on the size of the plant") {
    CHECK(settle_rounds(0) == 10'000);
    CHECK(settle_rounds(100) == 10'000);
    CHECK(settle_rounds(10'000) == 300);
    CHECK(settle_rounds(100'000) == 30);
    CHECK(settle_rounds(100'000'000) == 30);
}
