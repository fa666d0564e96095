// SPDX-License-Identifier: MIT
// Numbers from distributions: quantiles known from closed forms or tables, and arguments out of
// bounds.
#include "compiler/bytecode/distributions.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The probability that a standard normal number lies below `x`.
double normal_probability(double x) {
    return std::erfc(-x / std::sqrt(2.0)) / 2.0;
}

TEST_CASE("The normal quantile is the inverse of the error function", "[distributions]") {
    CHECK(normal_quantile(0.5) == 0.0);
    for (const double p :
         {0x1p-25, 1e-5, 0.001, 0.074, 0.076, 0.3, 0.6, 0.925, 0.999, 1 - 0x1p-25}) {
        CAPTURE(p);
        CHECK(normal_probability(normal_quantile(p)) == Approx(p).epsilon(1e-14));
        CHECK(normal_quantile(1.0 - p) == Approx(-normal_quantile(p)).epsilon(1e-8));
    }
    CHECK(normal_quantile(0.975) == Approx(1.959963984540054).epsilon(1e-15));
}

TEST_CASE("Poisson numbers follow the sums of their terms", "[distributions]") {
    CHECK(poisson_quantile(0.0, 0.999) == 0);
    // e^-2 (1 + 2 + 2) = 0.67667641..., with one more term 0.85712346...
    CHECK(poisson_quantile(2.0, 0.6766) == 2);
    CHECK(poisson_quantile(2.0, 0.6767) == 3);
    CHECK(poisson_quantile(2.0, 0.8572) == 4);
    // The median of a Poisson distribution with a whole mean is the mean (Choi 1994).
    for (const double mean : {1.0, 30.0, 200.0, 700.0}) {
        CHECK(poisson_quantile(mean, 0.5) == static_cast<std::uint32_t>(mean));
    }
    CHECK(poisson_quantile(700.0, 0.0) == 0);
    CHECK(poisson_quantile(700.0, 1.0 - 0x1p-24) < 900);
}

TEST_CASE("Binomial numbers follow the sums of their terms", "[distributions]") {
    CHECK(binomial_quantile(0, 0.5, 0.9) == 0);
    CHECK(binomial_quantile(10, 0.0, 0.999) == 0);
    CHECK(binomial_quantile(10, 1.0, 0.0) == 10);
    CHECK(binomial_quantile(10, 0.5, 0.0) == 0);
    CHECK(binomial_quantile(10, 0.5, 0.5) == 5);
    CHECK(binomial_quantile(10, 0.5, 0.6230468) == 5); // 638/1024 = 0.623046875
    CHECK(binomial_quantile(10, 0.5, 0.623046875) == 6);
    CHECK(binomial_quantile(3, 0.25, 0.9) == 2);
    // The first terms are far below the smallest binary64: 0.01^10000.
    CHECK(binomial_quantile(10000, 0.99, 0.5) == 9900);
    CHECK(binomial_quantile(10000, 0.5, 0.5) == 5000);
    CHECK(binomial_quantile(10000, 0.5, 1.0 - 0x1p-24) < 5300);
}

TEST_CASE("Draws follow the mean and the variance of their distributions", "[distributions]") {
    struct Row {
        Opcode opcode;
        float x, y;
        double mean, variance;
    };
    const std::vector<Row> rows{{Opcode::Normal, 3.0F, 0.5F, 3.0, 0.25},
                                {Opcode::Poisson, 4.5F, 0.0F, 4.5, 4.5},
                                {Opcode::Binomial, 20.0F, 0.3F, 6.0, 4.2}};
    constexpr int kCount = 1 << 16;
    for (const Row& row : rows) {
        double sum = 0.0;
        double squares = 0.0;
        for (int i = 0; i < kCount; ++i) {
            const float u = (static_cast<float>(i) + 0.5F) / static_cast<float>(kCount);
            const double value = static_cast<double>(draw_from(row.opcode, row.x, row.y, u));
            sum += value;
            squares += value * value;
        }
        const double mean = sum / kCount;
        CHECK(mean == Approx(row.mean).epsilon(1e-3));
        CHECK(squares / kCount - mean * mean == Approx(row.variance).epsilon(2e-3));
    }
    CHECK(draw_from(Opcode::Normal, 7.0F, 0.0F, 0.3F) == 7.0F);
}

TEST_CASE("Arguments of distributions have bounds", "[distributions]") {
    using Fault = DistributionFault;
    CHECK(check_distribution(Opcode::Normal, -1.0F, 0.0F) == Fault::None);
    CHECK(check_distribution(Opcode::Normal, kInfinity, 1.0F) == Fault::Mean);
    CHECK(check_distribution(Opcode::Normal, 0.0F, -0.1F) == Fault::Deviation);
    CHECK(check_distribution(Opcode::Normal, 0.0F, kNan) == Fault::Deviation);
    CHECK(check_distribution(Opcode::Poisson, 700.0F, 0.0F) == Fault::None);
    CHECK(check_distribution(Opcode::Poisson, 700.1F, 0.0F) == Fault::Mean);
    CHECK(check_distribution(Opcode::Poisson, -0.1F, 0.0F) == Fault::Mean);
    CHECK(check_distribution(Opcode::Poisson, kNan, 0.0F) == Fault::Mean);
    CHECK(check_distribution(Opcode::Binomial, 10000.0F, 1.0F) == Fault::None);
    CHECK(check_distribution(Opcode::Binomial, 10001.0F, 0.5F) == Fault::Trials);
    CHECK(check_distribution(Opcode::Binomial, 2.5F, 0.5F) == Fault::Trials);
    CHECK(check_distribution(Opcode::Binomial, 3.0F, 1.1F) == Fault::Probability);
    CHECK(check_distribution(Opcode::Binomial, 3.0F, kNan) == Fault::Probability);
}

} // namespace

} // namespace lsys
