// SPDX-License-Identifier: MIT
// Matching of predecessors and contexts over branches: section 5 of the language reference.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/grammar.h"

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace lsys::reference {

using Bindings = std::map<std::string, float>;

// Whether predecessor and contexts of `production` have the names and numbers of parameters of the
// word around `position`. The values found are added to `bindings`.
bool matches_around(const Production& production,
                    const Word& word,
                    std::size_t position,
                    const std::set<std::string>& ignored,
                    Bindings& bindings);

} // namespace lsys::reference
