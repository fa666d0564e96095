// SPDX-License-Identifier: MIT
// The oracle: derives a grammar by following sections 4 to 6 of the language reference sentence by
// sentence. A word is a vector of modules with their names as text; every step tries every
// production for every module. The oracle is slow on purpose: the runtime is tested against it, so
// it must be evidently correct rather than fast, and it shares no code with the compiler or the
// runtime.

#pragma once

#include "tests/reference/grammar.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

// Where a module of a word comes from: a place in the grammar, a production and a generation.
struct Origin {
    const ModuleUse* written = nullptr; // module of the axiom or of a successor
    std::string production;             // label of the production; empty: the axiom
    std::uint32_t generation = 0;       // of the first word that contains the module
};

struct Module {
    std::string name;
    std::vector<float> values;
    Origin origin = {}; // == does not compare origins

    bool operator==(const Module& other) const {
        return name == other.name && values == other.values;
    }
};

using Word = std::vector<Module>;

// Options of the command line.
struct Request {
    std::optional<std::uint64_t> seed;
    std::optional<std::uint32_t> generations;
    std::vector<std::pair<std::string, float>> definitions; // -D NAME=number
    std::size_t max_modules = std::numeric_limits<std::size_t>::max();
};

enum class Failure {
    NotFinite,        // the value of a parameter or of a condition
    BadRange,         // min > max, bounds or width not finite, arguments out of bounds
    BadWeight,        // weight: negative, not finite, or with an infinite sum
    UnmatchedBracket, // the last word has a `]` without its `[`
    UnmatchedPolygon  // the last word has a `}` without its `{`
};

struct RunError {
    Failure failure = Failure::NotFinite;
    std::string production;     // empty for an unmatched bracket and for errors before generation 0
    std::uint64_t position = 0; // in the word that is rewritten; unmatched bracket: in the last
    std::uint32_t generation = 0; // age of this word
    Module module;                // the first module that the production rewrites
};

struct Derivation {
    std::vector<Word> words;       // generation 0 first
    std::optional<RunError> error; // `words` has all words before it
    bool too_large = false;        // the next word has more than max_modules modules
    std::map<std::string, std::uint64_t> applications; // by label of the production
    std::map<std::string, float> constants;
    std::uint32_t generations = 0; // number of generations that were requested
    std::uint64_t seed = 0;
};

// Precondition: the grammar is legal, and each definition names a #define or #param.
Derivation derive(const Grammar& grammar, const Request& request);

} // namespace lsys::reference
