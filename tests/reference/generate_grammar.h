// SPDX-License-Identifier: MIT
// Makes the statements of a random grammar: files that include each other, settings, constants,
// axiom and productions. generate.h chooses the number of generations.

#pragma once

#include "tests/reference/generate.h"

#include <cstdint>

namespace lsys::reference {

// Makes a random case that depends on the arguments only. `senses`: the case has sense modules.
Case make_case(std::uint64_t seed, std::uint32_t attempt, bool senses);

} // namespace lsys::reference
