// SPDX-License-Identifier: MIT
// The turtle of a word that is sensed: sections 7 and 13.3 of the language reference, in binary64,
// for the profiles `lsys`, `thesis` and `abop`.

#pragma once

#include "tests/reference/environments/place.h"
#include "tests/reference/system.h"

namespace lsys::reference {

struct Pose {
    Vector position{};
    Vector heading{0, 1, 0};
    Vector right{1, 0, 0};
    Vector up{0, 0, 1};
};

struct Walk {
    std::map<std::size_t, Pose> poses; // of the sense modules, by index in the word
    std::vector<Organ> organs;
};

// Walks over `drawn`, the word that interpretation draws in place of `word`. Throws Stop for a `]`
// without its `[`, and for a `}` without its `{`.
Walk walk(const System& system, const Word& word, const Word& drawn, std::uint32_t age);

} // namespace lsys::reference
