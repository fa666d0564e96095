// SPDX-License-Identifier: MIT
// Environments of kind `map`, computed as bilinear grey values of a picture.

#pragma once

#include "tests/reference/environments/place.h"

namespace lsys::reference {

// Grey values by rows: column 0 at the least x, row 0 at the least z.
struct GreyPicture {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<double> values; // 0 to 1
};

// The keys of `#sense NAME map` (docs/language.md, section 13.2).
struct GreyMap {
    GreyPicture picture;
    std::array<double, 2> size{1, 1}; // x, z
    std::array<double, 2> at{0, 0};   // x, z
    double low = 0;                   // value of black
    double high = 1;                  // value of white
};

// For each place: the value v of the map.
Answers map_answers(const GreyMap& map, const std::vector<Place>& places);

} // namespace lsys::reference
