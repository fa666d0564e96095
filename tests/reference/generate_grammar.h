// SPDX-License-Identifier: MIT
// Makes the statements of a random grammar: files that include each other, settings, constants,
// axiom and productions. generate.h chooses the number of generations.

#pragma once

#include "tests/reference/generate.h"

#include <cstdint>

namespace lsys::reference {

// Makes a case. The same seed and the same attempt give the same case.
Case make_case(std::uint64_t seed, std::uint32_t attempt);

} // namespace lsys::reference
