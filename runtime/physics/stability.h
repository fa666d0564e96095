// Stability: whether a plant bears its own weight, and the stiffness or width that would. For
// reports and warnings; the simulation needs none of it.
#pragma once

#include "runtime/physics/physics.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Height under its weight from which a plant stands, as a part of the height at rest.
inline constexpr double kStandingHeight = 0.7;

struct Stability {
    /// Multiple of its weight at which the plant buckles from its pose at rest: the smallest
    /// eigenvalue of the stiffness of its joints against that of the weight. Infinite without
    /// weight, or where all of it hangs; below 1 it does not stand.
    double load_factor = 0.0;
    /// The same for the trunk alone as one even column, 7.837 E I / (w l^3) with its mean E I and
    /// weight per length w (Greenhill 1881). None for a trunk without weight or length.
    std::optional<double> trunk_factor;
    double trunk_length = 0.0; // m
    double trunk_width = 0.0;  // m, mean diameter
};
/// Of the first plant in the skeleton: segments without a parent begin others. Linear time.
[[nodiscard]] Stability stability_of(const Skeleton& rest, const PhysicsOptions& options);

/// Height of the highest point above the first segment's base under weight and wind, as a part of
/// that at rest; 1 for a plant without height. Settles within `max_rounds` rounds.
[[nodiscard]] double
bent_height(const Skeleton& rest, const PhysicsOptions& options, std::uint32_t max_rounds);

enum class Stiffening : std::uint8_t {
    Springs, // springs times the factor
    Widths   // radii times the factor, springs times its 4th power, masses times its square
};
[[nodiscard]] Skeleton stiffened(const Skeleton& rest, Stiffening way, double factor);
/// The smallest factor found, within 20 %, with which the plant stands (kStandingHeight); 1 if it
/// does already. None if none up to 1e9 (springs) or 1e3 (widths) does. Each trial settles a
/// plant.
[[nodiscard]] std::optional<double>
standing_factor(const Skeleton& rest, const PhysicsOptions& options, Stiffening way);

/// Whether the spring of each segment is that of its width and length for `elasticity`.
[[nodiscard]] bool has_automatic_springs(const Skeleton& rest, double elasticity);

} // namespace lsys
