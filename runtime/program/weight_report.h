// Reports of a plant under its weight: a table for `lsc stats --gravity`, and the warning that it
// falls, with the widths or the stiffness that would hold it, of `lsc` and `lsview`.
#pragma once

#include "compiler/bytecode/settings.h"
#include "runtime/physics/stability.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"
#include "runtime/turtle/skeleton.h"

#include <cstddef>
#include <optional>
#include <string>

namespace lsys {

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

/// Largest plant that is weighed for a warning alone, segments: each trial settles it.
inline constexpr std::size_t kMaxWeighedSegments = 20'000;
/// The warning of a plant that falls; empty if it stands.
[[nodiscard]] Diagnostics fall_warning(const WeightReport& report);
/// fall_warning() of the plant under the gravity of `options` without their wind; empty for a plant
/// that is too large to be weighed, and without gravity.
[[nodiscard]] Diagnostics
weigh_for_warning(const Skeleton& plant, const Settings& settings, PhysicsOptions options);
/// Prints the warning of a plant that falls. Returns AuthorErrors with --deny warnings.
[[nodiscard]] ExitStatus
warn_of_fall(const WeightReport& report, const Grammar& grammar, const Console& console);

} // namespace lsys
