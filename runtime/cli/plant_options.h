// SPDX-License-Identifier: MIT
// Makes the options of grow_plant() from the options of a command.
#pragma once

#include "runtime/pipeline/plant.h"

namespace lsys::lsc {

template <typename Command>
[[nodiscard]] PlantOptions plant_options(const Command& command) {
    PlantOptions options;
    options.file = command.file;
    options.generations = command.grammar.generations;
    options.seed = command.seed;
    options.height = command.height;
    options.stream = command.stream;
    return options;
}

} // namespace lsys::lsc
