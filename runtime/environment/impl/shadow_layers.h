// SPDX-License-Identifier: MIT
// The pyramid of shadow below a place (Palubicki et al. 2009, section 4), and the sums over its
// layers at one voxel. All counts are integers, so that the order in which they are added does not
// matter.
#pragma once

#include "runtime/environment/environment.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// Number of places whose pyramid covers a voxel with a given layer, and differences of this number
/// between the voxel's 26 neighbours.
struct LayerCounts {
    std::int64_t own = 0; // count of the voxel itself
    /// [axis][squared distance - 1]: sum of the counts of the neighbours at +1 along the axis minus
    /// sum of those at -1.
    std::array<std::array<std::int64_t, 3>, 3> differences{};
};

/// Sums over the layers from 0 on.
struct ShadowSum {
    double shade = 0.0;    // s: shadow at the voxel
    Vector3 differences{}; // differences along x, y, z, not yet times the strength
};

class ShadowLayers {
public:
    explicit ShadowLayers(const BytecodeEnvironment& declared)
        : strength_(static_cast<double>(declared.strength)) {
        double power = 1.0; // ratio^-layer
        for (std::uint32_t layer = 0; layer <= declared.levels; ++layer) {
            powers_.push_back(power);
            // Avoid NaN, the product of an infinite power and a strength of 0.
            weights_.push_back(strength_ == 0.0 ? 0.0 : strength_ * power);
            power /= static_cast<double>(declared.ratio);
        }
        for (std::int64_t count = -kFew; count <= kFew; ++count) {
            const auto index = static_cast<std::size_t>(count + kFew);
            over_root_of_2_[index] = static_cast<double>(count) / std::sqrt(2.0);
            over_root_of_3_[index] = static_cast<double>(count) / std::sqrt(3.0);
        }
    }

    /// The lowest layer of a pyramid; layer 0 is the voxel of the place itself.
    [[nodiscard]] std::int64_t last() const {
        return static_cast<std::int64_t>(powers_.size()) - 1;
    }

    /// Layers must be added in ascending order.
    void add(ShadowSum& sum, std::int64_t layer, const LayerCounts& counts) const {
        const auto index = static_cast<std::size_t>(layer);
        if (counts.own != 0) {
            sum.shade += weights_[index] * static_cast<double>(counts.own);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& [first, second, third] = counts.differences[axis];
            if ((first | second | third) != 0) {
                sum.differences[axis] +=
                    powers_[index] * (static_cast<double>(first) +
                                      quotient(second, over_root_of_2_, std::sqrt(2.0)) +
                                      quotient(third, over_root_of_3_, std::sqrt(3.0)));
            }
        }
    }

    /// Exposure, and the unit vector towards more light or 0 0 0.
    [[nodiscard]] std::array<double, 4> answer(const ShadowSum& sum) const {
        const double exposure = 1.0 - sum.shade + strength_;
        Vector3 away{};
        double largest = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            away[axis] = -strength_ * sum.differences[axis];
            largest = greater(largest, std::abs(away[axis]));
        }
        if (largest == 0.0) {
            return {greater(0.0, exposure), 0.0, 0.0, 0.0};
        }
        // A power of two changes no bits, and keeps the squares away from underflow and overflow.
        const double scale = inverse_power_of_two(largest);
        for (double& component : away) {
            component *= scale;
        }
        const double length = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
        return {greater(0.0, exposure), away[0] / length, away[1] / length, away[2] / length};
    }

private:
    /// Quotients of counts up to this are stored: divisions took half of the time of an answer.
    static constexpr std::int64_t kFew = 64;
    using Quotients = std::array<double, 2 * kFew + 1>;

    /// count / divisor, rounded; `few` are the quotients of the counts from -kFew to kFew.
    [[nodiscard]] static double quotient(std::int64_t count, const Quotients& few, double divisor) {
        return count >= -kFew && count <= kFew ? few[static_cast<std::size_t>(count + kFew)]
                                               : static_cast<double>(count) / divisor;
    }
    /// The greater of two numbers; `a` if `b` is NaN.
    [[nodiscard]] static double greater(double a, double b) { return b > a ? b : a; }
    /// 2^-e for a number in [2^e, 2^(e + 1)), with e clamped to -1022 ... 1022. Numbers up to this
    /// one, times 2^-e, have squares in the range of binary64, unless this number is infinite.
    [[nodiscard]] static double inverse_power_of_two(double number) {
        constexpr std::uint64_t kMaxField = 2045; // the biased exponent of 2^1022
        const std::uint64_t field = std::bit_cast<std::uint64_t>(number) >> 52;
        return std::bit_cast<double>(
            (kMaxField + 1 - std::clamp<std::uint64_t>(field, 1, kMaxField)) << 52);
    }

    double strength_;
    Quotients over_root_of_2_{};
    Quotients over_root_of_3_{};
    std::vector<double> powers_;  // ratio^-layer
    std::vector<double> weights_; // strength ratio^-layer
};

} // namespace lsys
