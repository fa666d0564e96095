// SPDX-License-Identifier: MIT
// Joints and keys of light skeletons. tests/export compares the posed meshes with the frames.
#include "runtime/export/impl/bones.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cstdint>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

/// A clip of a bending line: each segment turns by the same angle relative to the one before it.
PlantAnimation bending(const Skeleton& plant, float angle) {
    PlantAnimation clip;
    clip.frame_count = 5;
    clip.segment_count = static_cast<std::uint32_t>(plant.segments.size());
    for (std::uint32_t frame = 0; frame < clip.frame_count; ++frame) {
        glm::vec3 base(0.0F);
        for (std::uint32_t i = 0; i < clip.segment_count; ++i) {
            const float part = static_cast<float>(frame) / static_cast<float>(clip.frame_count - 1);
            const glm::quat frame_of = leaning(part * angle * static_cast<float>(i + 1));
            clip.places.push_back({base, frame_of});
            base += plant.segments[i].length * heading(frame_of);
        }
    }
    return clip;
}

Skeleton line(std::uint32_t count) {
    Skeleton plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < count; ++i) {
        last = add_segment(plant, last, leaning(0.0F), rod(0.1F, 0.05F, 1.0F, 1.0F));
    }
    return plant;
}

} // namespace

TEST_CASE("a plant without motion has one joint without keys") {
    const Skeleton plant = line(6);
    const Bones bones = make_bones(plant, bending(plant, 0.0F), 16);
    REQUIRE(bones.joints.size() == 1);
    CHECK(bones.joints[0].keys.empty());
    CHECK(bones.weights_of({3, 4}, {0.0F, 0.4F, 0.0F}).weights[0] == 1.0F);
    CHECK(bones.weights_of({kNoSegment, kNoSegment}, {}).weights[0] == 1.0F);
}

TEST_CASE("each joint is at the base of its segment, relative to the joint of its parent") {
    const Skeleton plant = line(6);
    const Bones bones = make_bones(plant, bending(plant, 0.4F), 4);
    REQUIRE(bones.joints.size() == 4);
    for (std::size_t i = 1; i < bones.joints.size(); ++i) {
        const Bone& bone = bones.joints[i];
        const Bone& parent = bones.joints[bone.parent];
        CHECK(bone.place == glm::dvec3(plant.segments[bone.segment].base));
        const glm::dvec3 from_parent = parent.frame * glm::dvec3(bone.translation);
        CHECK(glm::length(parent.place + from_parent - bone.place) < 1e-6);
    }
}

TEST_CASE("the weight of a joint grows linearly from its base to the middle of its piece") {
    const Skeleton plant = line(4); // of segments of 0.1 m
    PlantAnimation clip = bending(plant, 0.0F);
    const std::size_t last = clip.places.size() - plant.segments.size();
    for (std::uint32_t i = 0; i < plant.segments.size(); ++i) { // the line turns about its base
        const glm::quat turned = leaning(0.5F);
        clip.places[last + i] = {plant.segments[i].base.y * heading(turned), turned};
    }
    const Bones bones = make_bones(plant, clip, 2);
    REQUIRE(bones.joints.size() == 2);
    REQUIRE(bones.joints[1].segment == 0);
    // The weight of joint 1 at a part of a segment; joint 0, which stands still, has the rest.
    const auto weight_at = [&](std::uint32_t segment, float part) {
        const float height = plant.segments[segment].base.y + part * 0.1F;
        const BoneWeights found = bones.weights_of({segment, segment}, {0.0F, height, 0.0F});
        float sum = 0.0F;
        float weight = 0.0F;
        for (std::size_t i = 0; i < found.weights.size(); ++i) {
            sum += found.weights[i];
            weight += found.joints[i] == 1 ? found.weights[i] : 0.0F;
        }
        CHECK(sum == Approx(1.0F));
        return weight;
    };
    CHECK(weight_at(0, 0.0F) == Approx(0.0F).margin(1e-6));
    CHECK(weight_at(0, 0.5F) == Approx(0.25F));
    CHECK(weight_at(1, 0.0F) == Approx(0.5F));
    CHECK(weight_at(1, 0.5F) == Approx(0.75F));
    CHECK(weight_at(2, 0.0F) == Approx(1.0F));
    CHECK(weight_at(3, 0.5F) == Approx(1.0F));
}

TEST_CASE("keys that interpolation gives are omitted") {
    const Skeleton plant = line(1);
    PlantAnimation clip = bending(plant, 0.4F); // turns at a constant rate
    const Bones bones = make_bones(plant, clip, 4);
    REQUIRE(bones.joints.size() == 2);
    CHECK(bones.joints[1].keys == std::vector<std::uint32_t>{0, 4});
    clip.places[2].frame = leaning(0.5F);
    CHECK(make_bones(plant, clip, 4).joints[1].keys.size() >= 4);
}
