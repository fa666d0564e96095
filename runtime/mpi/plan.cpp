// SPDX-License-Identifier: MIT
#include "runtime/mpi/plan.h"

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

} // namespace lsys::mpi
