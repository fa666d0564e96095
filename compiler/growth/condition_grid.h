// The values of a module's parameters cut into cells in each of which every condition of a set
// keeps its truth, so that evaluating the conditions at one value of each cell decides them for all
// values. Exact on binary32: cuts lie between neighbouring numbers. It understands comparisons of
// one parameter (or a monotone expression of one: `2 * x - 1`, `floor(x)`) with constants,
// comparisons of two parameters, and every combination of these; other conditions have no grid.
#pragma once

#include "compiler/growth/impl/known_values.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::analysis {

/// A condition and the formals of the module it is about: parameter i is formal first_formal + i.
struct ConditionView {
    std::uint32_t first_instruction = 0;
    std::uint32_t first_formal = 0;
};

/// All binary32 numbers from low to high.
struct GridCell {
    float low = 0.0F;
    float high = 0.0F;
};

struct GridSample {
    float value = 0.0F;
    std::uint32_t cell = 0;
};

/// One parameter that the conditions depend on.
struct GridAxis {
    std::uint32_t parameter = 0;
    bool compared = false;       // with another parameter
    std::vector<GridCell> cells; // ascending, without gaps
    std::vector<GridSample>
        samples; // ascending; one a cell, up to three where parameters are compared
};

/// A point takes one sample of each axis; the last axis varies fastest.
struct ConditionGrid {
    std::vector<GridAxis> axes;

    [[nodiscard]] std::uint64_t point_count() const;
    /// Writes the values of a point over `parameters`.
    void place(std::uint64_t point, std::span<KnownValue> parameters) const;
    /// The number of the sample that `point` takes of axis `axis`.
    [[nodiscard]] std::size_t sample_of(std::uint64_t point, std::size_t axis) const;
};

/// The grid of some conditions over the parameters that are not known in `parameters`. Nothing if a
/// condition has another form or there would be more than `max_points` points.
[[nodiscard]] std::optional<ConditionGrid>
make_condition_grid(std::span<const std::uint32_t> instructions,
                    std::span<const ConditionView> conditions,
                    std::span<const KnownValue> parameters,
                    const Surroundings& surroundings,
                    std::uint64_t max_points);

/// Binary32 numbers in order: neighbouring finite numbers have neighbouring indices, 0 has 0.
[[nodiscard]] std::int32_t order_index(float value);
[[nodiscard]] float number_at(std::int32_t index);

} // namespace lsys::analysis
