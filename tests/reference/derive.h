// SPDX-License-Identifier: MIT
// The oracle: derives a grammar by following sections 4 to 6 and 13 of the language reference
// sentence by sentence. A word is a vector of modules with their names as text; every step looks at every
// production for every module. Slow on purpose: the runtime is tested against it, so it must be
// evident rather than fast, and it shares nothing with the compiler or the runtime.

#pragma once

#include "tests/reference/grammar.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
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
    Origin origin = {};     // not compared by ==
    std::size_t source = 0; // in a word that is drawn: see interpreted() in pass.h

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
    // Environments of kind `program`, answered by answering_program.cpp.
    std::vector<std::string> programs;
};

enum class Failure {
    NotFinite,        // a parameter or a condition
    BadRange,         // min > max, bounds or width not finite, a distribution out of its bounds
    BadWeight,        // negative, not finite, or with a sum that is not finite
    UnmatchedBracket, // a `]` without its `[` in the last word or in a word that is sensed
    UnmatchedPolygon, // a `}` without its `{`, likewise
    NoAnswer          // an answer or a place that is not finite, or a place beyond all voxels
};

struct RunError {
    Failure failure = Failure::NotFinite;
    std::string production;     // empty for an unmatched bracket and for errors before generation 0
    std::uint64_t position = 0; // index in the rewritten word; unmatched bracket: in the last word
    std::uint32_t generation = 0; // age of the word that `position` refers to
    Module module;                // the first module that the production rewrites
};

// Counts of the answers of one kind of environment; `turtle` is the kind of `?P`, `?H`, `?U`, `?R`
// and `?L`.
struct Answered {
    std::uint64_t modules = 0;              // modules with an answer
    std::uint64_t other_than_zero = 0;      // modules whose answer has a number other than 0
    std::set<std::vector<float>> different; // each answer once
};

struct Derivation {
    std::vector<Word> words;       // generation 0 first
    std::optional<RunError> error; // `words` has all words before it
    bool too_large = false;        // the next word has more than max_modules modules
    std::map<std::string, std::uint64_t> applications; // by label of the production
    std::map<std::string, Answered> answered;          // by kind of environment
    std::map<std::string, float> constants;
    std::uint32_t generations = 0; // number of generations that were requested
    std::uint64_t seed = 0;
};

// Precondition: the grammar is legal, and each definition names a #define or #param.
Derivation derive(const Grammar& grammar, const Request& request);

} // namespace lsys::reference
