// SPDX-License-Identifier: MIT
// PlantGrowth: computes a plant at any moment between its generations. Derives forwards and stores
// the skeletons of two generations.
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
    /// `options.origins` are ignored. Fails like grow_plant().
    [[nodiscard]] static Outcome<PlantGrowth>
    begin(const PlantOptions& options, Grammar& grammar, const Project& project);
    ~PlantGrowth();
    PlantGrowth(PlantGrowth&&) noexcept;
    PlantGrowth& operator=(PlantGrowth&&) noexcept;

    [[nodiscard]] std::uint32_t last_generation() const;
    /// Derives up to `moment` and writes the plant of `moment` to `out`. At whole generations the
    /// plant equals the result of grow_plant(), unless a production calls steps(). A moment before
    /// the two stored generations restarts at the axiom. Messages: the messages of drawing the last
    /// generation; a note if polygons lose corners suddenly. Precondition: `moment` is not after
    /// the last generation.
    [[nodiscard]] Outcome<void>
    pose(const GrowthMoment& moment, const Project& project, Skeleton& out);
    /// The plant without its skeleton: meshes, seed, times, and counts of the last derived word.
    [[nodiscard]] const Plant& plant() const;
    /// The last sensed word, up to the last derived word; null if the grammar has no sense modules.
    [[nodiscard]] std::shared_ptr<const SensedPlant> sensed() const;

private:
    struct State;
    explicit PlantGrowth(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace lsys
