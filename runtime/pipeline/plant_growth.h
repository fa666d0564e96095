// PlantGrowth: a plant over its generations, in steps as small as wanted. Derives once, forwards,
// and keeps the drawings of two generations.
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
    /// Starts with the axiom. `grammar`, whose bytecode is folded, outlives the growth. Options:
    /// `generations` is the last one; `stream` and `origins` are ignored. Fails as grow_plant()
    /// does.
    [[nodiscard]] static Outcome<PlantGrowth>
    begin(const PlantOptions& options, Grammar& grammar, const Project& project);
    ~PlantGrowth();
    PlantGrowth(PlantGrowth&&) noexcept;
    PlantGrowth& operator=(PlantGrowth&&) noexcept;

    [[nodiscard]] std::uint32_t last_generation() const;
    /// Derives up to the moment, which is not after the last generation, and writes the plant there
    /// to `out`. Whole generations are exactly those of grow_plant(), if no production reads their
    /// number. A moment before the one asked for last starts again at the axiom. Messages: those of
    /// the drawing of the last generation; a note where polygons lose corners at once.
    [[nodiscard]] Outcome<void>
    pose(const GrowthMoment& moment, const Project& project, Skeleton& out);
    /// The plant without its skeleton: meshes, seed, and what was derived last.
    [[nodiscard]] const Plant& plant() const;

private:
    struct State;
    explicit PlantGrowth(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace lsys
