// SPDX-License-Identifier: MIT
// Plans a random grammar: its modules, its features and their frequencies. generate_productions.h
// explains bundles.

#pragma once

#include "tests/reference/random.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsys::reference {

// A kind of module: name and number of parameters.
struct ModuleKind {
    std::string name;
    std::size_t count = 0; // number of parameters
};

struct Plan {
    std::string rewriting;
    bool choice_generation = false;     // `#set choice generation`
    bool weights_any = false;           // `#set weights any`
    bool brackets = false;              // words have branches
    bool unbalanced = false;            // some successors do not balance their brackets
    bool polygons = false;              // words have polygons
    bool open_polygons = false;         // some successors do not balance their polygons
    std::size_t context_percent = 0;    // percentage of bundles with contexts
    std::size_t condition_percent = 0;  // percentage of bundles with conditions
    std::size_t stochastic_percent = 0; // percentage of bundles with weights
    std::size_t range_percent = 0;      // percentage of arguments of successors that have a range
    std::size_t local_percent = 0;      // percentage of productions with local values
    std::vector<ModuleKind> kinds;      // all modules of the grammar
    std::vector<ModuleKind> active;     // modules that productions rewrite
    std::vector<std::string> ignored;
    bool senses = false;                   // the grammar is one of a plant that senses
    std::vector<std::string> environments; // names without `?`
    std::vector<ModuleKind> senses_of;     // all sense modules; `kinds` has them too
};

// Whether a file can contain modules of that name: with `names letters`, identifiers have one
// letter, behind the `?` of sense modules too.
bool fits(const std::string& name, bool letters);

// `letters_files`, `words_files`: whether the grammar has files with and without `#set names
// letters`. Every file can contain at least one active kind.
Plan make_plan(bool letters_files, bool words_files, Random& random);

} // namespace lsys::reference
