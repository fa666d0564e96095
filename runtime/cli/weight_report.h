// Reports of a plant under its weight: a table for `lsc stats --gravity`, and the warning that it
// falls, with the widths or the stiffness that would hold it.
#pragma once

#include "compiler/bytecode/settings.h"
#include "runtime/physics/stability.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"
#include "runtime/turtle/skeleton.h"

#include <optional>
#include <string>

namespace lsys::lsc {

/// A plant under its weight, and the values with which it stands: none where it does, or where
/// none was found. Rounded up to two digits.
struct WeightReport {
    double gravity = 0.0; // m/s^2
    Stability stability;
    double height_left = 1.0; // part of the height at rest
    std::optional<double> width_factor;
    std::optional<double> elasticity; // Pa, of springs that follow from it
    std::optional<double> spring;     // N m/rad, of a plant with one spring for all joints
    [[nodiscard]] bool stands() const { return height_left >= kStandingHeight; }
};

/// Settles the plant, and if it falls tries widths and springs; `options` has the gravity.
[[nodiscard]] WeightReport
weigh(const Skeleton& plant, const Settings& settings, const PhysicsOptions& options);

[[nodiscard]] std::string weight_text(const WeightReport& report);
/// One JSON object and a line end.
[[nodiscard]] std::string weight_json(const WeightReport& report);

/// Prints the warning of a plant that falls. Returns AuthorErrors with --deny warnings.
[[nodiscard]] ExitStatus
warn_of_fall(const WeightReport& report, const Grammar& grammar, const Console& console);

} // namespace lsys::lsc
