// SPDX-License-Identifier: MIT
// Motion in USDA as a skin (OpenUSD, "UsdSkel schemas"): a skeleton with the same joints as in
// glTF, in world coordinates or nested, and an animation with a sample for each frame. Time codes
// are frames.
#pragma once

#include "runtime/export/impl/bones.h"
#include "runtime/export/impl/piece_writer.h"
#include "runtime/export/impl/skin.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace lsys {

/// The motion of a plant: its poses, frame by frame, and the joints that move its mesh.
struct UsdaMotion {
    Skin skin;                   // unused if `bones` is set
    const PlantAnimation& poses; // at least one frame
    std::optional<Bones> bones;  // instead of `skin`

    [[nodiscard]] std::size_t joint_count() const {
        return bones ? bones->joints.size() : skin.joint_count();
    }
};

/// Fields of the layer: range of time codes and their rate.
void put_usda_times(const PlantAnimation& poses, PieceWriter& out);
/// Properties of the mesh prim: joints and weights of its vertices. `root`: path of the parent of
/// the prim of put_usda_skeleton().
void put_usda_joints(const Mesh& mesh,
                     const UsdaMotion& motion,
                     std::string_view root,
                     PieceWriter& out);
/// Writes a prim `Skeleton` within the prim at path `root`.
void put_usda_skeleton(const UsdaMotion& motion, std::string_view root, PieceWriter& out);

} // namespace lsys
