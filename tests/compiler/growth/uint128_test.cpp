// SPDX-License-Identifier: MIT
#include "compiler/growth/uint128.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace lsys;

namespace {

constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();

static_assert(full_product(kMax, kMax) == Uint128(kMax - 1, 1));
static_assert(Uint128(1, 0) - 1 == kMax);
static_assert(Uint128(kMax) + 1 == Uint128(1, 0));
static_assert(Uint128(1, 0) > kMax && Uint128(2, 0) > Uint128(1, kMax));
static_assert(divide(Uint128(1, 0), 10).quotient == 1'844'674'407'370'955'161);
static_assert(divide(Uint128(1, 0), 10).remainder == 6);
static_assert(!checked_add(Uint128(kMax, kMax), 1));
static_assert(!checked_multiply(Uint128(1, 0), Uint128(1, 0)));

/// A random number of any magnitude.
Uint128 any_number(std::mt19937_64& random) {
    const Uint128 bits(random(), random());
    const auto cut = static_cast<int>(random() % 128);
    return cut >= 64 ? Uint128(bits.low >> (cut - 64)) : Uint128(bits.high >> cut, bits.low);
}

#ifdef __SIZEOF_INT128__
__extension__ using Native = unsigned __int128;

Native native(const Uint128& value) {
    return Native{value.high} << 64 | value.low;
}
Uint128 portable(Native value) {
    return {static_cast<std::uint64_t>(value >> 64), static_cast<std::uint64_t>(value)};
}
#endif

} // namespace

#ifdef __SIZEOF_INT128__
TEST_CASE("128-bit arithmetic agrees with the compiler's own") {
    std::mt19937_64 random(3);
    constexpr Native kMaxNative = ~Native{0};
    for (int round = 0; round < 20'000; ++round) {
        const Uint128 a = any_number(random);
        const Uint128 b = any_number(random);
        const auto divisor = static_cast<std::uint32_t>(any_number(random).low | 1);
        const Native x = native(a);
        const Native y = native(b);
        CAPTURE(a.high, a.low, b.high, b.low, divisor);
        CHECK((a < b) == (x < y));
        CHECK(a + b == portable(x + y));
        CHECK(a - b == portable(x - y));
        CHECK(a * b == portable(x * y));
        CHECK(checked_add(a, b).has_value() == (y <= kMaxNative - x));
        CHECK(checked_multiply(a, b).has_value() == (y == 0 || x <= kMaxNative / y));
        CHECK(divide(a, divisor).quotient == portable(x / divisor));
        CHECK(divide(a, divisor).remainder == x % divisor);
        CHECK(to_double(a) == static_cast<double>(x));
    }
}
#endif

TEST_CASE("a 128-bit number is rounded once") {
    // 2^64 + 2^11 lies halfway between two doubles; the even one is 2^64.
    CHECK(to_double(Uint128(1, 1U << 11)) == std::ldexp(1.0, 64));
    CHECK(to_double(Uint128(1, (1U << 11) + 1)) == std::ldexp(1.0, 64) + 4096.0);
    CHECK(to_double(Uint128(kMax, kMax)) == std::ldexp(1.0, 128));
}
