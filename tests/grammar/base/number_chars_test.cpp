// SPDX-License-Identifier: MIT
// portable_chars writes and reads numbers like the standard library.
#include "grammar/base/impl/portable_chars.h"
#include "grammar/base/number_chars.h"

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>

using namespace lsys;

namespace {

constexpr std::size_t kRoom = 512; // characters; more than any number without an exponent has

/// The result of reading a number.
struct Reading {
    std::errc error{};
    std::ptrdiff_t length = 0;
    std::uint64_t bits = 0;

    friend bool operator==(const Reading&, const Reading&) = default;
};

template <typename Number>
std::uint64_t bits_of(Number value) {
    if constexpr (sizeof value == sizeof(std::uint32_t)) {
        return std::bit_cast<std::uint32_t>(value);
    } else {
        return std::bit_cast<std::uint64_t>(value);
    }
}

template <typename Number>
Reading standard_reading(std::string_view text) {
    Number value{7}; // stays 7 if there is an error
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return {error, end - text.data(), bits_of(value)};
}

template <typename Number>
Reading portable_reading(std::string_view text) {
    Number value{7};
    const auto [end, error] = portable_from_chars(text.data(), text.data() + text.size(), value);
    return {error, end - text.data(), bits_of(value)};
}

/// Numbers of four alternating kinds: random bits, few digits after the point, whole, round.
template <typename Number, typename Bits>
Number random_number(std::mt19937_64& random, std::uint64_t kind) {
    switch (kind % 4) {
    case 0:
        return std::bit_cast<Number>(static_cast<Bits>(random()));
    case 1:
        return static_cast<Number>(static_cast<double>(random() % 100'000'000) /
                                   std::pow(10.0, static_cast<double>(random() % 12)));
    case 2:
        return static_cast<Number>(random() >> (random() % 64));
    default:
        return static_cast<Number>(static_cast<double>(random() % 1000) *
                                   std::pow(10.0, static_cast<double>(random() % 60) - 30.0));
    }
}

/// Writes and reads `count` numbers; returns the text of the first that differs.
template <typename Number, typename Bits>
std::string first_difference(std::uint64_t count) {
    std::mt19937_64 random(7);
    std::array<char, kRoom> standard{};
    std::array<char, kRoom> portable{};
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto value = random_number<Number, Bits>(random, i);
        for (const bool is_fixed : {false, true}) {
            char* const end = standard.data() + kRoom;
            const auto [last, error] =
                is_fixed ? std::to_chars(standard.data(), end, value, std::chars_format::fixed)
                         : std::to_chars(standard.data(), end, value);
            const std::string_view text(standard.data(),
                                        static_cast<std::size_t>(last - standard.data()));
            const auto [other_last, other_error] =
                portable_to_chars(portable.data(), portable.data() + kRoom, value, is_fixed);
            const std::string_view other(portable.data(),
                                         static_cast<std::size_t>(other_last - portable.data()));
            if (error != std::errc() || other_error != std::errc() || text != other ||
                standard_reading<Number>(text) != portable_reading<Number>(text)) {
                return std::string(text) + " and " + std::string(other);
            }
        }
    }
    return {};
}

void check_readings(std::string_view text) {
    CAPTURE(text);
    CHECK(standard_reading<float>(text) == portable_reading<float>(text));
    CHECK(standard_reading<double>(text) == portable_reading<double>(text));
}

} // namespace

TEST_CASE("numbers have the same characters with and without the standard library") {
    CHECK(first_difference<float, std::uint32_t>(100'000).empty());
    CHECK(first_difference<double, std::uint64_t>(100'000).empty());
}

TEST_CASE("ten million numbers have the same characters", "[.]") {
    CHECK(first_difference<float, std::uint32_t>(10'000'000).empty());
    CHECK(first_difference<double, std::uint64_t>(10'000'000).empty());
}

TEST_CASE("invalid, too large and too small numbers are read in the same way") {
    for (const char* text :
         {"",       "-",    "+1",       ".",       "e5",    " 1",     "x",       "1e",
          "1e+",    "5.",   ".5",       "-.5",     "0x10",  "1.5e5x", "0.0000e", "1e400",
          "-1e400", "1e39", "1e-400",   "1e-320",  "4e-46", "1e-46",  "0e9999",  "inf",
          "-inf",   "INF",  "infinity", "infinit", "nan",   "-nan",   "nan(x)",  "nan("}) {
        check_readings(text);
    }
    check_readings("1e99999999999999999999");
    check_readings("0." + std::string(400, '0') + "1");
    check_readings(std::string(400, '9'));
    check_readings("1." + std::string(400, '0') + "1");
}

TEST_CASE("numbers of small types are written in the same way, also with too little room") {
    for (const double value :
         {0.0, -0.0, 1.0, -1.0, 1e5, 1e6, 123456.0, 1e22, 1e23, 0.0001, 0.00001, 1.5e-4, 1e-5,
          123456789012345680000.0, 5e-324, std::numeric_limits<double>::max(),
          std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()}) {
        for (const std::size_t room : {0U, 1U, 5U, 32U}) {
            std::array<char, 32> standard{};
            std::array<char, 32> portable{};
            const auto one = std::to_chars(standard.data(), standard.data() + room, value);
            const auto other =
                portable_to_chars(portable.data(), portable.data() + room, value, false);
            CAPTURE(value, room);
            CHECK(one.ec == other.ec);
            CHECK(one.ptr - standard.data() == other.ptr - portable.data());
            if (one.ec == std::errc()) {
                CHECK(standard == portable);
            }
        }
    }
}

TEST_CASE("numbers are read and written by one pair of functions") {
    std::array<char, 32> chars{};
    char* const end = number_to_chars(chars.data(), chars.data() + chars.size(), 0.1F).ptr;
    CHECK(std::string_view(chars.data(), static_cast<std::size_t>(end - chars.data())) == "0.1");
    float value = 0.0F;
    CHECK(number_from_chars(chars.data(), end, value).ptr == end);
    CHECK(value == 0.1F);
    int whole = 0;
    const std::string_view text = "42";
    CHECK(number_from_chars(text.data(), text.data() + text.size(), whole).ec == std::errc());
    CHECK(whole == 42);
}
