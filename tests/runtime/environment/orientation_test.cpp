// SPDX-License-Identifier: MIT
// Exact predicates, compared with integers.
#include "runtime/environment/impl/orientation.h"
#include "tests/runtime/environment/clouds.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace lsys {

TEST_CASE("orientation in the plane has the sign of integer arithmetic") {
    environments::TestRandom random(1);
    for (int i = 0; i < 20'000; ++i) {
        // Points near one line, in units of 2^-30, so that binary64 cannot tell the sides.
        const auto number = [&](std::uint32_t below) {
            return static_cast<std::int64_t>(random.below(below));
        };
        const std::int64_t x = number(1U << 30);
        const std::int64_t y = number(1U << 30);
        const std::array<std::int64_t, 2> b{x + number(3), y + number(3)};
        const std::array<std::int64_t, 2> p{x / 2 + number(2), y / 2 + number(2)};
        // a is the origin: the sign of (-p) x (b - p) = b x p, reversed.
        const std::int64_t exact = p[1] * (b[0] - p[0]) - p[0] * (b[1] - p[1]);
        const auto point = [](const std::array<std::int64_t, 2>& n) {
            return Vector2{std::ldexp(static_cast<double>(n[0]), -30),
                           std::ldexp(static_cast<double>(n[1]), -30)};
        };
        const int expected = exact > 0 ? 1 : exact < 0 ? -1 : 0;
        REQUIRE(orientation({0.0, 0.0}, point(b), point(p)) == expected);
        REQUIRE(orientation(point(b), {0.0, 0.0}, point(p)) == -expected);
    }
}

TEST_CASE("orientation in space has the sign of integer arithmetic") {
    environments::TestRandom random(2);
    int zeros = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::array<std::array<std::int64_t, 3>, 3> rows{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            rows[0][axis] = static_cast<std::int64_t>(random.below(1U << 18));
            rows[1][axis] = static_cast<std::int64_t>(random.below(1U << 18));
            // A point near the plane of the other two points and the origin.
            rows[2][axis] = rows[0][axis] + rows[1][axis];
        }
        rows[2][random.below(3)] += static_cast<std::int64_t>(random.below(3)) - 1;
        std::int64_t exact = 0;
        for (std::size_t first = 0; first < 3; ++first) {
            const std::size_t second = (first + 1) % 3;
            const std::size_t third = (first + 2) % 3;
            exact += rows[0][first] *
                     (rows[1][second] * rows[2][third] - rows[1][third] * rows[2][second]);
        }
        // Moved far away, where the differences have few bits left.
        const double far = std::ldexp(1.0, 30 + static_cast<int>(random.below(22)));
        const auto point = [&](const std::array<std::int64_t, 3>& n) {
            return Vector3{far + static_cast<double>(n[0]), far + static_cast<double>(n[1]),
                           far + static_cast<double>(n[2])};
        };
        const int expected = exact > 0 ? 1 : exact < 0 ? -1 : 0;
        zeros += expected == 0 ? 1 : 0;
        const Vector3 p{far, far, far};
        REQUIRE(orientation(point(rows[0]), point(rows[1]), point(rows[2]), p) == expected);
        REQUIRE(orientation(point(rows[1]), point(rows[0]), point(rows[2]), p) == -expected);
    }
    CHECK(zeros > 1000);
}

TEST_CASE("orientation is exact where differences are not") {
    // p differs from the plane x + y + z = 1 by 2^-60 in one coordinate.
    const Vector3 a{1.0, 0.0, 0.0};
    const Vector3 b{0.0, 1.0, 0.0};
    const Vector3 c{0.0, 0.0, 1.0};
    const double tiny = 0x1p-60;
    CHECK(orientation(a, b, c, {0.5, 0.5, tiny}) == -1);
    CHECK(orientation(a, b, c, {0.5, 0.5, 0.0}) == 0);
    CHECK(orientation(a, b, c, {0.5, 0.5, -tiny}) == 1);
}

} // namespace lsys
