// SPDX-License-Identifier: MIT
// The part of a glTF file that makes its mesh move: a skin, its joints as nodes, and an animation
// that rotates and translates each joint (glTF 2.0, sections 3.7.3 and 3.11).
#pragma once

#include "runtime/export/impl/bones.h"
#include "runtime/export/impl/gltf_items.h"
#include "runtime/export/impl/json_writer.h"
#include "runtime/export/impl/skin.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lsys {

struct GltfMotion {
    Skin skin;                   // unused if `bones` is set
    const PlantAnimation& poses; // at least one frame
    std::optional<Bones> bones;  // instead of `skin`

    [[nodiscard]] std::size_t joint_count() const {
        return bones ? bones->joints.size() : skin.joint_count();
    }
    [[nodiscard]] std::size_t moving_joints() const { return skin.segments.size(); }
    /// Size in bytes of a joint number.
    [[nodiscard]] std::size_t joint_bytes() const { return joint_count() <= 256 ? 1 : 2; }
    /// Counts of items in the arrays of the animation.
    [[nodiscard]] std::uint64_t time_count() const;
    [[nodiscard]] std::uint64_t translation_count() const;
    [[nodiscard]] std::uint64_t rotation_count() const;
};

// Functions that write the arrays of some vertices of the mesh, or of all joints. They are declared
// in the order of GltfArray.
void write_vertex_joints(const Mesh& mesh,
                         std::span<const std::uint32_t> vertices,
                         const GltfMotion& motion,
                         const GltfBytes& write);
void write_vertex_weights(const Mesh& mesh,
                          std::span<const std::uint32_t> vertices,
                          const GltfMotion& motion,
                          const GltfBytes& write);
/// `decode`, the transform from items to positions, is the matrix of joint 0, the first matrix.
void write_inverse_binds(const GltfMotion& motion, const glm::mat4& decode, const GltfBytes& write);
void write_times(const GltfMotion& motion, const GltfBytes& write);
/// Joint by joint, frame by frame within a joint.
void write_translations(const GltfMotion& motion, const GltfBytes& write);
void write_rotations(const GltfMotion& motion, const GltfBytes& write);

/// Nodes of the joints. The node of joint 0 comes first and has the number `first`.
void put_joint_nodes(JsonWriter& json, const GltfMotion& motion, std::size_t first);
/// Accessors: inverse binds, times, then the translations of each moving joint, then the rotations.
/// With `bones`: inverse binds, then times and rotations of each joint with keys. The views of the
/// arrays that are not empty are consecutive, from `first_view` on.
void put_motion_accessors(JsonWriter& json, const GltfMotion& motion, std::size_t first_view);
/// The members `skins` and `animations`. `accessor`: number of the first accessor of
/// put_motion_accessors().
void put_skin_and_animation(JsonWriter& json,
                            const GltfMotion& motion,
                            std::size_t first_node,
                            std::size_t accessor);

} // namespace lsys
