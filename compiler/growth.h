// How long words grow, from the program alone: counts of modules for each generation by the growth
// matrix (Rozenberg & Salomaa 1980; ABOP 1.9), exact where the system is context-free and
// unconditional, else as bounds. Read by the checks, by `lsc stats` and by the message of a reached
// limit.
#pragma once

#include "compiler/bytecode.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

__extension__ using UnsignedInt128 = unsigned __int128;

/// An unsigned count: exact to 2^128 - 1, beyond as a binary64 logarithm.
struct Count {
    UnsignedInt128 value = 0;
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

/// exact: low == high for every generation.
struct GrowthPrediction {
    bool exact = false;
    std::vector<GenerationSize> low;
    std::vector<GenerationSize> high;
    /// For stochastic systems without conditions and contexts: the expected counts.
    bool has_expected = false;
    std::vector<double> expected_modules;
};

/// Predicts generations 0 ... generations. Time grows with generations times the size of the
/// program.
[[nodiscard]] GrowthPrediction predict_growth(const Bytecode& bytecode, std::uint32_t generations);

/// The largest n whose word is predicted (exactly, or at the lower bound) to hold at most
/// `max_modules`. Nothing if that holds for every n up to `generations`.
struct GrowthLimit {
    std::uint32_t largest_fitting = 0;
    GenerationSize at_largest;
    GenerationSize at_wanted;
    ProductionId dominant = kNoProduction; // contributes the most modules
    bool exact = false;
};
[[nodiscard]] std::optional<GrowthLimit>
find_growth_limit(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules);

} // namespace lsys
