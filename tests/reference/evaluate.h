// The arithmetic of section 4 of the language reference, one operation at a time. Every value is a
// binary32; the functions that are not `+ - * / sqrt` are computed in binary64 and rounded once.

#pragma once

#include "tests/reference/grammar.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lsys::reference {

// What the names of an expression mean, and where its ranges get their random numbers.
struct Environment {
    const std::map<std::string, float>* constants = nullptr;
    std::map<std::string, float> formals; // hide constants
    float step = 0;
    float steps = 0;
    std::function<float()> draw; // called once for every range, in the order of closing braces
};

// Thrown for a range whose bounds are not finite, in the wrong order, or too far apart.
struct BadRange {};

// The value of `expr`. Precondition: every name in it has a meaning.
float evaluate(const Expr& expr, const Environment& environment);

// `min + (max - min) * u`, kept below max.
float range_value(float min, float max, float u);

// The value of a unary or binary operator, or of a function, for the given operands.
float apply_operator(const std::string& name, const std::vector<float>& operands);
float apply_function(const std::string& name, const std::vector<float>& operands);

} // namespace lsys::reference
