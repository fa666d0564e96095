// SPDX-License-Identifier: MIT
// Environments of kind `crowd`, computed from every pair of places.

#pragma once

#include "tests/reference/environments/place.h"

namespace lsys::reference {

// The sum of numbers rounded once (Shewchuk 1997, "Adaptive precision floating-point arithmetic",
// section 2.4).
double rounded_sum(const std::vector<double>& numbers);

// For each place: the number n of other places within the radius, and a direction x y z away from
// them.
Answers crowd_answers(double radius, const std::vector<Place>& places);

} // namespace lsys::reference
