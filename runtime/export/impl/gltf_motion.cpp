#include "runtime/export/impl/gltf_motion.h"

#include "runtime/export/impl/gltf_parts.h"

#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kChunk = 16384; // vertices

struct Influence {
    std::array<std::uint16_t, 4> joints{};
    std::array<std::uint8_t, 4> weights{};
};

/// Weights add up to 255. glTF wants joint 0 where the weight is 0, and no joint twice.
Influence influence_of(const VertexSegments& segments, const Skin& skin) {
    const std::uint16_t first = skin.joint_of(segments[0]);
    const std::uint16_t second = skin.joint_of(segments[1]);
    return first == second ? Influence{{first}, {255}} : Influence{{first, second}, {128, 127}};
}

template <typename Item, typename ItemOf>
void write_vertices(const Mesh& mesh,
                    std::span<const std::uint32_t> vertices,
                    const GltfBytes& write,
                    const ItemOf& item_of) {
    std::vector<std::array<Item, 4>> chunk;
    for (std::size_t first = 0; first < vertices.size(); first += kChunk) {
        chunk.clear();
        for (const std::uint32_t vertex :
             vertices.subspan(first, std::min(kChunk, vertices.size() - first))) {
            chunk.push_back(item_of(mesh.segments[vertex]));
        }
        write(std::as_bytes(std::span<const std::array<Item, 4>>(chunk)));
    }
}

float time_of(const PlantAnimation& poses, std::uint32_t frame) {
    return static_cast<float>(static_cast<double>(frame) /
                              static_cast<double>(poses.frames_per_second));
}

} // namespace

void write_vertex_joints(const Mesh& mesh,
                         std::span<const std::uint32_t> vertices,
                         const GltfMotion& motion,
                         const GltfBytes& write) {
    if (motion.joint_bytes() == 2) {
        write_vertices<std::uint16_t>(mesh, vertices, write, [&](const VertexSegments& segments) {
            return influence_of(segments, motion.skin).joints;
        });
        return;
    }
    write_vertices<std::uint8_t>(mesh, vertices, write, [&](const VertexSegments& segments) {
        std::array<std::uint8_t, 4> bytes{};
        const Influence influence = influence_of(segments, motion.skin);
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
    write_vertices<std::uint8_t>(mesh, vertices, write, [&](const VertexSegments& segments) {
        return influence_of(segments, motion.skin).weights;
    });
}

void write_inverse_binds(const GltfMotion& motion,
                         const glm::mat4& decode,
                         const GltfBytes& write) {
    write(std::as_bytes(std::span(&decode, 1)));
    for (const std::uint32_t segment : motion.skin.segments) {
        const SegmentPlace& place = motion.poses.frame(0)[segment];
        const glm::dquat back = glm::conjugate(glm::normalize(glm::dquat(place.frame)));
        glm::dmat4 inverse = glm::mat4_cast(back);
        inverse[3] = glm::dvec4(back * -glm::dvec3(place.base), 1.0);
        const glm::mat4 matrix(inverse * glm::dmat4(decode));
        write(std::as_bytes(std::span(&matrix, 1)));
    }
}

void write_times(const GltfMotion& motion, const GltfBytes& write) {
    std::vector<float> times;
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
    for (const std::uint32_t segment : motion.skin.segments) {
        joint_rotations(motion.poses, segment, rotations);
        ordered.clear();
        for (const glm::quat& q : rotations) {
            ordered.push_back({q.x, q.y, q.z, q.w});
        }
        write(std::as_bytes(std::span<const std::array<float, 4>>(ordered)));
    }
}

void put_joint_nodes(JsonWriter& json, const GltfMotion& motion, std::size_t first) {
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
    begin_accessor(json, {first_view, {}, kGltfFloat, motion.skin.joint_count(), "MAT4"}).end();
    begin_accessor(json, {first_view + 1, {}, kGltfFloat, frames, "SCALAR"})
        .member("min", {0})
        .member("max", {static_cast<double>(time_of(motion.poses, frames - 1))})
        .end();
    const auto put_channels = [&](std::size_t view, std::size_t bytes, const char* type) {
        for (std::size_t i = 0; i < motion.moving_joints(); ++i) {
            begin_accessor(json, {view, i * frames * bytes, kGltfFloat, frames, type}).end();
        }
    };
    put_channels(first_view + 2, sizeof(glm::vec3), "VEC3");
    put_channels(first_view + 3, sizeof(glm::quat), "VEC4");
}

void put_skin_and_animation(JsonWriter& json,
                            const GltfMotion& motion,
                            std::size_t first_node,
                            std::size_t accessor) {
    json.array("skins").object().member("name", "plant");
    json.member("inverseBindMatrices", accessor).member("skeleton", first_node).array("joints");
    for (std::size_t i = 0; i < motion.skin.joint_count(); ++i) {
        json.value(first_node + i);
    }
    json.end().end().end();
    const std::size_t moving = motion.moving_joints();
    if (moving == 0) { // an animation has at least one channel
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
