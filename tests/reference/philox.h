// SPDX-License-Identifier: MIT
// Philox4x32-10, written from Salmon, Moraes, Dror and Shaw, "Parallel Random Numbers: As Easy as
// 1, 2, 3" (SC 2011), section 3.3 and table 2. The oracle of the tests draws its numbers from it
// (the language reference, section 6) and the generator of random grammars makes its decisions with
// it. This file shares no code with the runtime, which the oracle checks.

#pragma once

#include <array>
#include <cstdint>

namespace lsys::reference {

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;

// Ten rounds over `counter` with `key`: four random words.
PhiloxCounter philox4x32_10(PhiloxCounter counter, PhiloxKey key);

// Draw number `draw` of the module at `position` in a word of age `generation`: a multiple of
// 2^-24 in [0, 1).
float uniform(std::uint64_t seed,
              std::uint64_t position,
              std::uint32_t generation,
              std::uint64_t draw);

} // namespace lsys::reference
