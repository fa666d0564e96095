// SPDX-License-Identifier: MIT
// The arithmetic of section 4 of the language reference, one operation at a time. Every value is
// binary32. Functions other than `+ - * / sqrt` are computed in binary64 and rounded once.

#pragma once

#include "tests/reference/grammar.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lsys::reference {

// A function of the grammar: an expression with formals, or a curve through points.
struct UserFunction {
    std::vector<std::string> formals; // empty: a curve
    Expr body;
    std::vector<std::pair<float, float>> points;
};

using Functions = std::map<std::string, UserFunction>;

// Values of the names in an expression, and the source of its random numbers.
struct Environment {
    const std::map<std::string, float>* constants = nullptr;
    const Functions* functions = nullptr;
    std::map<std::string, float> formals; // a formal hides a constant of the same name
    float step = 0;
    float steps = 0;
    // Returns a random number. Called once for each range and distribution, in the order of their
    // closing braces and parentheses.
    std::function<float()> draw;
};

// Thrown for a range whose bounds are not finite, in the wrong order or too far apart, and for a
// distribution with an argument outside of its bounds.
struct BadRange {};

// Whether an expression draws a random number itself, not only in its operands: whether it is a
// range or a distribution.
bool draws(const Expr& expr);

// The value of `expr`. Precondition: `environment` has every name in it.
float evaluate(const Expr& expr, const Environment& environment);

// The monotone cubic through the points (Fritsch and Carlson 1980).
float curve_value(const std::vector<std::pair<float, float>>& points, float t);

// `min + (max - min) * u`, kept below max.
float range_value(float min, float max, float u);

// The value of the distribution `name` (normal, poisson or binomial) for the random number `u`.
float distribution_value(const std::string& name, const std::vector<float>& arguments, float u);

// The value of an operator or a function with the given operands.
float apply_operator(const std::string& name, const std::vector<float>& operands);
float apply_function(const std::string& name, const std::vector<float>& operands);

} // namespace lsys::reference
