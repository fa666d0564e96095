// SPDX-License-Identifier: MIT
#include "tests/reference/environments/crowd.h"

namespace lsys::reference {

// Keeps partial sums that do not overlap, and adds them from the largest on.
double rounded_sum(const std::vector<double>& numbers) {
    std::vector<double> parts; // ascending, not overlapping
    for (double number : numbers) {
        std::vector<double> next;
        for (const double part : parts) {
            const double sum = number + part;
            const double other = sum - number;
            const double error = (number - (sum - other)) + (part - other);
            if (error != 0) {
                next.push_back(error);
            }
            number = sum;
        }
        next.push_back(number);
        parts = next;
    }
    double sum = 0;
    while (!parts.empty()) {
        const double part = parts.back();
        parts.pop_back();
        const double next = sum + part;
        const double rest = part - (next - sum);
        sum = next;
        if (rest != 0) {
            // If `rest` is half a unit, `sum` was rounded to even, ignoring smaller parts.
            if (!parts.empty() && (parts.back() < 0) == (rest < 0)) {
                const double twice = 2 * rest;
                const double moved = sum + twice;
                if (moved - sum == twice) {
                    sum = moved;
                }
            }
            break;
        }
    }
    return sum;
}

Answers crowd_answers(double radius, const std::vector<Place>& places) {
    Answers answers;
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::array<std::vector<double>, 3> ways; // terms of the sum of p - q
        std::size_t count = 0;
        const Vector& p = places[i].position;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const Vector d = difference(p, places[k].position);
            if (k != i && dot(d, d) < radius * radius) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    ways[axis].insert(ways[axis].end(), {p[axis], -places[k].position[axis]});
                }
                ++count;
            }
        }
        const Vector away =
            unit({rounded_sum(ways[0]), rounded_sum(ways[1]), rounded_sum(ways[2])});
        answers.push_back({static_cast<double>(count), away[0], away[1], away[2]});
    }
    return answers;
}

} // namespace lsys::reference
