// SPDX-License-Identifier: MIT
#include "compiler/bytecode/distributions.h"

#include "grammar/base/exponentials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

/// The polynomial with these coefficients at `x`, lowest power first.
template <std::size_t Count>
double polynomial(const std::array<double, Count>& coefficients, double x) {
    double value = 0.0;
    for (std::size_t i = Count; i-- > 0;) {
        value = value * x + coefficients[i];
    }
    return value;
}

// Coefficients of algorithm AS 241 (normal_quantile()): numerators and denominators.
// Middle: |p - 0.5| <= 0.425.
constexpr std::array kCentralNumerator{3.3871328727963666080e0,  1.3314166789178437745e+2,
                                       1.9715909503065514427e+3, 1.3731693765509461125e+4,
                                       4.5921953931549871457e+4, 6.7265770927008700853e+4,
                                       3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr std::array kCentralDenominator{1.0,
                                         4.2313330701600911252e+1,
                                         6.8718700749205790830e+2,
                                         5.3941960214247511077e+3,
                                         2.1213794301586595867e+4,
                                         3.9307895800092710610e+4,
                                         2.8729085735721942674e+4,
                                         5.2264952788528545610e+3};
// Tail: other p with r <= 5, where r = sqrt(-log(min(p, 1 - p))).
constexpr std::array kTailNumerator{1.42343711074968357734e0,  4.63033784615654529590e0,
                                    5.76949722146069140550e0,  3.64784832476320460504e0,
                                    1.27045825245236838258e0,  2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr std::array kTailDenominator{1.0,
                                      2.05319162663775882187e0,
                                      1.67638483018380384940e0,
                                      6.89767334985100004550e-1,
                                      1.48103976427480074590e-1,
                                      1.51986665636164571966e-2,
                                      5.47593808499534494600e-4,
                                      1.05075007164441684324e-9};
// Far: r > 5.
constexpr std::array kFarNumerator{6.65790464350110377720e0,  5.46378491116411436990e0,
                                   1.78482653991729133580e0,  2.96560571828504891230e-1,
                                   2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                   2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr std::array kFarDenominator{1.0,
                                     5.99832206555887937690e-1,
                                     1.36929880922735805310e-1,
                                     1.48753612908506148525e-2,
                                     7.86869131145613259100e-4,
                                     1.84631831751005468180e-5,
                                     1.42151175831644588870e-7,
                                     2.04426310338993978564e-15};

/// A non-negative number `fraction` * 2^`exponent`, since the first terms of a sum may be far below
/// the smallest binary64.
struct Term {
    double fraction = 1.0;
    std::int64_t exponent = 0;

    void multiply(double factor) {
        int shift = 0;
        fraction = std::frexp(fraction * factor, &shift);
        exponent += shift;
    }
    [[nodiscard]] double value() const {
        constexpr std::int64_t kMinExponent = -2000; // any lower exponent also gives 0 in binary64
        return std::ldexp(fraction, static_cast<int>(std::max(exponent, kMinExponent)));
    }
};

/// base^exponent by squaring, for 0 < base < 1.
Term power(double base, std::uint32_t exponent) {
    Term result;
    Term square;
    square.multiply(base);
    for (; exponent != 0; exponent >>= 1U) {
        if ((exponent & 1U) != 0) {
            result.multiply(square.fraction);
            result.exponent += square.exponent;
        }
        square.exponent *= 2;
        square.multiply(square.fraction);
    }
    return result;
}

} // namespace

DistributionFault check_distribution(Opcode opcode, float x, float y) {
    switch (opcode) {
    case Opcode::Normal:
        return !std::isfinite(x)                  ? DistributionFault::Mean
               : !(std::isfinite(y) && y >= 0.0F) ? DistributionFault::Deviation
                                                  : DistributionFault::None;
    case Opcode::Poisson:
        return x >= 0.0F && x <= kMaxPoissonMean ? DistributionFault::None
                                                 : DistributionFault::Mean;
    default:
        return !(x >= 0.0F && x <= kMaxTrials && std::floor(x) == x) ? DistributionFault::Trials
               : !(y >= 0.0F && y <= 1.0F) ? DistributionFault::Probability
                                           : DistributionFault::None;
    }
}

const char* describe(Opcode opcode, DistributionFault fault) {
    switch (fault) {
    case DistributionFault::Mean:
        return opcode == Opcode::Normal ? "its mean has to be finite"
                                        : "its mean has to lie between 0 and 700";
    case DistributionFault::Deviation:
        return "its standard deviation has to be finite and not below 0";
    case DistributionFault::Trials:
        return "its number of trials has to be a whole number from 0 to 10000";
    case DistributionFault::Probability:
        return "its probability has to lie between 0 and 1";
    case DistributionFault::None:
        break;
    }
    return "";
}

double normal_quantile(double p) {
    const double offset = p - 0.5;
    if (std::fabs(offset) <= 0.425) {
        const double r = 0.180625 - offset * offset;
        return offset * polynomial(kCentralNumerator, r) / polynomial(kCentralDenominator, r);
    }
    const double r = std::sqrt(-logarithm(offset < 0.0 ? p : 1.0 - p));
    const double distance =
        r <= 5.0 ? polynomial(kTailNumerator, r - 1.6) / polynomial(kTailDenominator, r - 1.6)
                 : polynomial(kFarNumerator, r - 5.0) / polynomial(kFarDenominator, r - 5.0);
    return offset < 0.0 ? -distance : distance;
}

std::uint32_t poisson_quantile(double mean, double u) {
    Term term;
    term.multiply(exponential(-mean));
    double sum = 0.0;
    for (std::uint32_t k = 0;; ++k) {
        const double before = sum;
        sum += term.value();
        if (sum > u || (k > mean && sum == before)) {
            return k;
        }
        term.multiply(mean / static_cast<double>(k + 1));
    }
}

std::uint32_t binomial_quantile(std::uint32_t trials, double probability, double u) {
    if (probability == 1.0) {
        return trials;
    }
    Term term = power(1.0 - probability, trials);
    const double odds = probability / (1.0 - probability);
    double sum = 0.0;
    for (std::uint32_t k = 0; k < trials; ++k) {
        sum += term.value();
        if (sum > u) {
            return k;
        }
        term.multiply(static_cast<double>(trials - k) / static_cast<double>(k + 1) * odds);
    }
    return trials;
}

float draw_from(Opcode opcode, float x, float y, float u) {
    const auto draw = static_cast<double>(u);
    switch (opcode) {
    case Opcode::Normal: {
        const double distance = static_cast<double>(y) * normal_quantile(draw + 0x1p-25);
        return static_cast<float>(static_cast<double>(x) + distance);
    }
    case Opcode::Poisson:
        return static_cast<float>(poisson_quantile(static_cast<double>(x), draw));
    default:
        return static_cast<float>(
            binomial_quantile(static_cast<std::uint32_t>(x), static_cast<double>(y), draw));
    }
}

} // namespace lsys
