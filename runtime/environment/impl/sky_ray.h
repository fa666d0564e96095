// SPDX-License-Identifier: MIT
// A ray from a place to the sky, from cell to cell (Amanatides & Woo 1987). The ray crosses plane n
// of an axis at the distance (n cell - place) / direction. Each distance is computed from n alone,
// so that errors do not add up along the ray, and skipping empty cells changes no bit of the
// result.
#pragma once

#include "runtime/environment/impl/leaf_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lsys {

class SkyRay {
public:
    /// `own` is the cell of `place`; `direction` is a unit vector that points upwards; `cell` is
    /// the edge of a cell, m.
    SkyRay(const Vector3& place, const CellIndex& own, const Vector3& direction, double cell)
        : place_(place), direction_(direction), size_(cell), at_(own) {}

    /// Opacity times path, summed along the ray.
    [[nodiscard]] double depth(const LeafAreaGrid& grid, const CellBox& box) {
        if (!enter(box)) {
            return 0.0;
        }
        std::array<double, 3> exits{};
        std::array<double, 3> planes{}; // per axis: index of the next plane
        std::array<double, 3> steps{};
        std::array<std::int64_t, 3> left{}; // per axis: cells to the end of the box
        std::array<std::ptrdiff_t, 3> strides{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_forward = direction_[axis] > 0.0;
            exits[axis] = exit_of(axis, 0, box);
            planes[axis] = static_cast<double>(is_forward ? at_[axis] + 1 : at_[axis]);
            steps[axis] = is_forward ? 1.0 : -1.0;
            left[axis] = is_forward ? box.high[axis] - at_[axis] : at_[axis] - box.low[axis];
            const auto stride = static_cast<std::ptrdiff_t>(grid.stride(axis));
            strides[axis] = is_forward ? stride : -stride;
        }
        auto index = static_cast<std::ptrdiff_t>(grid.index_of(at_));
        double sum = 0.0;
        for (;;) {
            const std::size_t axis = nearest(exits);
            const double exit = std::max(passed_, exits[axis]);
            sum += grid.opacity(static_cast<std::size_t>(index)) * (exit - passed_);
            passed_ = exit;
            if (--left[axis] < 0) {
                return sum;
            }
            planes[axis] += steps[axis];
            exits[axis] = (planes[axis] * size_ - place_[axis]) / direction_[axis];
            index += strides[axis];
        }
    }
    /// depth() with a table; skips empty blocks.
    [[nodiscard]] double depth(const LeafAreaTable& table, const CellBox& box) {
        if (!enter(box)) {
            return 0.0;
        }
        std::array<double, 3> exits{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            exits[axis] = exit_of(axis, 0, box);
        }
        double sum = 0.0;
        for (;;) {
            const CellContent content = table.at(at_);
            if (content.empty_bits > 0) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    exits[axis] = exit_of(axis, content.empty_bits, box);
                }
                pass_until(std::min({exits[0], exits[1], exits[2]}));
                if (!is_in(box)) {
                    return sum;
                }
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    exits[axis] = exit_of(axis, 0, box);
                }
                continue;
            }
            const std::size_t axis = nearest(exits);
            const double exit = std::max(passed_, exits[axis]);
            sum += content.opacity * (exit - passed_);
            passed_ = exit;
            at_[axis] += direction_[axis] > 0.0 ? 1 : -1;
            if (at_[axis] < box.low[axis] || at_[axis] > box.high[axis]) {
                return sum;
            }
            exits[axis] = exit_of(axis, 0, box);
        }
    }

private:
    /// The axis with the smallest of the distances.
    [[nodiscard]] static std::size_t nearest(const std::array<double, 3>& exits) {
        return exits[0] <= exits[1] ? (exits[0] <= exits[2] ? 0 : 2)
                                    : (exits[1] <= exits[2] ? 1 : 2);
    }
    /// Metres along the ray to plane `plane` of an axis.
    [[nodiscard]] double crossing(std::size_t axis, std::int64_t plane) const {
        if (direction_[axis] == 0.0) {
            return std::numeric_limits<double>::infinity();
        }
        return (static_cast<double>(plane) * size_ - place_[axis]) / direction_[axis];
    }
    /// Distance in m to the end, along an axis, of the block of 2^bits cells that contains the
    /// current cell.
    [[nodiscard]] double exit_of(std::size_t axis, std::uint32_t bits, const CellBox& box) const {
        const std::int64_t first = box.low[axis] + (((at_[axis] - box.low[axis]) >> bits) << bits);
        return crossing(axis, direction_[axis] > 0.0 ? first + (std::int64_t{1} << bits) : first);
    }
    [[nodiscard]] bool is_in(const CellBox& box) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at_[axis] < box.low[axis] || at_[axis] > box.high[axis]) {
                return false;
            }
        }
        return true;
    }
    /// Moves to the first cell in the box; false if the ray misses the box.
    [[nodiscard]] bool enter(const CellBox& box) {
        double start = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at_[axis] < box.low[axis]) {
                if (!(direction_[axis] > 0.0)) {
                    return false;
                }
                start = std::max(start, crossing(axis, box.low[axis]));
            } else if (at_[axis] > box.high[axis]) {
                if (!(direction_[axis] < 0.0)) {
                    return false;
                }
                start = std::max(start, crossing(axis, box.high[axis] + 1));
            }
        }
        if (!is_in(box)) {
            pass_until(start);
        }
        return is_in(box);
    }
    /// Moves to the cell that the ray is in at `distance` m.
    void pass_until(double distance) {
        passed_ = std::max(passed_, distance);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (direction_[axis] != 0.0) {
                at_[axis] = cell_at(axis, distance);
            }
        }
    }
    /// Index along `axis` of the cell that the ray has reached at `distance`.
    [[nodiscard]] std::int64_t cell_at(std::size_t axis, double distance) const {
        const std::int64_t step = direction_[axis] > 0.0 ? 1 : -1;
        // Number of the plane through which the ray enters a cell, minus the index of the cell.
        const std::int64_t entry = direction_[axis] > 0.0 ? 0 : 1;
        const double estimate = std::floor((place_[axis] + distance * direction_[axis]) / size_);
        const double limit = 4.0 * kMaxCellIndex;
        auto cell = static_cast<std::int64_t>(std::clamp(estimate, -limit, limit));
        if ((cell - at_[axis]) * step < 0) {
            cell = at_[axis];
        }
        while (cell != at_[axis] && crossing(axis, cell + entry) > distance) {
            cell -= step;
        }
        while (crossing(axis, cell + step + entry) <= distance) {
            cell += step;
        }
        return cell;
    }

    Vector3 place_;
    Vector3 direction_;
    double size_;         // edge of a cell, m
    CellIndex at_;        // the cell that the ray is in
    double passed_ = 0.0; // m, distance from the place to the point that the ray has reached
};

} // namespace lsys
