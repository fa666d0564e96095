// SPDX-License-Identifier: MIT
#include "tests/reference/environments/surface.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace lsys::reference {

namespace {

using Edge = std::pair<Vector, Vector>;

bool has_equal_corners(const Triangle& triangle) {
    return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

// An edge without direction.
Edge edge_of(const Triangle& triangle, std::size_t side) {
    const Vector& a = triangle[side];
    const Vector& b = triangle[(side + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
}

// Whether the edge leads from a to b.
bool goes(const Triangle& triangle, const Vector& a, const Vector& b) {
    return (triangle[0] == a && triangle[1] == b) || (triangle[1] == a && triangle[2] == b) ||
           (triangle[2] == a && triangle[0] == b);
}

// The foot of the place on the plane of the triangle, if it is inside, and the nearest points of
// the three sides.
std::vector<Vector> candidates_of(const Triangle& triangle, const Vector& place) {
    std::vector<Vector> candidates;
    const auto& [a, b, c] = triangle;
    const Vector u = difference(b, a);
    const Vector v = difference(c, a);
    const Vector w = difference(place, a);
    const Vector normal = cross(u, v);
    if (const double s = dot(normal, normal); s > 0) {
        const double beta = dot(cross(w, v), normal) / s;
        const double gamma = dot(cross(u, w), normal) / s;
        if (beta >= 0 && gamma >= 0 && beta + gamma <= 1) {
            Vector foot{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                foot[axis] = (a[axis] + u[axis] * beta) + v[axis] * gamma;
            }
            candidates.push_back(foot);
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector& from = triangle[i];
        const Vector side = difference(triangle[(i + 1) % 3], from);
        const double squared = dot(side, side);
        const double along = squared > 0 ? dot(difference(place, from), side) / squared : 0.0;
        const double t = std::clamp(along, 0.0, 1.0);
        candidates.push_back({from[0] + side[0] * t, from[1] + side[1] * t, from[2] + side[2] * t});
    }
    return candidates;
}

} // namespace

Vector way_to(const Triangle& triangle, const Vector& place) {
    Vector nearest{};
    double least = std::numeric_limits<double>::infinity();
    for (Vector point : candidates_of(triangle, place)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] =
                std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
            point[axis] = std::clamp(point[axis], low, high);
        }
        const Vector way = difference(point, place);
        if (dot(way, way) < least) {
            nearest = way;
            least = dot(way, way);
        }
    }
    return nearest;
}

bool has_area(const Triangle& triangle) {
    return cross(difference(triangle[1], triangle[0]), difference(triangle[2], triangle[0])) !=
           Vector{};
}

bool is_closed(const Surface& surface) {
    std::map<Edge, int> counts;
    for (const Triangle& triangle : surface) {
        for (std::size_t side = 0; side < 3 && !has_equal_corners(triangle); ++side) {
            ++counts[edge_of(triangle, side)];
        }
    }
    return !counts.empty() && std::all_of(counts.begin(), counts.end(),
                                          [](const auto& edge) { return edge.second == 2; });
}

Surface oriented(const Surface& surface) {
    Surface result;
    std::copy_if(surface.begin(), surface.end(), std::back_inserter(result),
                 [](const Triangle& triangle) { return !has_equal_corners(triangle); });
    std::vector<bool> done(result.size());
    for (std::size_t first = 0; first < result.size(); ++first) {
        std::vector<std::size_t> next;
        if (!done[first]) {
            done[first] = true;
            next.push_back(first);
        }
        while (!next.empty()) {
            const std::size_t triangle = next.back();
            next.pop_back();
            for (std::size_t other = 0; other < result.size(); ++other) {
                for (std::size_t side = 0; side < 3 && !done[other]; ++side) {
                    const Vector& a = result[triangle][side];
                    const Vector& b = result[triangle][(side + 1) % 3];
                    const bool same_way = goes(result[other], a, b);
                    if (same_way) { // neighbours that face one side go along an edge both ways
                        std::swap(result[other][1], result[other][2]);
                    }
                    if (same_way || goes(result[other], b, a)) {
                        done[other] = true;
                        next.push_back(other);
                    }
                }
            }
        }
    }
    return result;
}

int winding_number(const Surface& surface, const Vector& place) {
    long double angles = 0; // half of the solid angles
    for (const Triangle& triangle : surface) {
        std::array<std::array<long double, 3>, 3> ways{};
        std::array<long double, 3> lengths{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                ways[corner][axis] = static_cast<long double>(triangle[corner][axis]) -
                                     static_cast<long double>(place[axis]);
            }
            const auto& [x, y, z] = ways[corner];
            lengths[corner] = std::sqrt(x * x + y * y + z * z);
        }
        const auto dot_of = [](const auto& a, const auto& b) {
            return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        };
        const auto& [a, b, c] = ways;
        const long double volume = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                                   a[1] * (b[2] * c[0] - b[0] * c[2]) +
                                   a[2] * (b[0] * c[1] - b[1] * c[0]);
        angles +=
            std::atan2(volume, lengths[0] * lengths[1] * lengths[2] + dot_of(a, b) * lengths[2] +
                                   dot_of(b, c) * lengths[0] + dot_of(c, a) * lengths[1]);
    }
    constexpr long double kTwoPi = 6.283185307179586476925286766559L;
    return static_cast<int>(std::lround(angles / kTwoPi));
}

} // namespace lsys::reference
