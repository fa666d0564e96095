// SPDX-License-Identifier: MIT
#include "compiler/bytecode/arithmetic.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace lsys;
namespace a = lsys::arithmetic;

namespace {
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

bool positive_zero(float x) {
    return x == 0.0F && !std::signbit(x);
}
} // namespace

TEST_CASE("sine and cosine are exact at all multiples of 90 degrees, also large ones") {
    for (const float turns : {0.0F, 360.0F, -360.0F, 720.0F, 3.6e6F, -3.6e6F}) {
        CHECK(positive_zero(a::sine(turns)));
        CHECK(positive_zero(a::sine(turns + 180.0F)));
        CHECK(positive_zero(a::cosine(turns + 90.0F)));
        CHECK(positive_zero(a::cosine(turns - 90.0F)));
        CHECK(a::sine(turns + 90.0F) == 1.0F);
        CHECK(a::sine(turns - 90.0F) == -1.0F);
        CHECK(a::cosine(turns) == 1.0F);
        CHECK(a::cosine(turns + 180.0F) == -1.0F);
    }
    CHECK(positive_zero(a::sine(-0.0F)));
    CHECK(a::sine(30.0F) == 0.5F);
    CHECK(a::cosine(60.0F) == 0.5F);
}

TEST_CASE("the tangent is infinite at odd multiples of 90 degrees") {
    CHECK(positive_zero(a::tangent(180.0F)));
    CHECK(positive_zero(a::tangent(-180.0F)));
    CHECK(a::tangent(90.0F) == kInfinity);
    CHECK(a::tangent(270.0F) == -kInfinity);
    CHECK(a::tangent(-90.0F) == -kInfinity);
    CHECK(a::tangent(-270.0F) == kInfinity);
    CHECK(a::tangent(450.0F) == kInfinity);
    CHECK(a::tangent(45.0F) == 1.0F);
}

TEST_CASE("the sine of a NaN or of infinity is NaN") {
    CHECK(std::isnan(a::sine(kInfinity)));
    CHECK(std::isnan(a::cosine(-kInfinity)));
    CHECK(std::isnan(a::tangent(kNan)));
}

TEST_CASE("inverse functions yield degrees") {
    CHECK(a::arc_sine(1.0F) == 90.0F);
    CHECK(a::arc_cosine(-1.0F) == 180.0F);
    CHECK(a::arc_tangent(1.0F) == 45.0F);
    CHECK(a::arc_tangent2(1.0F, -1.0F) == 135.0F);
    CHECK(std::isnan(a::arc_sine(2.0F)));
}

TEST_CASE("a power is computed in binary64 and rounded once") {
    CHECK(a::power(2.0F, 10.0F) == 1024.0F);
    CHECK(a::power(0.0F, -1.0F) == kInfinity);
    CHECK(std::isnan(a::power(-2.0F, 0.5F)));
    CHECK(a::power(1.1F, 2.0F) == static_cast<float>(std::pow(static_cast<double>(1.1F), 2.0)));
}

TEST_CASE("logical operators treat NaN as true") {
    CHECK(a::logical_not(0.0F) == 1.0F);
    CHECK(a::logical_not(-0.0F) == 1.0F);
    CHECK(a::logical_not(kNan) == 0.0F);
    CHECK(a::logical_and(kNan, 1.0F) == 1.0F);
    CHECK(a::logical_or(0.0F, kNan) == 1.0F);
    CHECK(a::logical_and(2.0F, 0.0F) == 0.0F);
}

TEST_CASE("rounding, signs and extremes") {
    CHECK(a::nearest(2.5F) == 3.0F);
    CHECK(a::nearest(-2.5F) == -3.0F);
    CHECK(a::sign(-3.0F) == -1.0F);
    CHECK(std::signbit(a::sign(-0.0F)));
    CHECK(std::isnan(a::sign(kNan)));
    CHECK(std::isnan(a::minimum(kNan, 1.0F)));
    CHECK(a::minimum(1.0F, kNan) == 1.0F);
    CHECK(a::maximum(1.0F, 2.0F) == 2.0F);
    CHECK(a::remainder(-7.0F, 3.0F) == -1.0F);
}

TEST_CASE("every opcode between negate and mod can be applied") {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < kOpcodeCount; ++i) {
        const auto opcode = static_cast<Opcode>(i);
        if (a::is_arithmetic(opcode)) {
            ++count;
            CHECK(info(opcode).pushes == 1);
            CHECK(info(opcode).operand == OperandKind::None);
            static_cast<void>(a::apply(opcode, 0.25F, 0.5F));
        }
    }
    CHECK(count == 33);
    CHECK(a::apply(Opcode::Atan2, 1.0F, 0.0F) == 90.0F);
    CHECK(a::apply(Opcode::Mod, 5.5F, 2.0F) == 1.5F);
    CHECK(a::apply(Opcode::LessEqual, 2.0F, 2.0F) == 1.0F);
}
