// SPDX-License-Identifier: MIT
// Environments of kind `shadow`, computed from pyramids that are stored voxel by voxel.

#pragma once

#include "tests/reference/environments/place.h"

namespace lsys::reference {

// The keys of `#sense NAME shadow` (docs/language.md, section 13.2).
struct Shadow {
    double cell = 0.5;
    int levels = 8;
    double strength = static_cast<double>(0.2F);
    double ratio = 2;
};

// For each place: exposure q to light, and the direction x y z of more light.
Answers shadow_answers(const Shadow& shadow, const std::vector<Place>& places);

} // namespace lsys::reference
