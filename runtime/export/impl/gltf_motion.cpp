// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_motion.h"

#include "runtime/export/impl/gltf_parts.h"

#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace lsys {

namespace {

struct Influence {
    std::array<std::uint16_t, 4> joints{};
    std::array<std::uint8_t, 4> weights{};
};

/// Weights add up to 255. glTF requires joint 0 where the weight is 0, and no joint twice.
Influence influence_of(const VertexSegments& segments, const Skin& skin) {
    const std::uint16_t first = skin.joint_of(segments[0]);
    const std::uint16_t second = skin.joint_of(segments[1]);
    return first == second ? Influence{{first}, {255}} : Influence{{first, second}, {128, 127}};
}

/// Weights as bytes that add up to 255: rounded down, and the remainder added to the weights that
/// lost most by rounding.
Influence influence_of(const BoneWeights& weights) {
    Influence influence;
    std::array<float, 4> lost{};
    int left = 255;
    for (std::size_t i = 0; i < lost.size(); ++i) {
        const float wanted = 255.0F * weights.weights[i];
        const int whole = std::min(static_cast<int>(wanted), left);
        influence.weights[i] = static_cast<std::uint8_t>(whole);
        lost[i] = weights.weights[i] > 0.0F ? wanted - static_cast<float>(whole) : -1.0F;
        left -= whole;
    }
    for (; left > 0; --left) {
        const auto largest_loss = std::max_element(lost.begin(), lost.end());
        ++influence.weights[static_cast<std::size_t>(largest_loss - lost.begin())];
        *largest_loss -= 1.0F;
    }
    for (std::size_t i = 0; i < lost.size(); ++i) {
        influence.joints[i] = influence.weights[i] > 0 ? weights.joints[i] : std::uint16_t{0};
    }
    return influence;
}

/// Joints and weights of a vertex.
Influence influence_at(const Mesh& mesh, const GltfMotion& motion, std::size_t vertex) {
    return motion.bones ? influence_of(motion.bones->weights_of(mesh.segments[vertex],
                                                                mesh.positions[vertex]))
                        : influence_of(mesh.segments[vertex], motion.skin);
}

float time_of(const PlantAnimation& poses, std::uint32_t frame) {
    return static_cast<float>(static_cast<double>(frame) /
                              static_cast<double>(poses.frames_per_second));
}

} // namespace

std::uint64_t GltfMotion::time_count() const {
    return bones ? rotation_count() : poses.frame_count;
}
std::uint64_t GltfMotion::translation_count() const {
    return bones ? 0 : std::uint64_t{poses.frame_count} * moving_joints();
}
std::uint64_t GltfMotion::rotation_count() const {
    if (!bones) {
        return std::uint64_t{poses.frame_count} * moving_joints();
    }
    std::uint64_t count = 0;
    for (const Bone& bone : bones->joints) {
        count += bone.keys.size();
    }
    return count;
}

void write_vertex_joints(const Mesh& mesh,
                         std::span<const std::uint32_t> vertices,
                         const GltfMotion& motion,
                         const GltfBytes& write) {
    if (motion.joint_bytes() == 2) {
        write_each(vertices, write,
                   [&](std::uint32_t vertex) { return influence_at(mesh, motion, vertex).joints; });
        return;
    }
    write_each(vertices, write, [&](std::uint32_t vertex) {
        const Influence influence = influence_at(mesh, motion, vertex);
        std::array<std::uint8_t, 4> bytes{};
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            bytes[i] = static_cast<std::uint8_t>(influence.joints[i]);
        }
        return bytes;
    });
}

void write_vertex_weights(const Mesh& mesh,
                          std::span<const std::uint32_t> vertices,
                          const GltfMotion& motion,
                          const GltfBytes& write) {
    write_each(vertices, write,
               [&](std::uint32_t vertex) { return influence_at(mesh, motion, vertex).weights; });
}

void write_inverse_binds(const GltfMotion& motion,
                         const glm::mat4& decode,
                         const GltfBytes& write) {
    write(std::as_bytes(std::span(&decode, 1)));
    const auto put = [&](const glm::dvec3& base, const glm::dquat& frame) {
        const glm::dquat back = glm::conjugate(glm::normalize(frame));
        glm::dmat4 inverse = glm::mat4_cast(back);
        inverse[3] = glm::dvec4(back * -base, 1.0);
        const glm::mat4 matrix(inverse * glm::dmat4(decode));
        write(std::as_bytes(std::span(&matrix, 1)));
    };
    if (motion.bones) {
        for (const Bone& bone : std::span(motion.bones->joints).subspan(1)) {
            put(bone.place, bone.frame);
        }
        return;
    }
    for (const std::uint32_t segment : motion.skin.segments) {
        const SegmentPlace& place = motion.poses.frame(0)[segment];
        put(glm::dvec3(place.base), glm::dquat(place.frame));
    }
}

void write_times(const GltfMotion& motion, const GltfBytes& write) {
    std::vector<float> times;
    if (motion.bones) {
        for (const Bone& bone : motion.bones->joints) {
            for (const std::uint32_t key : bone.keys) {
                times.push_back(time_of(motion.poses, key));
            }
        }
        write(std::as_bytes(std::span<const float>(times)));
        return;
    }
    for (std::uint32_t i = 0; i < motion.poses.frame_count; ++i) {
        times.push_back(time_of(motion.poses, i));
    }
    write(std::as_bytes(std::span<const float>(times)));
}

void write_translations(const GltfMotion& motion, const GltfBytes& write) {
    std::vector<glm::vec3> bases;
    for (const std::uint32_t segment : motion.skin.segments) {
        bases.clear();
        for (std::uint32_t i = 0; i < motion.poses.frame_count; ++i) {
            bases.push_back(motion.poses.frame(i)[segment].base);
        }
        write(std::as_bytes(std::span<const glm::vec3>(bases)));
    }
}

void write_rotations(const GltfMotion& motion, const GltfBytes& write) {
    std::vector<glm::quat> rotations;
    std::vector<std::array<float, 4>> ordered;
    if (motion.bones) {
        for (const Bone& bone : motion.bones->joints) {
            for (const std::uint32_t key : bone.keys) {
                const glm::quat& q = bone.rotations[key];
                ordered.push_back({q.x, q.y, q.z, q.w});
            }
        }
        write(std::as_bytes(std::span<const std::array<float, 4>>(ordered)));
        return;
    }
    for (const std::uint32_t segment : motion.skin.segments) {
        joint_rotations(motion.poses, segment, rotations);
        ordered.clear();
        for (const glm::quat& q : rotations) {
            ordered.push_back({q.x, q.y, q.z, q.w});
        }
        write(std::as_bytes(std::span<const std::array<float, 4>>(ordered)));
    }
}

namespace {

/// Nodes of Bones: each joint is a child of the joint of the piece from which its piece grows.
void put_bone_nodes(JsonWriter& json, const Bones& bones, std::size_t first) {
    std::vector<std::vector<std::size_t>> children(bones.joints.size());
    for (std::size_t i = 1; i < bones.joints.size(); ++i) {
        children[bones.joints[i].parent].push_back(first + i);
    }
    for (std::size_t i = 0; i < bones.joints.size(); ++i) {
        const Bone& bone = bones.joints[i];
        json.object().member("name", i == 0 ? std::string("joints")
                                            : fmt::format("segment {}", bone.segment));
        if (i > 0) {
            const glm::vec3& at = bone.translation;
            const glm::quat& q = bone.rotations.front();
            json.member("translation", {at.x, at.y, at.z});
            json.member("rotation", {q.x, q.y, q.z, q.w});
        }
        if (!children[i].empty()) {
            json.array("children");
            for (const std::size_t child : children[i]) {
                json.value(child);
            }
            json.end();
        }
        json.end();
    }
}

/// Accessors of times and rotations, which are in the views `times` and `rotations`.
void put_bone_accessors(JsonWriter& json,
                        const GltfMotion& motion,
                        std::size_t times,
                        std::size_t rotations) {
    std::size_t key = 0;
    for (const Bone& bone : motion.bones->joints) {
        if (bone.keys.empty()) {
            continue;
        }
        const std::size_t count = bone.keys.size();
        begin_accessor(json, {times, key * sizeof(float), kGltfFloat, count, "SCALAR"})
            .member("min", {static_cast<double>(time_of(motion.poses, bone.keys.front()))})
            .member("max", {static_cast<double>(time_of(motion.poses, bone.keys.back()))})
            .end();
        begin_accessor(json, {rotations, key * sizeof(glm::quat), kGltfFloat, count, "VEC4"}).end();
        key += count;
    }
}

/// Channels and samplers of Bones. `accessor`: number of the first accessor of times.
void put_bone_animation(JsonWriter& json,
                        const Bones& bones,
                        std::size_t first_node,
                        std::size_t accessor) {
    if (std::all_of(bones.joints.begin(), bones.joints.end(),
                    [](const Bone& bone) { return bone.keys.empty(); })) {
        return; // glTF forbids animations without channels
    }
    json.array("animations").object().member("name", "motion").array("channels");
    std::size_t sampler = 0;
    for (std::size_t i = 0; i < bones.joints.size(); ++i) {
        if (!bones.joints[i].keys.empty()) {
            json.object().member("sampler", sampler++).object("target");
            json.member("node", first_node + i).member("path", "rotation").end().end();
        }
    }
    json.end().array("samplers");
    for (std::size_t i = 0; i < sampler; ++i) {
        json.object().member("input", accessor + 2 * i);
        json.member("output", accessor + 2 * i + 1).end();
    }
    json.end().end().end();
}

} // namespace

void put_joint_nodes(JsonWriter& json, const GltfMotion& motion, std::size_t first) {
    if (motion.bones) {
        put_bone_nodes(json, *motion.bones, first);
        return;
    }
    json.object().member("name", "joints");
    if (motion.moving_joints() > 0) {
        json.array("children");
        for (std::size_t i = 0; i < motion.moving_joints(); ++i) {
            json.value(first + 1 + i);
        }
        json.end();
    }
    json.end();
    std::vector<glm::quat> rotations;
    for (const std::uint32_t segment : motion.skin.segments) {
        const glm::vec3& base = motion.poses.frame(0)[segment].base;
        joint_rotations(motion.poses, segment, rotations);
        const glm::quat& q = rotations.front();
        json.object().member("name", fmt::format("segment {}", segment));
        json.member("translation", {base.x, base.y, base.z});
        json.member("rotation", {q.x, q.y, q.z, q.w}).end();
    }
}

void put_motion_accessors(JsonWriter& json, const GltfMotion& motion, std::size_t first_view) {
    const std::uint32_t frames = motion.poses.frame_count;
    const std::size_t times = first_view + 1;
    const std::size_t translations = times + (motion.time_count() > 0 ? 1 : 0);
    const std::size_t rotations = translations + (motion.translation_count() > 0 ? 1 : 0);
    begin_accessor(json, {first_view, {}, kGltfFloat, motion.joint_count(), "MAT4"}).end();
    if (motion.bones) {
        put_bone_accessors(json, motion, times, rotations);
        return;
    }
    begin_accessor(json, {times, {}, kGltfFloat, frames, "SCALAR"})
        .member("min", {0})
        .member("max", {static_cast<double>(time_of(motion.poses, frames - 1))})
        .end();
    const auto put_channels = [&](std::size_t view, std::size_t bytes, const char* type) {
        for (std::size_t i = 0; i < motion.moving_joints(); ++i) {
            begin_accessor(json, {view, i * frames * bytes, kGltfFloat, frames, type}).end();
        }
    };
    put_channels(translations, sizeof(glm::vec3), "VEC3");
    put_channels(rotations, sizeof(glm::quat), "VEC4");
}

void put_skin_and_animation(JsonWriter& json,
                            const GltfMotion& motion,
                            std::size_t first_node,
                            std::size_t accessor) {
    json.array("skins").object().member("name", "plant");
    json.member("inverseBindMatrices", accessor).member("skeleton", first_node).array("joints");
    for (std::size_t i = 0; i < motion.joint_count(); ++i) {
        json.value(first_node + i);
    }
    json.end().end().end();
    if (motion.bones) {
        put_bone_animation(json, *motion.bones, first_node, accessor + 1);
        return;
    }
    const std::size_t moving = motion.moving_joints();
    if (moving == 0) { // glTF forbids animations without channels
        return;
    }
    json.array("animations").object().member("name", "motion").array("channels");
    for (std::size_t i = 0; i < 2 * moving; ++i) {
        json.object().member("sampler", i).object("target");
        json.member("node", first_node + 1 + i % moving);
        json.member("path", i < moving ? "translation" : "rotation").end().end();
    }
    json.end().array("samplers");
    for (std::size_t i = 0; i < 2 * moving; ++i) {
        json.object().member("input", accessor + 1).member("output", accessor + 2 + i).end();
    }
    json.end().end().end();
}

} // namespace lsys
