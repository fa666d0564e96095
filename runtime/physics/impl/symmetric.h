// SPDX-License-Identifier: MIT
// Small matrices of the physics: symmetric matrices (inertia) and matrices stored by rows (couplings).
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

struct Symmetric {
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;

    [[nodiscard]] double trace() const { return xx + yy + zz; }
    void add_diagonal(double value) {
        xx += value;
        yy += value;
        zz += value;
    }
    Symmetric& operator+=(const Symmetric& other) {
        xx += other.xx;
        yy += other.yy;
        zz += other.zz;
        xy += other.xy;
        xz += other.xz;
        yz += other.yz;
        return *this;
    }
    [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
};

[[nodiscard]] inline Symmetric scaled(const Symmetric& a, double factor) {
    return {a.xx * factor, a.yy * factor, a.zz * factor,
            a.xy * factor, a.xz * factor, a.yz * factor};
}

/// The inertia about the origin of a point mass at v: mass (|v|^2 - v v^T).
[[nodiscard]] inline Symmetric point_inertia(double mass, const glm::dvec3& v) {
    return {mass * (v.y * v.y + v.z * v.z),
            mass * (v.x * v.x + v.z * v.z),
            mass * (v.x * v.x + v.y * v.y),
            -mass * v.x * v.y,
            -mass * v.x * v.z,
            -mass * v.y * v.z};
}

/// The product R a R^T.
[[nodiscard]] inline Symmetric rotated(const Symmetric& a, const glm::dmat3& r) {
    const glm::dvec3 x(r[0][0], r[1][0], r[2][0]); // rows
    const glm::dvec3 y(r[0][1], r[1][1], r[2][1]);
    const glm::dvec3 z(r[0][2], r[1][2], r[2][2]);
    const glm::dvec3 ax = a * x;
    const glm::dvec3 ay = a * y;
    const glm::dvec3 az = a * z;
    return {glm::dot(x, ax), glm::dot(y, ay), glm::dot(z, az),
            glm::dot(x, ay), glm::dot(x, az), glm::dot(y, az)};
}

/// Whether `a` is positive definite by more than rounding errors.
[[nodiscard]] inline bool is_positive(const Symmetric& a) {
    const double min_pivot = 1e-12 * a.trace();
    if (!(a.xx > min_pivot)) {
        return false;
    }
    const double d1 = a.yy - a.xy * a.xy / a.xx;
    const double e21 = a.yz - a.xz * a.xy / a.xx;
    return min_pivot >= 0.0 && d1 > min_pivot &&
           a.zz - a.xz * a.xz / a.xx - e21 * e21 / d1 > min_pivot;
}

struct Eigenvectors {
    std::array<double, 3> values{};
    std::array<glm::dvec3, 3> vectors{}; // of length 1
};

/// The eigenvectors of `a` by Jacobi's method (Golub & Van Loan 2013, section 8.5).
[[nodiscard]] inline Eigenvectors eigenvectors_of(const Symmetric& a) {
    constexpr int kSweeps = 10; // the method doubles the correct digits per sweep
    glm::dmat3 m(a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz);
    Eigenvectors out;
    out.vectors = {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0.0) {
                    continue;
                }
                // The rotation in the plane of the axes p and q that makes m[p][q] zero.
                const double ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                const double tangent =
                    std::copysign(1.0, ratio) / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio));
                const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
                const double sine = tangent * cosine;
                const int r = 3 - p - q;
                m[p][p] -= tangent * m[p][q];
                m[q][q] += tangent * m[p][q];
                m[p][q] = m[q][p] = 0.0;
                const glm::dvec2 others(m[r][p], m[r][q]);
                m[r][p] = m[p][r] = cosine * others.x - sine * others.y;
                m[r][q] = m[q][r] = sine * others.x + cosine * others.y;
                glm::dvec3& u = out.vectors[static_cast<std::size_t>(p)];
                glm::dvec3& v = out.vectors[static_cast<std::size_t>(q)];
                const glm::dvec3 before = u;
                u = cosine * before - sine * v;
                v = sine * before + cosine * v;
            }
        }
    }
    out.values = {m[0][0], m[1][1], m[2][2]};
    return out;
}

/// The matrix that, added to `a`, turns each eigenvalue into its absolute value, but at least 1e-9
/// of the largest absolute value. The eigenvectors stay the same.
[[nodiscard]] inline Symmetric lift_to_positive(const Symmetric& a) {
    constexpr double kMinShare = 1e-9;
    const Eigenvectors eigen = eigenvectors_of(a);
    double largest = 0.0;
    for (const double value : eigen.values) {
        largest = std::max(largest, std::abs(value));
    }
    Symmetric lift;
    for (std::size_t i = 0; i < 3; ++i) {
        const double more =
            std::max(std::abs(eigen.values[i]), kMinShare * largest) - eigen.values[i];
        const glm::dvec3& v = eigen.vectors[i];
        lift += scaled({v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z}, more);
    }
    return lift;
}

/// The inverse of a positive definite matrix by its L D L^T decomposition. A pivot that rounding
/// has made too small is raised, so that the result is always positive definite. Precondition: the
/// trace is positive.
[[nodiscard]] inline Symmetric inverse(const Symmetric& a) {
    constexpr double kMinPivot = 1e-15; // relative to the trace
    const double scale = 1.0 / a.trace();
    const Symmetric s = scaled(a, scale);
    const double d0 = std::max(s.xx, kMinPivot);
    const double l10 = s.xy / d0;
    const double l20 = s.xz / d0;
    const double d1 = std::max(s.yy - l10 * s.xy, kMinPivot);
    const double e21 = s.yz - l20 * s.xy;
    const double l21 = e21 / d1;
    const double d2 = std::max(s.zz - l20 * s.xz - l21 * e21, kMinPivot);
    const double m20 = l10 * l21 - l20; // element of the inverse of L
    const double i0 = scale / d0;
    const double i1 = scale / d1;
    const double i2 = scale / d2;
    return {i0 + l10 * l10 * i1 + m20 * m20 * i2,
            i1 + l21 * l21 * i2,
            i2,
            -l10 * i1 - m20 * l21 * i2,
            m20 * i2,
            -l21 * i2};
}

/// A 3 by 3 matrix, stored row by row.
struct Rows {
    std::array<glm::dvec3, 3> row{};

    [[nodiscard]] glm::dvec3 operator*(const glm::dvec3& v) const {
        return {glm::dot(row[0], v), glm::dot(row[1], v), glm::dot(row[2], v)};
    }
    [[nodiscard]] glm::dvec3 transposed_times(const glm::dvec3& v) const {
        return v.x * row[0] + v.y * row[1] + v.z * row[2];
    }
};

[[nodiscard]] inline Rows rows_of(const Symmetric& a) {
    return {
        {glm::dvec3(a.xx, a.xy, a.xz), glm::dvec3(a.xy, a.yy, a.yz), glm::dvec3(a.xz, a.yz, a.zz)}};
}
/// The matrix that takes w to v x w.
[[nodiscard]] inline Rows cross_rows(const glm::dvec3& v) {
    return {{glm::dvec3(0.0, -v.z, v.y), glm::dvec3(v.z, 0.0, -v.x), glm::dvec3(-v.y, v.x, 0.0)}};
}
/// The product a b.
[[nodiscard]] inline Rows product(const Symmetric& a, const Rows& b) {
    return {{a.xx * b.row[0] + a.xy * b.row[1] + a.xz * b.row[2],
             a.xy * b.row[0] + a.yy * b.row[1] + a.yz * b.row[2],
             a.xz * b.row[0] + a.yz * b.row[1] + a.zz * b.row[2]}};
}
/// The product a^T b.
[[nodiscard]] inline Rows transposed_product(const Rows& a, const Rows& b) {
    Rows out;
    for (int i = 0; i < 3; ++i) {
        out.row[static_cast<std::size_t>(i)] =
            a.row[0][i] * b.row[0] + a.row[1][i] * b.row[1] + a.row[2][i] * b.row[2];
    }
    return out;
}
/// The symmetric part of a^T b.
[[nodiscard]] inline Symmetric symmetric_product(const Rows& a, const Rows& b) {
    Symmetric out;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& u = a.row[i];
        const glm::dvec3& v = b.row[i];
        out += {u.x * v.x,
                u.y * v.y,
                u.z * v.z,
                0.5 * (u.x * v.y + u.y * v.x),
                0.5 * (u.x * v.z + u.z * v.x),
                0.5 * (u.y * v.z + u.z * v.y)};
    }
    return out;
}

} // namespace lsys
