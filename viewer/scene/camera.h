// Camera: where a picture is taken from. Metres, right-handed, +Y up; a camera looks from its eye
// at its target. Written and read as one line, so that a view can be kept and made again.
#pragma once

#include "grammar/base/result.h"
#include "runtime/turtle/skeleton.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <string_view>

namespace lsys::view {

struct Camera {
    glm::vec3 eye{4.0F, 2.0F, 6.0F};
    glm::vec3 target{0.0F, 1.0F, 0.0F};
    float field_of_view = 40.0F; // degrees, from the bottom of the picture to its top

    friend bool operator==(const Camera&, const Camera&) = default;
};

/// `eye X,Y,Z target X,Y,Z fov DEGREES`, which parse_camera() reads as the same camera.
[[nodiscard]] std::string to_text(const Camera& camera);
/// Parts may come in any order and be left out: those are of `otherwise`. Error: what is not
/// understood, eye and target at one place, a field of view outside of 1 to 170 degrees.
[[nodiscard]] Result<Camera> parse_camera(std::string_view text, const Camera& otherwise);

/// Eye around target, by angles in radians; never quite to the pole.
[[nodiscard]] Camera orbited(const Camera& camera, float around, float upwards);
/// Eye nearer to the target (below 1) or farther.
[[nodiscard]] Camera zoomed(const Camera& camera, float factor);
/// Eye and target by metres to the right, upwards in the picture, and along the view.
[[nodiscard]] Camera moved(const Camera& camera, float right, float up, float forward);
/// Target around the eye, by angles in radians: to look about while flying.
[[nodiscard]] Camera turned(const Camera& camera, float around, float upwards);
/// The same direction of view, from where a box fills a picture that is `aspect` times as wide as
/// high.
[[nodiscard]] Camera framing(const Camera& camera, const Bounds& bounds, float aspect);

/// All of a box is in view, from the front if it is a drawing in the plane of X and Y.
[[nodiscard]] Camera first_view(const Camera& camera, const Bounds& bounds, float aspect);

/// Unit, to where the camera looks; its right and its up.
[[nodiscard]] glm::vec3 forward_of(const Camera& camera);
[[nodiscard]] glm::vec3 right_of(const Camera& camera);

/// To what is seen at a place of the picture: from its middle, 1 is half its height, to the right
/// and up. Of length 1 along the view.
[[nodiscard]] glm::vec3 direction_at(const Camera& camera, float right, float up);

[[nodiscard]] glm::mat4 view_matrix(const Camera& camera);
/// To clip coordinates whose depth is 1 at `near` (m) and 0 infinitely far.
[[nodiscard]] glm::mat4 projection_matrix(const Camera& camera, float aspect, float near);
/// As far as nothing in reach is cut away, m.
[[nodiscard]] float near_distance(const Camera& camera);

} // namespace lsys::view
