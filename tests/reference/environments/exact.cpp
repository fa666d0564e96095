// SPDX-License-Identifier: MIT
#include "tests/reference/environments/exact.h"

#include <cmath>

namespace lsys::reference {

namespace {

// The number high + low, where high is the sum rounded to binary64.
struct Wide {
    double high = 0;
    double low = 0;
};

// The exact sum of two numbers (Knuth).
Wide two_sum(double a, double b) {
    const double sum = a + b;
    const double part = sum - a;
    return {sum, (a - (sum - part)) + (b - part)};
}

Wide add(const Wide& a, const Wide& b) {
    const Wide high = two_sum(a.high, b.high);
    const Wide low = two_sum(a.low, b.low);
    const Wide sum = two_sum(high.high, high.low + low.high);
    return two_sum(sum.high, sum.low + low.low);
}

Wide multiply(const Wide& a, const Wide& b) {
    const double product = a.high * b.high;
    const double error = std::fma(a.high, b.high, -product);
    return two_sum(product, error + (a.high * b.low + a.low * b.high));
}

Wide divide(const Wide& a, double b) {
    const double first = a.high / b;
    const double rest = std::fma(-first, b, a.high) + a.low;
    return two_sum(first, rest / b);
}

Wide negative(const Wide& a) {
    return {-a.high, -a.low};
}

// The sum of term, term * factor / (n (n + 1)), ...: a sine with n = 2, a cosine with n = 1, for
// factor = -angle^2.
Wide alternating_series(Wide term, const Wide& factor, int n) {
    Wide sum = term;
    for (; n < 40; n += 2) {
        term = divide(multiply(term, factor), static_cast<double>(n * (n + 1)));
        sum = add(sum, term);
    }
    return sum;
}

// `angle`: in radians, at most pi / 4. The result is that of angle + quarters * pi / 2.
SineCosine turned(const Wide& angle, long long quarters) {
    const Wide factor = negative(multiply(angle, angle));
    const double sine = alternating_series(angle, factor, 2).high;
    const double cosine = alternating_series({1, 0}, factor, 1).high;
    switch ((quarters % 4 + 4) % 4) {
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    case 3:
        return {-cosine, sine};
    default:
        return {sine, cosine};
    }
}

// x - n (a + b + c): the three parts of a constant are exact to more than 150 bits.
Wide reduced(double x, double n, double a, double b, double c) {
    const double product = n * a;
    const Wide first = add({x, 0}, {-product, -std::fma(n, a, -product)});
    const double second = n * b;
    return add(add(first, {-second, -std::fma(n, b, -second)}), {-n * c, 0});
}

} // namespace

SineCosine sine_cosine_of_degrees(double degrees) {
    constexpr Wide kRadian = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62}; // pi / 180
    const double angle = std::fmod(degrees, 360.0);
    const double quarters = std::nearbyint(angle / 90.0);
    const double rest = angle - 90.0 * quarters; // exact
    return turned(multiply({rest, 0}, kRadian), static_cast<long long>(quarters));
}

SineCosine sine_cosine_of_radians(double radians) {
    constexpr double kFirst = 0x1.921fb54442d18p+0; // pi / 2
    constexpr double kSecond = 0x1.1a62633145c07p-54;
    constexpr double kThird = -0x1.f1976b7ed8fbcp-110;
    const double quarters = std::nearbyint(radians / kFirst);
    return turned(reduced(radians, quarters, kFirst, kSecond, kThird),
                  static_cast<long long>(quarters));
}

double exponential(double exponent) {
    constexpr double kFirst = 0x1.62e42fefa39efp-1; // ln 2
    constexpr double kSecond = 0x1.abc9e3b39803fp-56;
    constexpr double kThird = 0x1.7b57a079a1934p-111;
    if (std::fabs(exponent) > 1000) {
        return exponent < 0 ? 0 : HUGE_VAL;
    }
    const double twos = std::nearbyint(exponent / kFirst);
    const Wide whole = reduced(exponent, twos, kFirst, kSecond, kThird);
    const Wide rest = {whole.high / 256, whole.low / 256};
    Wide term = {1, 0};
    Wide sum = term;
    for (int n = 1; n < 20; ++n) {
        term = divide(multiply(term, rest), static_cast<double>(n));
        sum = add(sum, term);
    }
    for (int i = 0; i < 8; ++i) { // to the power of 256
        sum = multiply(sum, sum);
    }
    return std::ldexp(sum.high, static_cast<int>(twos));
}

} // namespace lsys::reference
