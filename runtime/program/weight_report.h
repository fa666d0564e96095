// SPDX-License-Identifier: MIT
// Reports on a plant under its weight: the table of `lsc stats --gravity`, and the warning of `lsc`
// and `lsview` that a plant falls, with the widths or the stiffness with which it would stand.
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

/// A plant under its weight. For a plant that falls, also values with which it would stand, rounded
/// up to two significant digits; unset if none was found.
struct WeightReport {
    double gravity = 0.0; // m/s^2
    Stability stability;
    double height_left = 1.0;           // height of the bent plant / height of the unbent plant
    std::optional<double> width_factor; // for all widths; only if all springs depend on them
    std::optional<double> elasticity;   // Pa; only if all springs are computed from it
    std::optional<double> spring;       // N m/rad; only if all joints have the same spring
    [[nodiscard]] bool stands() const { return height_left >= kStandingHeight; }
};

/// Settles the plant under the gravity of `options`. If the plant falls, searches for widths and
/// springs with which it stands.
[[nodiscard]] WeightReport
make_weight_report(const Skeleton& plant, const Settings& settings, const PhysicsOptions& options);

/// The report as text for people.
[[nodiscard]] std::string weight_text(const WeightReport& report);
/// The report as a JSON object with a line end.
[[nodiscard]] std::string weight_json(const WeightReport& report);

/// Max number of segments of a plant that make_fall_warning() checks, since each trial settles the
/// whole plant.
inline constexpr std::size_t kMaxFallWarningSegments = 20'000;
/// The warning of a plant that falls; empty if it stands.
[[nodiscard]] Diagnostics fall_warning(const WeightReport& report);
/// Checks the plant under the gravity of `options`, without wind, and returns its fall_warning().
/// Empty without gravity and for plants of more than kMaxFallWarningSegments segments.
[[nodiscard]] Diagnostics
make_fall_warning(const Skeleton& plant, const Settings& settings, PhysicsOptions options);
/// Prints the warning if the plant falls. Returns AuthorErrors if the warning counts as an error,
/// as with --deny warnings.
[[nodiscard]] ExitStatus
warn_of_fall(const WeightReport& report, const Grammar& grammar, const Console& console);

} // namespace lsys
