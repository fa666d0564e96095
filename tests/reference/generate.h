// SPDX-License-Identifier: MIT
// Random grammars with all features of the language, one for every test seed. They are legal, their
// words stay small, and most of their productions are applied. A few grammars end in a run-time
// error.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

// A grammar and the command line to derive it with.
struct Case {
    Grammar grammar;
    Request request; // max_modules has no limit
    std::uint64_t layout_seed = 0;
};

Case generate(std::uint64_t seed);

// A plant whose words hold sense modules and whose grammar has environments. Its seeds are not those
// of generate().
Case generate_plant(std::uint64_t seed);

} // namespace lsys::reference
