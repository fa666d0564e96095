// SPDX-License-Identifier: MIT
// A grammar ready to be derived: values of constants, productions by stage, rules and settings.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/evaluate.h"
#include "tests/reference/grammar.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

// Age with which draws before generation 0 are computed: those of constants and axioms.
constexpr std::uint32_t kBeforeTheDerivation = 0xFFFFFFFF;

// A production with its group and rule (section 5).
struct Entry {
    const Production* production = nullptr;
    std::string group;
    std::size_t rule = 0;
};

// A `#sense` statement with the values of its keys.
struct DeclaredSense {
    const Statement* statement = nullptr;
    std::vector<std::vector<float>> values; // of each key
};

struct System {
    const Grammar* grammar = nullptr;
    std::map<std::string, float> constants;
    Functions functions;
    std::map<Stage, std::vector<Entry>> productions; // in file order
    std::vector<std::string> rules;                  // in order of first appearance, stage by stage
    std::vector<DeclaredSense> senses;               // in source order
    std::map<std::string, const Statement*> objects; // by the name of the module
    std::set<std::string> ignored;
    std::set<std::string> considered;
    std::set<std::string> mentioned;      // names in all words and patterns
    std::size_t rewriting_rule_count = 0; // rules[0, rewriting_rule_count) are those of rewriting
    std::uint32_t decompose_depth = 100;
    std::uint32_t interpret_depth = 100;
    bool cuts = false; // in the turtle profile, `%` is a cut
    bool one_choice_per_generation = false;
    std::uint64_t seed = 0;
    std::uint32_t steps = 0;
    std::size_t max_modules = 0;
};

// A word has more than System::max_modules modules; thrown.
struct TooLarge {};

// Thrown inside a step; becomes a RunError.
struct Stop {
    RunError error;
};

} // namespace lsys::reference
