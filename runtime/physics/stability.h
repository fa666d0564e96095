// SPDX-License-Identifier: MIT
// Stability: whether a plant bears its own weight, and the stiffness or width with which it does.
// For reports and warnings; the simulation does not use it.
#pragma once

#include "runtime/physics/physics.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Min ratio of the height of a plant under its weight to its height at rest with which it counts
/// as standing.
inline constexpr double kStandingHeight = 0.7;

struct Stability {
    /// Multiple of its weight at which the plant buckles from its pose at rest: the smallest
    /// generalised eigenvalue of the stiffness matrices of joints and weight. Infinite without
    /// weight, or if the whole plant hangs; below 1 the plant does not stand.
    double load_factor = 0.0;
    /// Multiple of its weight at which the trunk alone buckles, as a column of constant width:
    /// 7.837 E I / (w l^3), with the means of E I and of the weight w per length (Greenhill 1881).
    /// None for a trunk without weight or length, and with LoadRule::Own, because then no joint
    /// bears the trunk above it.
    std::optional<double> trunk_factor;
    double trunk_length = 0.0; // m
    double trunk_width = 0.0;  // m, mean diameter
};
/// Measures the skeleton. Values of the trunk are those of the first plant; each further segment
/// without a parent begins another plant. Linear time.
[[nodiscard]] Stability stability_of(const Skeleton& rest, const PhysicsOptions& options);

/// Ratio of two heights of the highest point above the base of the first segment: under weight and
/// wind, and at rest. 1 for a plant without height. Settles in at most `max_rounds` rounds.
[[nodiscard]] double
bent_height(const Skeleton& rest, const PhysicsOptions& options, std::uint32_t max_rounds);

enum class Stiffening : std::uint8_t {
    Springs, // multiplies springs by the factor
    Widths   // multiplies radii by the factor, springs by its 4th power, masses by its square
};
/// The skeleton with its springs or widths changed by a factor, see Stiffening.
[[nodiscard]] Skeleton stiffened(const Skeleton& rest, Stiffening way, double factor);
/// The smallest factor, to within 20 %, with which the plant stands (kStandingHeight); 1 if it
/// already stands. nullopt: the plant falls with all factors up to 1e9 (springs) or 1e3 (widths).
/// For each factor that is tried, a plant is settled.
[[nodiscard]] std::optional<double>
standing_factor(const Skeleton& rest, const PhysicsOptions& options, Stiffening way);

/// Whether each segment has the spring constant computed from its width, length and `elasticity`.
[[nodiscard]] bool has_automatic_springs(const Skeleton& rest, double elasticity);

} // namespace lsys
