// SPDX-License-Identifier: MIT
// Finds the module of a word that drew a segment, object or polygon of its plant, and the
// production that wrote this module. Derives the word again, since a plant stores neither.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/meshing/mesh_items.h"
#include "runtime/pipeline/file_position.h"
#include "runtime/pipeline/plant.h"

#include <cstdint>
#include <optional>
#include <string>

namespace lsys {

struct ItemOrigin {
    std::string module;                // text of the module as in a word: "F(1.5)"
    std::uint64_t module_index = 0;    // index in the word
    std::uint64_t module_count = 0;    // number of modules in the word
    std::string origin;                // "from p2 at tree.lsys:7:14, generation 3"
    std::optional<FilePosition> place; // place in the grammar that wrote the module; unset: unknown
    std::uint32_t generation = 0;      // generation of the word
};

/// Finds the module that draws `item` in the word of `generation`. Folds the bytecode of `grammar`
/// (fold_modules()). ItemOrigin::module is empty if the word does not draw the item. Fails like
/// grow_plant(). Precondition: `generation` is at most `options.generations`.
[[nodiscard]] Outcome<ItemOrigin> origin_of_item(const PlantOptions& options,
                                                 std::uint32_t generation,
                                                 const SkeletonItem& item,
                                                 Grammar& grammar,
                                                 const Project& project);

} // namespace lsys
