// SPDX-License-Identifier: MIT
// Half floats and rounded numbers as text.
#include "runtime/export/impl/half_digits.h"
#include "runtime/export/impl/text.h"

#include <catch2/catch.hpp>

#include <charconv>
#include <cmath>
#include <string>

using namespace lsys;

namespace {

std::string half_text(const HalfDigits& digits, float value) {
    std::string text(HalfDigits::kMaxBytes, ' ');
    text.resize(static_cast<std::size_t>(digits.put(text.data(), value) - text.data()));
    return text;
}

std::string rounded_text(float value, int decimals) {
    std::string text(kNumberBytes, ' ');
    text.resize(static_cast<std::size_t>(put_rounded(text.data(), value, decimals) - text.data()));
    return text;
}

} // namespace

TEST_CASE("half floats by the definition of binary16") {
    CHECK(half_value(0) == 0.0F);
    CHECK(half_value(1) == 0x1p-24F);
    CHECK(half_value(0x0400) == 0x1p-14F);
    CHECK(half_value(0x3555) == 0.333251953125F);
    CHECK(half_value(0x3C00) == 1.0F);
    CHECK(half_bits(1.0F / 3.0F) == 0x3555);
    // Ties go to the even neighbour: steps of 2^-11 below 1, of 2^-24 near 0.
    CHECK(half_bits(1.0F - 0x1p-12F) == 0x3C00);
    CHECK(half_bits(1.0F - 3 * 0x1p-12F) == 0x3BFE);
    CHECK(half_bits(0x1p-25F) == 0);
    CHECK(half_bits(3 * 0x1p-25F) == 2);
    CHECK(half_bits(std::nextafter(0x1p-14F, 0.0F)) == 0x0400);
    float last = -1.0F;
    for (std::uint16_t bits = 0; bits <= 0x3C00; ++bits) {
        const float value = half_value(bits);
        REQUIRE(value > last);
        REQUIRE(half_bits(value) == bits);
        last = value;
    }
}

TEST_CASE("the digits of a half float read back exactly, and no digit can be omitted") {
    const HalfDigits digits;
    CHECK(half_text(digits, 0.0F) == "0");
    CHECK(half_text(digits, -0.0F) == "0");
    CHECK(half_text(digits, -1.0F) == "-1");
    CHECK(half_text(digits, 1.0000001F) == "1");
    CHECK(half_text(digits, 0.70710678F) == "0.707");
    CHECK(half_text(digits, -0x1p-24F) == "-6e-08");
    for (std::uint16_t bits = 0; bits <= 0x3C00; ++bits) {
        const std::string text = half_text(digits, half_value(bits));
        float read = -1.0F;
        std::from_chars(text.data(), text.data() + text.size(), read);
        REQUIRE(half_bits(read) == bits);
    }
}

TEST_CASE("rounded numbers have no needless digits") {
    CHECK(rounded_text(0.0F, 4) == "0");
    CHECK(rounded_text(-0.0F, 4) == "0");
    CHECK(rounded_text(-0.00001F, 4) == "0");
    CHECK(rounded_text(0.00006F, 4) == "0.0001");
    CHECK(rounded_text(12.5F, 0) == "13");
    CHECK(rounded_text(-12.0F, 9) == "-12");
    CHECK(rounded_text(100.25F, 4) == "100.25");
    CHECK(rounded_text(0.05F, 3) == "0.05");
    CHECK(rounded_text(1e30F, 3) == "1e+30");
    for (int i = 0; i < 20'000; ++i) {
        const float value = 37.0F * std::sin(0.37F * static_cast<float>(i));
        for (const int decimals : {1, 3, 5}) {
            const std::string text = rounded_text(value, decimals);
            const double off = std::stod(text) - static_cast<double>(value);
            REQUIRE(std::abs(off) <= 0.5 * std::pow(10.0, -decimals) + 1e-12);
            REQUIRE((text.find('.') == std::string::npos || text.back() != '0'));
        }
    }
}
