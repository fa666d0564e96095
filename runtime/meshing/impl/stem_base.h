// SPDX-License-Identifier: MIT
// Shapes of tubes near the ground and at forks: the flare of stems with its buttress roots, and
// collars of branches (docs/language.md section 7.8). Lengths in metres, along the axis of a run.
#pragma once

#include "runtime/meshing/impl/bark_noise.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>

namespace lsys {

/// Min sides of a segment at level 0 for collars and shaped tips: thinner twigs have none.
inline constexpr std::uint32_t kMinShapedSides = 5;
/// Coarser levels of detail have flares only: no roots, collars or shaped tips.
inline constexpr std::uint32_t kMaxShapedLevel = 1;
/// Max number of rings that a flare or collar adds.
inline constexpr std::uint32_t kFlareParts = 6;
inline constexpr std::uint32_t kCollarParts = 2;

/// A run that is wider near its base: the radius r at arc length s becomes
/// r + (factor * r + radius) * (1 - t)^2, where t rises from 0 at `begin` to 1 at `end`.
struct BaseWidening {
    float begin = 0.0F;
    float end = 0.0F;        // 0: no widening
    float factor = 0.0F;     // of the radius r
    float radius = 0.0F;     // m
    std::uint32_t parts = 0; // number of edges of equal length between begin and end

    /// The widened radius at arc length `arc`. `own`: the radius r there.
    [[nodiscard]] float widened(float own, float arc) const {
        const float t = (arc - begin) / (end - begin);
        const float rest = 1.0F - (t < 0.0F ? 0.0F : t > 1.0F ? 1.0F : t);
        return own + (factor * own + radius) * (rest * rest);
    }
};

/// Whether a segment is the base of a stem at the ground: it has no parent, begins at y = 0 and
/// rises.
[[nodiscard]] bool stands_on_ground(const Segment& segment, const Flare& flare);
/// The flare as a BaseWidening. Precondition: flare.factor > 1.
[[nodiscard]] BaseWidening widening_of(const Flare& flare);

/// Buttress roots: ridges around a flare, as displacements relative to the radius of the flare. The
/// mean displacement around the axis is 0. Ridges differ in height, and fade out upwards like the
/// flare.
class Roots {
public:
    /// Precondition: the flare has roots.
    explicit Roots(const Flare& flare);

    /// Outward displacement of the surface, -0.25 to 0.55 in radii of the flare, at `turn` (0 to 1)
    /// around the axis and `arc` along it. The first ridge lies at turn 0.
    [[nodiscard]] NoiseSample at(float turn, double arc) const;
    /// Arc length at which the roots end.
    [[nodiscard]] double reach() const { return static_cast<double>(reach_); }

private:
    std::uint32_t count_; // number of roots
    float reach_;         // reach()
    float depth_;         // depth of the ridges at the ground, in radii
    float mean_;          // mean of all ridges around the axis
};

} // namespace lsys
