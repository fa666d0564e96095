// The plant that a command asks for.
#pragma once

#include "runtime/pipeline/plant.h"

namespace lsys::lsc {

template <typename Command>
[[nodiscard]] PlantOptions plant_options(const Command& command) {
    PlantOptions options;
    options.file = command.file;
    options.generations = command.grammar.generations;
    options.seed = command.seed;
    options.stream = command.stream;
    return options;
}

} // namespace lsys::lsc
