// How long words grow, from the program alone: counts of modules for each generation by the growth
// matrix (Rozenberg & Salomaa 1980; ABOP 1.9) over classes of modules that are rewritten alike,
// exact where every class has one outcome, else as bounds. Read by the checks, by `lsc stats` and
// by the message of a reached limit.
//
// The bounds hold for every seed and every value that is drawn: the true count lies between them,
// for a derivation that ends without a run-time error. A context may match or not; a stochastic
// group may take any of its productions; a condition is decided where its values are known before
// the derivation, and otherwise may hold or not, except that a module is only counted as copied
// where its conditions leave a gap. A rule with several predecessor modules may match from no times
// to as often as its modules are there.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/growth/uint128.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// An unsigned count: exact to 2^128 - 1, beyond as a binary64 logarithm.
struct Count {
    Uint128 value;
    bool exceeds = false; // then log2 holds
    double log2 = 0.0;

    [[nodiscard]] double approximate_log2() const;
    [[nodiscard]] bool at_most(std::uint64_t bound) const { return !exceeds && value <= bound; }
};
[[nodiscard]] Count operator+(const Count& a, const Count& b);
[[nodiscard]] Count operator*(const Count& a, const Count& b);
/// Digits, with thousands separated by commas; `2^N` where it exceeds.
[[nodiscard]] std::string to_text(const Count& count);

/// Predicted contents of the word of one generation.
struct GenerationSize {
    Count modules;
    Count parameters; // stored
    Count segments;   // modules that draw
    Count bytes;      // codes times their width, and 4 a stored parameter
};

/// Generations beyond this one are not listed, but the last is still predicted where that is
/// possible.
inline constexpr std::uint32_t kMaxListedGenerations = 10'000;

/// low[g] and high[g] are of generation g. All generations asked for are listed, up to
/// kMaxListedGenerations, and fewer where a program is so large that listing them would take long.
struct GrowthPrediction {
    bool exact = false; // low == high for every generation
    std::vector<GenerationSize> low;
    std::vector<GenerationSize> high;
    /// For stochastic systems whose conditions are decided and that have no contexts: the expected
    /// counts, as many as are listed.
    bool has_expected = false;
    std::vector<double> expected_modules;
    /// The last generation asked for, also where it is not listed.
    bool has_last = false;
    GenerationSize last_low;
    GenerationSize last_high;
    /// The word of this generation and all later ones are the same, whatever is drawn.
    std::optional<std::uint32_t> unchanged_from;
};

/// Whether anything is known of how words grow: not with `#decompose`, whose passes are as many as
/// are needed, nor with cuts, which depend on the whole branch. Then nothing is listed below.
[[nodiscard]] bool is_growth_known(const Bytecode& bytecode);

/// Predicts generations 0 ... generations. Time grows with the listed generations times the size of
/// the program, and is bounded by some seconds.
[[nodiscard]] GrowthPrediction predict_growth(const Bytecode& bytecode, std::uint32_t generations);

/// The largest n such that all generations up to it are predicted (exactly, or at the lower bound)
/// to hold at most `max_modules`. Nothing if that holds for every n up to `generations`, or is not
/// known.
struct GrowthLimit {
    std::uint32_t largest_fitting = 0;
    GenerationSize at_largest; // lower bounds
    GenerationSize at_next;    // of the first generation that does not fit
    GenerationSize at_wanted;  // of the last generation asked for, if has_wanted
    bool has_wanted = false;
    ProductionId dominant =
        kNoProduction; // makes the most modules of the generation that does not fit
    bool exact = false;
};
/// If the axiom itself is too large, largest_fitting is 0 and at_largest is at_next.
[[nodiscard]] std::optional<GrowthLimit>
find_growth_limit(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules);

} // namespace lsys
