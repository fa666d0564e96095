// SPDX-License-Identifier: MIT
// Environments of kind `sky`, computed by rays cell by cell, each cell compared with every organ.

#pragma once

#include "tests/reference/environments/place.h"

namespace lsys::reference {

// The keys of `#sense NAME sky` (docs/language.md, section 13.2).
struct Sky {
    double cell = 0.5;
    double extinction = 0.5;
    int directions = 46;
};

// For each place: q, the part of the light of the sky that arrives.
Answers
sky_answers(const Sky& sky, const std::vector<Organ>& organs, const std::vector<Place>& places);

} // namespace lsys::reference
