// SPDX-License-Identifier: MIT
// Camera: viewpoint of a picture. Metres, right-handed, +Y up. Can be written as one line of text
// and read back without loss.
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
    /// Place in the world near the eye, in m. Without it, places 100 km away would be rounded to
    /// steps of 8 mm in binary32.
    glm::dvec3 origin{};

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Side in m of the lattice on which the origins of far cameras lie: a multiple of the side of
/// every cell of TerrainLod. Coordinates of lattice points are sums of few powers of two.
inline constexpr double kOriginStep = 4096.0;
/// The lattice point nearest to a place of the world, at altitude 0.
[[nodiscard]] glm::dvec3 nearest_origin(const glm::dvec3& place);
/// Place of the eye in the world, m.
[[nodiscard]] glm::dvec3 eye_of(const Camera& camera);
/// Changes the origin of a camera; its eye and target stay at their places in the world.
[[nodiscard]] Camera relative_to(const Camera& camera, const glm::dvec3& origin);

/// The text `eye X,Y,Z target X,Y,Z fov DEGREES` with places in the world. parse_camera() reads it
/// as a camera with the same places and field of view.
[[nodiscard]] std::string to_text(const Camera& camera);
/// Reads the parts of a camera in any order; parts that are missing are taken from `otherwise`. A
/// camera whose eye is more than 16 km from the origin of the world has nearest_origin() as its
/// origin, any other camera the origin of the world. Error: unknown text, an eye equal to the
/// target, or a field of view outside of 1 to 170 degrees.
[[nodiscard]] Result<Camera> parse_camera(std::string_view text, const Camera& otherwise);
/// `first` with those parts replaced that `text` has; `first` itself if parse_camera() fails.
[[nodiscard]] Camera with_parts(std::string_view text, const Camera& first);

/// The camera at `part` of the way from `first` (0) to `last` (1). Eye, target and field of view
/// change linearly.
[[nodiscard]] Camera between(const Camera& first, const Camera& last, double part);

/// Rotates the eye around the target by angles in radians, but not over the poles.
[[nodiscard]] Camera orbited(const Camera& camera, float around, float upwards);
/// Multiplies the distance of the eye from the target by `factor`.
[[nodiscard]] Camera zoomed(const Camera& camera, float factor);
/// Moves eye and target by distances in m to the right, up in the picture, and forward along the
/// view.
[[nodiscard]] Camera moved(const Camera& camera, float right, float up, float forward);
/// Rotates the target around the eye by angles in radians.
[[nodiscard]] Camera turned(const Camera& camera, float around, float upwards);
/// Moves the eye, without changing the direction of view, so that a box fills the picture.
/// `aspect`: width / height of the picture.
[[nodiscard]] Camera framing(const Camera& camera, const Bounds& bounds, float aspect);

/// framing() of a box; a box that is flat in Z is seen from the front.
[[nodiscard]] Camera first_view(const Camera& camera, const Bounds& bounds, float aspect);

enum class StandardView : std::uint8_t {
    Front, // from +Z
    Side,  // from +X
    Top,   // from +Y, with +X to the right
};
/// Moves the eye to a standard view of the target, at the same distance.
[[nodiscard]] Camera seen_from(StandardView view, const Camera& camera);

/// Unit vectors forward along the view, and to the right.
[[nodiscard]] glm::vec3 forward_of(const Camera& camera);
[[nodiscard]] glm::vec3 right_of(const Camera& camera);

/// Direction from the eye to a point of the picture. `right` and `up`: position of the point
/// relative to the centre, in half picture heights. The component of the result along the view is
/// 1.
[[nodiscard]] glm::vec3 direction_at(const Camera& camera, float right, float up);

[[nodiscard]] glm::mat4 view_matrix(const Camera& camera);
/// Projection with reversed depth: 1 at `near` (m), 0 at infinity.
[[nodiscard]] glm::mat4 projection_matrix(const Camera& camera, float aspect, float near);
/// Distance of the near plane from the eye, in m.
[[nodiscard]] float near_distance(const Camera& camera);

} // namespace lsys::view
