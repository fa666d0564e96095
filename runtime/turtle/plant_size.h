// SPDX-License-Identifier: MIT
// Sizes of a drawn plant: the widths of the pipe model and a height in metres (docs/language.md
// section 7.5). Applied to a skeleton after the turtle, widths first, and before all steps that
// read metres: physics, meshing, placement.
#pragma once

#include "compiler/bytecode/settings.h"
#include "grammar/base/outcome.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Mass in kg: the volume of a truncated cone times `density` (kg/m^3), at most the largest
/// binary32. Lengths in m.
[[nodiscard]] float
mass_of_cone(double length, double base_radius, double tip_radius, double density);

/// Spring constant in N m/rad: E I / length of a beam of the mean diameter d, I = pi d^4 / 64. At
/// most the largest binary32, also for a beam without length, which is rigid. Lengths in m,
/// `elasticity` E in Pa.
[[nodiscard]] float
spring_of_beam(double length, double base_radius, double tip_radius, double elasticity);

/// The material from which mass and spring of a segment are computed unless the author gives them.
struct StemMaterial {
    double density = 0.0;    // kg/m^3
    double elasticity = 0.0; // Pa
};
/// The material that `settings` have set.
[[nodiscard]] StemMaterial material_of(const Settings& settings);

/// count^(1 / exponent) in binary64: the factor between the width of a tip and that of a segment
/// with `count` tips above it. Uses only operations that IEEE 754 rounds correctly, so it has the
/// same bits on every machine; the relative error is below 1e-13. Preconditions: count >= 1,
/// exponent >= 1.
[[nodiscard]] double pipe_factor(std::uint32_t count, double exponent);

/// Gives every segment the width pipe.tip_width * tips^(1 / pipe.exponent), rounded to binary32
/// once; `tips` is the number of its descendants without children, or 1 if it has no children. With
/// taper, the width at the tip of a segment approaches the width of the child that continues the
/// segment, by the fraction pipe.taper of the difference. This child is the one on the same axis;
/// if there is none, the child with most tips, and among equals the first. A segment without
/// children does not taper. Masses and springs that follow from shape and `material` are computed
/// again. Returns Stop::Limit if the numbers of tips do not fit into `max_bytes` beside the
/// skeleton, or Stop::OutOfMemory; the skeleton is then unchanged.
[[nodiscard]] std::optional<Stop> apply_pipe(const Pipe& pipe,
                                             const StemMaterial& material,
                                             std::uint64_t max_bytes,
                                             Skeleton& skeleton);

/// Pixels along the longest side of a plant, and the min width of a branch in pixels: 2 / 500 or
/// 0.4 % of this side, so that the branch is seen at every size.
inline constexpr double kPicturePixels = 500.0;
inline constexpr double kMinPixels = 2.0;
/// Converts the widths of all segments from pixels to metres: a pixel is the longest side of
/// bounds_of() divided by kPicturePixels. Masses and springs follow as in apply_pipe().
void apply_pixels(const StemMaterial& material, Skeleton& skeleton);

/// The box of a plant: axes of segments, places of objects, corners of polygons; without radii.
[[nodiscard]] Bounds bounds_of(const Skeleton& skeleton);

/// Height of bounds_of() in m; 0 if nothing is drawn.
[[nodiscard]] double height_of(const Skeleton& skeleton);

/// Scales all lengths and widths by `factor`. Masses and springs that follow from shape and
/// `material` are computed again; those given by the author stay.
void scale_plant(double factor, const StemMaterial& material, Skeleton& skeleton);

/// Scales the plant evenly so that its box is `height` m high. Returns false, without a change, if
/// the box is flat: lower than a millionth of its longest side. An empty drawing stays empty.
[[nodiscard]] bool scale_to_height(double height, const StemMaterial& material, Skeleton& skeleton);

} // namespace lsys
