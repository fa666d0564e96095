// Limits of a run, as the options of every command that compiles or derives give them.
#pragma once

#include "runtime/base/limits.h"

#include <cstdint>

namespace lsys {

struct RunOptions {
    Limits limits;
    std::uint32_t threads = 0; // 0: as many as the machine has
};

} // namespace lsys
