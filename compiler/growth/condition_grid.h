// SPDX-License-Identifier: MIT
// The parameter space of a module cut into cells in which no condition of a set changes its truth:
// evaluating the conditions at one point of each cell decides them everywhere. Exact for binary32,
// since cuts lie between neighbouring numbers. Conditions may compare a parameter, or a monotone
// expression of one (`2 * x - 1`, `floor(x)`), with a constant, compare two parameters, and combine
// comparisons; other conditions have no grid.
#pragma once

#include "compiler/growth/impl/known_values.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::analysis {

/// A condition; parameter i of its module is formal first_formal + i.
struct ConditionView {
    std::uint32_t first_instruction = 0;
    std::uint32_t first_formal = 0;
};

/// A cell of one parameter: the binary32 numbers from low to high, both included.
struct GridCell {
    float low = 0.0F;
    float high = 0.0F;
};

/// A value of one parameter that stands for its cell.
struct GridSample {
    float value = 0.0F;
    std::uint32_t cell = 0; // index in GridAxis::cells
};

/// A parameter that the conditions depend on.
struct GridAxis {
    std::uint32_t parameter = 0;     // index of the parameter in its module
    bool compared = false;           // a condition compares it with another parameter
    std::vector<GridCell> cells;     // ascending, without gaps
    std::vector<GridSample> samples; // ascending; one per cell, up to three if compared
};

/// The cells of all parameters. A point combines one sample of each axis; points are numbered with
/// the last axis varying fastest.
struct ConditionGrid {
    std::vector<GridAxis> axes;

    [[nodiscard]] std::uint64_t point_count() const;
    /// Sets the parameters that have an axis to their values at a point.
    void set_parameters(std::uint64_t point, std::span<KnownValue> parameters) const;
    /// The index of the sample of axis `axis` at a point.
    [[nodiscard]] std::size_t sample_of(std::uint64_t point, std::size_t axis) const;
};

/// The grid of conditions over the unknown values of `parameters`. Returns nothing if a condition
/// has no grid, or the grid has more than `max_points` points.
[[nodiscard]] std::optional<ConditionGrid>
make_condition_grid(std::span<const std::uint32_t> instructions,
                    std::span<const ConditionView> conditions,
                    std::span<const KnownValue> parameters,
                    const ExpressionInputs& inputs,
                    std::uint64_t max_points);

/// The index of a finite binary32 among all in ascending order; 0 and -0 have index 0. number_at()
/// is the inverse.
[[nodiscard]] std::int32_t order_index(float value);
[[nodiscard]] float number_at(std::int32_t index);

} // namespace lsys::analysis
