// SPDX-License-Identifier: MIT
// Distributions (docs/language.md section 4.8). Each random number is computed from one draw in
// [0, 1).
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>

namespace lsys {

inline constexpr float kMaxPoissonMean = 700.0F;
inline constexpr float kMaxTrials = 10000.0F;

/// Whether the instruction draws from a distribution. False for a range.
[[nodiscard]] constexpr bool is_distribution(Opcode opcode) {
    return opcode == Opcode::Normal || opcode == Opcode::Poisson || opcode == Opcode::Binomial;
}

/// Whether the instruction uses a random draw: a range or a distribution.
[[nodiscard]] constexpr bool is_draw(Opcode opcode) {
    return opcode == Opcode::Range || is_distribution(opcode);
}

/// The invalid argument of a distribution.
enum class DistributionFault : std::uint8_t {
    None,
    Mean,        // normal: not finite; poisson: outside 0 to kMaxPoissonMean
    Deviation,   // not finite or below 0
    Trials,      // not a whole number from 0 to kMaxTrials
    Probability, // outside 0 to 1
};
/// The first invalid argument, or None. Arguments of Normal(x, y): mean and standard deviation; of
/// Poisson(x): mean; of Binomial(x, y): number of trials and probability of success.
[[nodiscard]] DistributionFault check_distribution(Opcode opcode, float x, float y);
/// The rule that an invalid argument breaks, as a clause of a message.
[[nodiscard]] const char* describe(Opcode opcode, DistributionFault fault);

/// The random number for the draw `u` in [0, 1). Precondition: check_distribution() returns None. A
/// normally distributed number is infinite if it overflows.
[[nodiscard]] float draw_from(Opcode opcode, float x, float y, float u);

/// Quantile of the standard normal distribution for 0 < p < 1: the x with P(X < x) = p. Relative
/// error about 1e-16: algorithm AS 241, PPND16 (Wichura 1988).
[[nodiscard]] double normal_quantile(double p);
/// Quantiles: the smallest k with P(X <= k) > u, for u in [0, 1). If rounding keeps the sum of the
/// probabilities at or below u, the result is the first k above the mean that adds nothing to the
/// sum; for a binomial distribution the result is then `trials`.
[[nodiscard]] std::uint32_t poisson_quantile(double mean, double u);
[[nodiscard]] std::uint32_t binomial_quantile(std::uint32_t trials, double probability, double u);

} // namespace lsys
