// PlantGrowth: a plant at any moment between its generations. Derives forwards and keeps the
// skeletons of two generations.
#pragma once

#include "runtime/pipeline/growth_moment.h"
#include "runtime/pipeline/plant.h"
#include "runtime/turtle/growth.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace lsys {

class PlantGrowth {
public:
    /// Starts with the axiom. Folds the bytecode of `grammar` (fold_modules()), which must outlive
    /// the growth. `options.generations` is the last generation; `options.stream` and
    /// `options.origins` are ignored. Fails as grow_plant() does.
    [[nodiscard]] static Outcome<PlantGrowth>
    begin(const PlantOptions& options, Grammar& grammar, const Project& project);
    ~PlantGrowth();
    PlantGrowth(PlantGrowth&&) noexcept;
    PlantGrowth& operator=(PlantGrowth&&) noexcept;

    [[nodiscard]] std::uint32_t last_generation() const;
    /// Derives up to `moment` and writes the plant of `moment` to `out`. At whole generations the
    /// plant is exactly that of grow_plant(), unless a production calls steps(). An earlier
    /// generation than before starts again at the axiom. Messages: those of drawing the last
    /// generation; a note if polygons lose corners suddenly. Precondition: `moment` is not after
    /// the last generation.
    [[nodiscard]] Outcome<void>
    pose(const GrowthMoment& moment, const Project& project, Skeleton& out);
    /// The plant without its skeleton: meshes, seed, times, and counts of the last derived word.
    [[nodiscard]] const Plant& plant() const;

private:
    struct State;
    explicit PlantGrowth(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace lsys
