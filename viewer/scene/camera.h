// SPDX-License-Identifier: MIT
// Camera: viewpoint of a picture. Metres, right-handed, +Y up. Converts to one line of text and
// back without loss.
#pragma once

#include "grammar/base/result.h"
#include "runtime/turtle/skeleton.h"

#include <glm/ext/vector_double3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys::view {

struct Camera {
    glm::vec3 eye{4.0F, 2.0F, 6.0F}; // relative to `origin`, like `target`
    glm::vec3 target{0.0F, 1.0F, 0.0F};
    float field_of_view = 40.0F; // degrees, vertical
    /// Place in the world, m, near the eye: 100 km away, steps of binary32 would be 8 mm wide.
    glm::dvec3 origin{};

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Side in m of the lattice of the origins of far cameras. Its points are sums of few powers of two,
/// and all cells of TerrainLod divide it.
inline constexpr double kOriginStep = 4096.0;
/// The lattice point nearest to a place of the world, at altitude 0.
[[nodiscard]] glm::dvec3 nearest_origin(const glm::dvec3& place);
/// Place of the eye in the world, m.
[[nodiscard]] glm::dvec3 eye_of(const Camera& camera);
/// Moves the origin of a camera; its places in the world stay.
[[nodiscard]] Camera relative_to(const Camera& camera, const glm::dvec3& origin);

/// `eye X,Y,Z target X,Y,Z fov DEGREES` with places in the world; parse_camera() reads back a camera
/// with the same places and field of view.
[[nodiscard]] std::string to_text(const Camera& camera);
/// Reads parts in any order; missing ones are taken from `otherwise`. An eye more than 16 km from
/// the origin of the world gets its nearest_origin(), any other one the origin of the world. Error:
/// unknown text, eye equal to target, a field of view outside 1 to 170 degrees.
[[nodiscard]] Result<Camera> parse_camera(std::string_view text, const Camera& otherwise);
/// `first` with the parts of `text` in place of its own; unchanged if parse_camera() fails.
[[nodiscard]] Camera with_parts(std::string_view text, const Camera& first);

/// The camera at `part` of the way from `first` (0) to `last` (1): eye, target and field of view on
/// straight lines.
[[nodiscard]] Camera between(const Camera& first, const Camera& last, double part);

/// Rotates the eye around the target by angles in radians; stops short of the poles.
[[nodiscard]] Camera orbited(const Camera& camera, float around, float upwards);
/// Scales the distance of the eye from the target.
[[nodiscard]] Camera zoomed(const Camera& camera, float factor);
/// Moves eye and target by metres to the right, up in the picture and along the view.
[[nodiscard]] Camera moved(const Camera& camera, float right, float up, float forward);
/// Rotates the target around the eye by angles in radians.
[[nodiscard]] Camera turned(const Camera& camera, float around, float upwards);
/// Keeps the direction of view and moves the eye so that a box fills a picture. `aspect`: width /
/// height.
[[nodiscard]] Camera framing(const Camera& camera, const Bounds& bounds, float aspect);

/// framing() of a box; from the front if the box is flat in Z.
[[nodiscard]] Camera first_view(const Camera& camera, const Bounds& bounds, float aspect);

enum class StandardView : std::uint8_t {
    Front, // from +Z
    Side,  // from +X
    Top,   // from +Y, with +X to the right
};
/// Keeps target and distance, and moves the eye to a standard view.
[[nodiscard]] Camera seen_from(StandardView view, const Camera& camera);

/// Unit vectors along the view and to the right.
[[nodiscard]] glm::vec3 forward_of(const Camera& camera);
[[nodiscard]] glm::vec3 right_of(const Camera& camera);

/// Direction to a point of the picture. `right` and `up`: from the centre, in half picture heights.
/// Its component along the view is 1.
[[nodiscard]] glm::vec3 direction_at(const Camera& camera, float right, float up);

[[nodiscard]] glm::mat4 view_matrix(const Camera& camera);
/// Projection with reversed depth: 1 at `near` (m), 0 at infinity.
[[nodiscard]] glm::mat4 projection_matrix(const Camera& camera, float aspect, float near);
/// Distance of the near plane, m.
[[nodiscard]] float near_distance(const Camera& camera);

} // namespace lsys::view
