// SPDX-License-Identifier: MIT
// The growth of words without a derivation: counts of modules per generation by the growth matrix
// (Rozenberg & Salomaa 1980; ABOP 1.9) over classes of modules that are rewritten alike. Counts are
// exact if every class has one outcome, else they are bounds. Used by the checks, by `lsc stats`
// and by the message of a reached limit.
//
// The bounds hold for every seed, in derivations without run-time errors. They allow that a context
// matches or not, that a stochastic group takes any of its productions, and that a condition holds
// or not, unless the values that it reads are known before the derivation. A module may stay
// unchanged only if its conditions leave a gap. A rule with several predecessor modules matches
// between zero times and as often as the number of its modules allows.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/growth/uint128.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// An unsigned count: exact up to 2^128 - 1, above that a binary64 logarithm.
struct Count {
    Uint128 value;
    bool exceeds = false; // the count exceeds 2^128 - 1: use log2, not value
    double log2 = 0.0;

    [[nodiscard]] double approximate_log2() const;
    [[nodiscard]] bool at_most(std::uint64_t bound) const { return !exceeds && value <= bound; }
};
[[nodiscard]] Count operator+(const Count& a, const Count& b);
[[nodiscard]] Count operator*(const Count& a, const Count& b);
/// Digits with commas between thousands, or `2^N` for counts from 2^128 on.
[[nodiscard]] std::string to_text(const Count& count);

/// Predicted contents of the word of one generation.
struct GenerationSize {
    Count modules;
    Count parameters; // stored parameters
    Count segments;   // modules that draw
    Count bytes;      // code width per module, plus 4 per stored parameter
};

/// The highest generation that is listed. Of higher generations only the last requested one is
/// predicted, if possible.
inline constexpr std::uint32_t kMaxListedGenerations = 10'000;

/// Lower and upper bounds low[g] and high[g] of the sizes of generation g. Lists all requested
/// generations up to kMaxListedGenerations; large programs list fewer, so that the prediction stays
/// fast.
struct GrowthPrediction {
    bool exact = false; // low == high for every generation
    std::vector<GenerationSize> low;
    std::vector<GenerationSize> high;
    /// The expected counts of the listed generations. Known for stochastic systems without contexts
    /// if the truth of all conditions is known before the derivation.
    bool has_expected = false;
    std::vector<double> expected_modules; // by generation
    /// The last requested generation, even if it is not listed.
    bool has_last = false;
    GenerationSize last_low;
    GenerationSize last_high;
    /// The first generation from which the word never changes, for any seed; unset if unknown.
    std::optional<std::uint32_t> unchanged_from;
    /// A sense module or swept module of the last listed word whose new parameters decide the
    /// counts of later generations, which are therefore not predicted; kNoSymbol if there is none.
    SymbolId depends_on = kNoSymbol;
};

/// Whether growth can be predicted. Growth cannot be predicted with `#decompose`, whose number of
/// passes is unknown, or with cuts, which depend on the whole branch; predictions are then empty.
[[nodiscard]] bool is_growth_known(const Bytecode& bytecode);

/// Predicts generations 0 ... generations. Takes time in proportion to the listed generations times
/// the size of the program, at most some seconds.
[[nodiscard]] GrowthPrediction predict_growth(const Bytecode& bytecode, std::uint32_t generations);

/// The largest n for which all generations up to n have at most `max_modules` modules, by their
/// counts or lower bounds.
struct GrowthLimit {
    std::uint32_t largest_fitting = 0;
    GenerationSize at_largest;   // lower bounds
    GenerationSize at_next;      // the first generation that does not fit
    GenerationSize at_requested; // the last requested generation; see has_requested
    bool has_requested = false;
    ProductionId dominant =
        kNoProduction;  // writes the most modules of the first generation that does not fit
    bool exact = false; // at_next is exact, not lower bounds
};
/// A generation from which on the word never changes, for any seed.
struct FixedPoint {
    std::uint32_t generation = 0;
    bool is_empty = false; // the word has no modules
};

/// The limit or the fixed point that the words reach before the requested generation. Neither is
/// set if growth is not known.
struct GrowthEnd {
    /// Set if not all requested generations fit. If the axiom is too large, largest_fitting is 0
    /// and at_largest is at_next.
    std::optional<GrowthLimit> limit;
    /// Set if no limit is reached and some word is known never to change again.
    std::optional<FixedPoint> fixed_point;
};
[[nodiscard]] GrowthEnd
find_growth_end(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules);

} // namespace lsys
