// SPDX-License-Identifier: MIT
// Philox4x32-10, written from Salmon, Moraes, Dror and Shaw, "Parallel Random Numbers: As Easy as
// 1, 2, 3" (SC 2011), section 3.3 and table 2. The oracle uses it for draws (the language
// reference, section 6), and the generator of random grammars for its decisions. This file shares
// no code with the runtime, which is tested against the oracle.

#pragma once

#include <array>
#include <cstdint>

namespace lsys::reference {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

// Four random words: the result of ten rounds over `counter` with `key`.
PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key);

// Draw number `draw` for the module at `position` in a word of age `generation`, as a multiple of
// 2^-24 in [0, 1).
float uniform(std::uint64_t seed,
              std::uint64_t position,
              std::uint32_t generation,
              std::uint64_t draw);

} // namespace lsys::reference
