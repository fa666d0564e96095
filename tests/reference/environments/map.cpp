// SPDX-License-Identifier: MIT
#include "tests/reference/environments/map.h"

#include <algorithm>

namespace lsys::reference {

namespace {

// Pixels beyond the border have the value of the border.
double pixel(const GreyPicture& picture, double column, double row) {
    const double last_column = static_cast<double>(picture.columns) - 1;
    const double last_row = static_cast<double>(picture.rows) - 1;
    const auto x = static_cast<std::size_t>(std::clamp(column, 0.0, last_column));
    const auto z = static_cast<std::size_t>(std::clamp(row, 0.0, last_row));
    return picture.values[z * picture.columns + x];
}

// The distance from the middle of the first pixel, in pixels.
double in_pixels(double place, double at, double size, std::size_t count) {
    return ((place - at) / size + 0.5) * static_cast<double>(count) - 0.5;
}

} // namespace

Answers map_answers(const GreyMap& map, const std::vector<Place>& places) {
    const GreyPicture& picture = map.picture;
    Answers answers;
    for (const Place& place : places) {
        const double x = in_pixels(place.position[0], map.at[0], map.size[0], picture.columns);
        const double z = in_pixels(place.position[2], map.at[1], map.size[1], picture.rows);
        const double column = std::floor(x);
        const double row = std::floor(z);
        const double u = x - column;
        const double v = z - row;
        const double grey = (1 - v) * ((1 - u) * pixel(picture, column, row) +
                                       u * pixel(picture, column + 1, row)) +
                            v * ((1 - u) * pixel(picture, column, row + 1) +
                                 u * pixel(picture, column + 1, row + 1));
        answers.push_back({map.low + (map.high - map.low) * grey});
    }
    return answers;
}

} // namespace lsys::reference
