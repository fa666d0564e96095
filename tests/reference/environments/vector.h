// SPDX-License-Identifier: MIT
// Points and vectors of the plant in binary64, in metres and +Y up. Products and sums are rounded
// one by one, in the order written here.

#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace lsys::reference {

using Vector = std::array<double, 3>;

inline Vector difference(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double dot(const Vector& a, const Vector& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double length_of(const Vector& a) {
    return std::sqrt(dot(a, a));
}

// 0 0 0 for a vector without a length.
inline Vector unit(const Vector& a) {
    const double length = length_of(a);
    return length > 0 ? Vector{a[0] / length, a[1] / length, a[2] / length} : Vector{};
}

} // namespace lsys::reference
