// Distributions: one random number each from one draw (docs/language.md section 4.8).
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>

namespace lsys {

inline constexpr float kMaxPoissonMean = 700.0F;
inline constexpr float kMaxTrials = 10000.0F;

/// Whether the instruction draws from a distribution other than that of a range.
[[nodiscard]] constexpr bool is_distribution(Opcode opcode) {
    return opcode == Opcode::Normal || opcode == Opcode::Poisson || opcode == Opcode::Binomial;
}

/// Whether the instruction takes a draw of the production: of a range or a distribution.
[[nodiscard]] constexpr bool is_draw(Opcode opcode) {
    return opcode == Opcode::Range || is_distribution(opcode);
}

/// The argument of a distribution that it cannot be drawn with.
enum class DistributionFault : std::uint8_t {
    None,
    Mean,        // of normal: not finite; of poisson: outside 0 to kMaxPoissonMean
    Deviation,   // not finite or below 0
    Trials,      // no whole number of 0 to kMaxTrials
    Probability, // outside 0 to 1
};
/// The first argument at fault. Normal(x, y): mean and standard deviation; Poisson(x): mean;
/// Binomial(x, y): number of trials and probability of each.
[[nodiscard]] DistributionFault check_distribution(Opcode opcode, float x, float y);
/// The rule that an argument at fault breaks, as a clause of a message.
[[nodiscard]] const char* describe(Opcode opcode, DistributionFault fault);

/// The number that the draw `u` in [0, 1) yields. Precondition: check_distribution() finds no
/// fault. A normal number may be infinite, if it overflows.
[[nodiscard]] float draw_from(Opcode opcode, float x, float y, float u);

/// The number below which a standard normal one lies with probability `p`, 0 < p < 1, to about
/// 1 part in 10^16: algorithm AS 241, PPND16 (Wichura 1988).
[[nodiscard]] double normal_quantile(double p);
/// The least k whose cumulative probability exceeds `u`.
[[nodiscard]] std::uint32_t poisson_quantile(double mean, double u);
[[nodiscard]] std::uint32_t binomial_quantile(std::uint32_t trials, double probability, double u);

} // namespace lsys
