// SPDX-License-Identifier: MIT
// Matches predecessors and contexts over branches, as section 5 of the language reference says.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace lsys::reference {

using Bindings = std::map<std::string, float>;

// Whether predecessor and contexts of `production` match the names and numbers of parameters in the
// word around `position`. Adds the values of the formals to `bindings`.
bool matches_around(const Production& production,
                    const Word& word,
                    std::size_t position,
                    const std::set<std::string>& ignored,
                    Bindings& bindings);

} // namespace lsys::reference
