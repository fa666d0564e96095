// SPDX-License-Identifier: MIT
#include "tests/reference/environments/sky.h"

#include "tests/reference/environments/exact.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace lsys::reference {

namespace {

using Cell = std::array<std::int64_t, 3>;

// Throws NoAnswer for an index beyond +-2^31.
Cell cell_of(const Vector& point, double edge, std::size_t place) {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double index = std::floor(point[axis] / edge);
        if (!(std::fabs(index) <= 2147483648.0)) {
            throw NoAnswer{place};
        }
        cell[axis] = static_cast<std::int64_t>(index);
    }
    return cell;
}

struct Leaf {
    Cell cell{};
    double area = 0;
};

// The organs, and the box of their cells.
struct Leaves {
    std::vector<Leaf> leaves;
    Cell low{};
    Cell high{};
};

Leaves leaves_of(const std::vector<Organ>& organs, double edge) {
    Leaves result;
    result.low.fill(std::numeric_limits<std::int64_t>::max());
    result.high.fill(std::numeric_limits<std::int64_t>::min());
    for (const Organ& organ : organs) {
        if (organ.area == 0) {
            continue;
        }
        const Cell cell = cell_of(organ.middle, edge, 0);
        result.leaves.push_back({cell, organ.area});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            result.low[axis] = std::min(result.low[axis], cell[axis]);
            result.high[axis] = std::max(result.high[axis], cell[axis]);
        }
    }
    return result;
}

std::vector<Vector> directions_of(const Sky& sky) {
    std::vector<Vector> directions;
    for (int i = 0; i < sky.directions; ++i) {
        const double s = (static_cast<double>(i) + 0.5) / static_cast<double>(sky.directions);
        const SineCosine azimuth =
            sine_cosine_of_degrees(static_cast<double>(i) * 180.0 * (3.0 - std::sqrt(5.0)));
        const double level = std::sqrt(1.0 - s * s);
        directions.push_back({level * azimuth.cosine, s, level * azimuth.sine});
    }
    return directions;
}

// Whether a ray from `cell` on in `direction` meets no more leaf.
bool has_passed(const Leaves& leaves, const Cell& cell, const Vector& direction) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((direction[axis] >= 0 && cell[axis] > leaves.high[axis]) ||
            (direction[axis] <= 0 && cell[axis] < leaves.low[axis])) {
            return true;
        }
    }
    return false;
}

// The optical depth along the ray from `place` in `direction`.
double depth_of(const Sky& sky, const Leaves& leaves, const Place& place, const Vector& direction) {
    Cell at = cell_of(place.position, sky.cell, 0);
    double passed = 0;
    double depth = 0;
    while (!has_passed(leaves, at, direction)) {
        std::size_t nearest = 0;
        Vector exits{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (direction[axis] != 0) {
                const std::int64_t plane = direction[axis] > 0 ? at[axis] + 1 : at[axis];
                exits[axis] = (static_cast<double>(plane) * sky.cell - place.position[axis]) /
                              direction[axis];
            }
            nearest = exits[axis] < exits[nearest] ? axis : nearest;
        }
        const double path = std::max(0.0, exits[nearest] - passed);
        double area = 0;
        for (const Leaf& leaf : leaves.leaves) {
            area += leaf.cell == at ? leaf.area : 0;
        }
        depth += sky.extinction * area / (sky.cell * sky.cell * sky.cell) * path;
        passed = std::max(passed, exits[nearest]);
        at[nearest] += direction[nearest] > 0 ? 1 : -1;
    }
    return depth;
}

} // namespace

Answers
sky_answers(const Sky& sky, const std::vector<Organ>& organs, const std::vector<Place>& places) {
    const bool is_empty =
        sky.extinction == 0 || std::all_of(organs.begin(), organs.end(),
                                           [](const Organ& organ) { return organ.area == 0; });
    if (is_empty) {
        return Answers(places.size(), {1.0});
    }
    const Leaves leaves = leaves_of(organs, sky.cell);
    const std::vector<Vector> directions = directions_of(sky);
    Answers answers;
    for (std::size_t k = 0; k < places.size(); ++k) {
        cell_of(places[k].position, sky.cell, k);
        double light = 0;
        double weights = 0;
        for (const Vector& direction : directions) {
            const double weight = direction[1]; // the sine of its elevation
            light += weight * exponential(-depth_of(sky, leaves, places[k], direction));
            weights += weight;
        }
        answers.push_back({light / weights});
    }
    return answers;
}

} // namespace lsys::reference
