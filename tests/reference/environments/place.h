// SPDX-License-Identifier: MIT
// Inputs of an environment, taken from a word, and its answers (docs/language.md section 13.3).

#pragma once

#include "tests/reference/environments/vector.h"

#include <cstdint>
#include <vector>

namespace lsys::reference {

// A sense module in the plant.
struct Place {
    Vector position{};
    Vector heading{0, 1, 0};
    Vector up{0, 0, 1};
    std::vector<float> parameters = {};
};

// An object or a polygon, which casts shade.
struct Organ {
    Vector middle{};
    double area = 0; // m^2
};

// The numbers of an answer, one list for each place.
using Answers = std::vector<std::vector<double>>;

// A place without an answer; thrown.
struct NoAnswer {
    std::size_t place = 0; // index among the places
};

// The number as a module gets it: rounded once, and -0 becomes 0.
inline float rounded_answer(double number) {
    const auto narrow = static_cast<float>(number);
    return narrow == 0 ? 0.0F : narrow;
}

} // namespace lsys::reference
