// SPDX-License-Identifier: MIT
// Makes a random grammar for each test seed; together they use all features of the language. The
// grammars are legal, their words stay small, and most of their productions are applied. A few
// grammars end with a run-time error.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

// A grammar, and the options with which it is derived.
struct Case {
    Grammar grammar;
    Request request; // max_modules has no limit
    std::uint64_t layout_seed = 0;
};

Case generate(std::uint64_t seed);

// A plant whose words hold sense modules and whose grammar has environments. The same seed gives
// unrelated random numbers here and in generate().
Case generate_plant(std::uint64_t seed);

} // namespace lsys::reference
