// Motion in USDA as a skin (OpenUSD, "UsdSkel schemas"): a skeleton whose joints are placed in the
// world, as in glTF, and an animation with a sample for each frame. Time codes are frames.
#pragma once

#include "runtime/export/impl/piece_writer.h"
#include "runtime/export/impl/skin.h"

#include <string_view>

namespace lsys {

/// A moving plant.
struct UsdaMotion {
    const Skin& skin;
    const PlantAnimation& poses;
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
