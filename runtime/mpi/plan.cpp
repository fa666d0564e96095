// SPDX-License-Identifier: MIT
#include "runtime/mpi/plan.h"

#include "grammar/base/hash.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/cli/load_tile_forest.h"

namespace lsys::mpi {

ExitStatus plan_tiles(const lsc::TilesCommand& command,
                      const Console& console,
                      std::optional<TileForest>& forest) {
    const auto load = [&] {
        return lsc::load_tile_forest(command, lsc::TilePlacements::All, console, forest);
    };
    return catch_out_of_memory(load, [&console] {
        console.error("out of memory");
        return ExitStatus::Limit;
    });
}

std::uint64_t hash_of(const TileForest& forest) {
    std::uint64_t state = combine_bytes(0, forest.tileset({0, 0, 0}));
    for (std::uint32_t level = 0; level < forest.levels().size(); ++level) {
        const TileExtent tiles = forest.extent(level);
        state = combine(combine(state, tiles.columns), tiles.rows);
    }
    for (const TileFile& file : forest.files()) {
        state = combine_bytes(combine_bytes(state, file.path), file.bytes);
    }
    return finish(state);
}

} // namespace lsys::mpi
