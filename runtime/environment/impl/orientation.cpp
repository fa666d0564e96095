// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/orientation.h"

#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

/// An exact sum as numbers that do not overlap, ascending by magnitude, none of them 0.
class ExactSum {
public:
    /// Shewchuk 1997, figure 6 (GROW-EXPANSION), without zeros.
    void add(double number) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double sum = number + parts_[i];
            const double other = sum - number;
            const double error = (number - (sum - other)) + (parts_[i] - other);
            if (error != 0.0) {
                parts_[kept++] = error;
            }
            number = sum;
        }
        if (number != 0.0) {
            parts_[kept++] = number;
        }
        count_ = kept;
    }

    /// Adds a * b.
    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }

    /// Adds a * b * c.
    void add_product(double a, double b, double c) {
        const double product = a * b;
        add_product(std::fma(a, b, -product), c);
        add_product(product, c);
    }

    [[nodiscard]] int sign() const {
        if (count_ == 0) {
            return 0;
        }
        return parts_[count_ - 1] > 0.0 ? 1 : -1;
    }

private:
    // The determinant of three dimensions is a sum of 6 * 8 products, each a sum of 4 numbers.
    std::array<double, 192> parts_{};
    std::size_t count_ = 0;
};

/// A difference as two numbers whose sum is exact.
struct ExactDifference {
    ExactDifference(double a, double b) {
        const double difference = a - b;
        const double other = a - difference;
        const double error = (a - (difference + other)) + (other - b);
        parts = {error, difference};
    }

    std::array<double, 2> parts{};
};

void add_products(ExactSum& sum,
                  const ExactDifference& a,
                  const ExactDifference& b,
                  double factor) {
    for (const double x : a.parts) {
        for (const double y : b.parts) {
            sum.add_product(factor * x, y);
        }
    }
}

void add_products(ExactSum& sum,
                  const ExactDifference& a,
                  const ExactDifference& b,
                  const ExactDifference& c,
                  double factor) {
    for (const double x : a.parts) {
        for (const double y : b.parts) {
            for (const double z : c.parts) {
                sum.add_product(factor * x, y, z);
            }
        }
    }
}

int exact_orientation(const Vector2& a, const Vector2& b, const Vector2& p) {
    ExactSum sum;
    add_products(sum, ExactDifference(a[0], p[0]), ExactDifference(b[1], p[1]), 1.0);
    add_products(sum, ExactDifference(a[1], p[1]), ExactDifference(b[0], p[0]), -1.0);
    return sum.sign();
}

int exact_orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
    const std::array<const Vector3*, 3> rows{&a, &b, &c};
    const auto entry = [&](std::size_t row, std::size_t column) {
        return ExactDifference((*rows[row])[column], p[column]);
    };
    ExactSum sum;
    for (std::size_t first = 0; first < 3; ++first) {
        const std::size_t second = (first + 1) % 3;
        const std::size_t third = (first + 2) % 3;
        add_products(sum, entry(0, first), entry(1, second), entry(2, third), 1.0);
        add_products(sum, entry(0, first), entry(1, third), entry(2, second), -1.0);
    }
    return sum.sign();
}

constexpr double kHalfUnit = 0x1p-53; // relative error of one operation

} // namespace

int orientation(const Vector2& a, const Vector2& b, const Vector2& p) {
    constexpr double kBound = (3.0 + 16.0 * kHalfUnit) * kHalfUnit; // Shewchuk 1997, section 4.2
    const double left = (a[0] - p[0]) * (b[1] - p[1]);
    const double right = (a[1] - p[1]) * (b[0] - p[0]);
    const double determinant = left - right;
    const double error = kBound * (std::abs(left) + std::abs(right));
    if (determinant > error || -determinant > error) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exact_orientation(a, b, p);
}

int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
    constexpr double kBound = (7.0 + 56.0 * kHalfUnit) * kHalfUnit; // Shewchuk 1997, section 4.3
    const Vector3 u{a[0] - p[0], a[1] - p[1], a[2] - p[2]};
    const Vector3 v{b[0] - p[0], b[1] - p[1], b[2] - p[2]};
    const Vector3 w{c[0] - p[0], c[1] - p[1], c[2] - p[2]};
    double determinant = 0.0;
    double magnitude = 0.0;
    for (std::size_t row = 0; row < 3; ++row) { // expands by the last column
        const Vector3& first = row == 0 ? v : row == 1 ? w : u;
        const Vector3& second = row == 0 ? w : row == 1 ? u : v;
        const double last = row == 0 ? u[2] : row == 1 ? v[2] : w[2];
        const double left = first[0] * second[1];
        const double right = first[1] * second[0];
        determinant += last * (left - right);
        magnitude += std::abs(last) * (std::abs(left) + std::abs(right));
    }
    const double error = kBound * magnitude;
    if (determinant > error || -determinant > error) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exact_orientation(a, b, c, p);
}

} // namespace lsys
