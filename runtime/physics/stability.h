// Stability: whether a plant bears its own weight, and the stiffness or width with which it would.
// For reports and warnings; the simulation does not use it.
#pragma once

#include "runtime/physics/physics.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Min height under its weight, relative to the height at rest, with which a plant counts as
/// standing.
inline constexpr double kStandingHeight = 0.7;

struct Stability {
    /// Multiple of its weight at which the plant buckles from its pose at rest: the smallest
    /// generalised eigenvalue of the stiffness of joints and of weight. Infinite without weight, or
    /// if the whole plant hangs; below 1 the plant does not stand.
    double load_factor = 0.0;
    /// Multiple of its weight at which the trunk alone buckles, as a column of constant width:
    /// 7.837 E I / (w l^3) with mean E I and weight per length w (Greenhill 1881). None for a trunk
    /// without weight or length, or with LoadRule::Own, where no joint carries the trunk above it.
    std::optional<double> trunk_factor;
    double trunk_length = 0.0; // m
    double trunk_width = 0.0;  // m, mean diameter
};
/// Measures the skeleton; the trunk is that of the first plant. A further segment without a parent
/// begins another plant. Linear time.
[[nodiscard]] Stability stability_of(const Skeleton& rest, const PhysicsOptions& options);

/// Height of the highest point above the first segment's base under weight and wind, relative to
/// that at rest; 1 for a plant without height. Settles in at most `max_rounds` rounds.
[[nodiscard]] double
bent_height(const Skeleton& rest, const PhysicsOptions& options, std::uint32_t max_rounds);

enum class Stiffening : std::uint8_t {
    Springs, // springs times the factor
    Widths   // radii times the factor, springs times its 4th power, masses times its square
};
[[nodiscard]] Skeleton stiffened(const Skeleton& rest, Stiffening way, double factor);
/// The smallest factor, within 20 %, with which the plant stands (kStandingHeight); 1 if it already
/// stands. nullopt: the plant falls with all factors up to 1e9 (springs) or 1e3 (widths). Each
/// trial settles a plant.
[[nodiscard]] std::optional<double>
standing_factor(const Skeleton& rest, const PhysicsOptions& options, Stiffening way);

/// Whether the spring of each segment follows from its width, length and `elasticity`.
[[nodiscard]] bool has_automatic_springs(const Skeleton& rest, double elasticity);

} // namespace lsys
