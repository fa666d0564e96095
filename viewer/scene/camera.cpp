// SPDX-License-Identifier: MIT
#include "viewer/scene/camera.h"

#include "grammar/base/number_chars.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace lsys::view {

namespace {

constexpr glm::vec3 kUp{0.0F, 1.0F, 0.0F};
constexpr float kSteepest = 1.553F;  // radians, max angle of the view above or below the horizon
constexpr float kMinField = 1.0F;    // degrees
constexpr float kMaxField = 170.0F;  // degrees
constexpr float kNearest = 0.02F;    // m, min distance of the near plane
constexpr float kMaxDistance = 1e7F; // m, max coordinate of eye and target, and max distance
constexpr double kNearWorld =
    16'384.0; // m, max distance along X and Z of cameras without an origin

/// Removes the first word from `text` and returns it.
std::string_view take_word(std::string_view& text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

bool parse_place(std::string_view text, glm::dvec3& place) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == values.size()) ||
            !parse_number(text.substr(0, comma), values[i]) ||
            std::abs(values[i]) > static_cast<double>(kMaxDistance)) {
            return false;
        }
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    place = {values[0], values[1], values[2]};
    return true;
}

struct ViewAngles {
    float azimuth = 0.0F;   // radians, from -Z towards +X
    float elevation = 0.0F; // radians, above the horizon
};

ViewAngles angles_of(const glm::vec3& unit) {
    return {std::atan2(unit.x, -unit.z), std::asin(std::clamp(unit.y, -1.0F, 1.0F))};
}

glm::vec3 unit_of(const ViewAngles& angles) {
    const float steep = std::clamp(angles.elevation, -kSteepest, kSteepest);
    return {std::sin(angles.azimuth) * std::cos(steep), std::sin(steep),
            -std::cos(angles.azimuth) * std::cos(steep)};
}

} // namespace

glm::dvec3 nearest_origin(const glm::dvec3& place) {
    return {std::round(place.x / kOriginStep) * kOriginStep, 0.0,
            std::round(place.z / kOriginStep) * kOriginStep};
}

glm::dvec3 eye_of(const Camera& camera) {
    return camera.origin + glm::dvec3(camera.eye);
}

Camera relative_to(const Camera& camera, const glm::dvec3& origin) {
    if (camera.origin == origin) {
        return camera;
    }
    Camera moved = camera;
    moved.origin = origin;
    moved.eye = glm::vec3(glm::dvec3(camera.eye) + (camera.origin - origin));
    moved.target = glm::vec3(glm::dvec3(camera.target) + (camera.origin - origin));
    return moved;
}

std::string to_text(const Camera& camera) {
    if (camera.origin != glm::dvec3(0.0)) {
        const glm::dvec3 eye = eye_of(camera);
        const glm::dvec3 target = camera.origin + glm::dvec3(camera.target);
        return fmt::format("eye {},{},{} target {},{},{} fov {}", eye.x, eye.y, eye.z, target.x,
                           target.y, target.z, camera.field_of_view);
    }
    const glm::vec3& e = camera.eye;
    const glm::vec3& t = camera.target;
    return fmt::format("eye {},{},{} target {},{},{} fov {}", e.x, e.y, e.z, t.x, t.y, t.z,
                       camera.field_of_view);
}

Result<Camera> parse_camera(std::string_view text, const Camera& otherwise) {
    Camera camera = otherwise;
    glm::dvec3 eye = eye_of(otherwise);
    glm::dvec3 target = otherwise.origin + glm::dvec3(otherwise.target);
    std::vector<std::string_view> known;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
        const std::string_view value = take_word(text);
        if (std::find(known.begin(), known.end(), word) != known.end()) {
            return Error{fmt::format("a camera has one `{}`", word)};
        }
        known.push_back(word);
        if (word == "eye" || word == "target") {
            if (!parse_place(value, word == "eye" ? eye : target)) {
                return Error{
                    fmt::format("a camera's {} is X,Y,Z, each at most {:g} metres, not `{}`", word,
                                kMaxDistance, value)};
            }
        } else if (word == "fov") {
            if (!parse_number(value, camera.field_of_view) || camera.field_of_view < kMinField ||
                camera.field_of_view > kMaxField) {
                return Error{
                    fmt::format("a camera's field of view is 1 to 170 degrees, not `{}`", value)};
            }
        } else {
            return Error{
                fmt::format("a camera is `eye X,Y,Z target X,Y,Z fov DEGREES`; `{}` is not a "
                            "part of it",
                            word)};
        }
    }
    const bool is_near = std::abs(eye.x) <= kNearWorld && std::abs(eye.z) <= kNearWorld;
    camera.origin = is_near ? glm::dvec3(0.0) : nearest_origin(eye);
    camera.eye = glm::vec3(eye - camera.origin);
    camera.target = glm::vec3(target - camera.origin);
    if (glm::distance(camera.eye, camera.target) < 1e-4F) {
        return Error{"a camera's eye and target are at one place"};
    }
    return camera;
}

Camera between(const Camera& first, const Camera& last, double part) {
    const glm::dvec3 eye = glm::mix(eye_of(first), eye_of(last), part);
    const glm::dvec3 target = glm::mix(first.origin + glm::dvec3(first.target),
                                       last.origin + glm::dvec3(last.target), part);
    Camera camera = first;
    const bool is_near = std::abs(eye.x) <= kNearWorld && std::abs(eye.z) <= kNearWorld;
    camera.origin = is_near ? glm::dvec3(0.0) : nearest_origin(eye);
    camera.eye = glm::vec3(eye - camera.origin);
    camera.target = glm::vec3(target - camera.origin);
    camera.field_of_view =
        glm::mix(first.field_of_view, last.field_of_view, static_cast<float>(part));
    return camera;
}

Camera with_parts(std::string_view text, const Camera& first) {
    const Result<Camera> camera = parse_camera(text, first);
    return camera ? camera.value() : first;
}

glm::vec3 forward_of(const Camera& camera) {
    return glm::normalize(camera.target - camera.eye);
}

glm::vec3 right_of(const Camera& camera) {
    const glm::vec3 right = glm::cross(forward_of(camera), kUp);
    const float length = glm::length(right);
    return length > 1e-6F ? right / length : glm::vec3(1.0F, 0.0F, 0.0F);
}

Camera orbited(const Camera& camera, float around, float upwards) {
    ViewAngles angles = angles_of(forward_of(camera));
    angles.azimuth += around;
    angles.elevation -= upwards;
    Camera result = camera;
    result.eye = camera.target - glm::distance(camera.eye, camera.target) * unit_of(angles);
    return result;
}

Camera seen_from(StandardView view, const Camera& camera) {
    ViewAngles angles; // the view from the front
    if (view == StandardView::Side) {
        angles.azimuth = -0.5F * std::numbers::pi_v<float>;
    } else if (view == StandardView::Top) {
        angles.elevation = -kSteepest;
    }
    Camera result = camera;
    result.eye = camera.target - glm::distance(camera.eye, camera.target) * unit_of(angles);
    return result;
}

Camera zoomed(const Camera& camera, float factor) {
    Camera result = camera;
    const float distance = glm::distance(camera.eye, camera.target);
    result.eye = camera.target -
                 std::clamp(distance * factor, 2.0F * kNearest, kMaxDistance) * forward_of(camera);
    return result;
}

Camera moved(const Camera& camera, float right, float up, float forward) {
    const glm::vec3 along = forward_of(camera);
    const glm::vec3 across = right_of(camera);
    const glm::vec3 step = right * across + up * glm::cross(across, along) + forward * along;
    Camera result = camera;
    result.eye += step;
    result.target += step;
    return result;
}

Camera turned(const Camera& camera, float around, float upwards) {
    ViewAngles angles = angles_of(forward_of(camera));
    angles.azimuth += around;
    angles.elevation += upwards;
    Camera result = camera;
    result.target = camera.eye + glm::distance(camera.eye, camera.target) * unit_of(angles);
    return result;
}

Camera framing(const Camera& camera, const Bounds& bounds, float aspect) {
    if (bounds.empty) {
        return camera;
    }
    Camera result = camera;
    const glm::vec3 along = forward_of(camera);
    const glm::vec3 across = right_of(camera);
    const glm::vec3 upwards = glm::cross(across, along);
    const float tangent = std::tan(0.5F * glm::radians(camera.field_of_view));
    result.target = 0.5F * (bounds.low + bounds.high);
    // The nearest eye from which all corners of the box are in the picture.
    float distance = 0.0F;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 at = {(corner & 1U) != 0 ? bounds.high.x : bounds.low.x,
                              (corner & 2U) != 0 ? bounds.high.y : bounds.low.y,
                              (corner & 4U) != 0 ? bounds.high.z : bounds.low.z};
        const glm::vec3 from = at - result.target;
        const float wide = std::abs(glm::dot(from, across)) / (tangent * aspect);
        const float high = std::abs(glm::dot(from, upwards)) / tangent;
        distance = std::max(distance, std::max(wide, high) - glm::dot(from, along));
    }
    constexpr float kMargin = 1.08F; // factor of the distance
    result.eye = result.target - std::max(kMargin * distance, 0.1F) * along;
    return result;
}

Camera first_view(const Camera& camera, const Bounds& bounds, float aspect) {
    const glm::vec3 size = bounds.high - bounds.low;
    Camera from = camera;
    if (size.z < 0.05F * std::max(size.x, size.y)) {
        from.eye = from.target + glm::vec3(0.0F, 0.0F, 1.0F);
    }
    return framing(from, bounds, aspect);
}

glm::vec3 direction_at(const Camera& camera, float right, float up) {
    const float tangent = std::tan(0.5F * glm::radians(camera.field_of_view));
    const glm::mat4 view = view_matrix(camera);
    const glm::vec3 across(view[0][0], view[1][0], view[2][0]);
    const glm::vec3 upwards(view[0][1], view[1][1], view[2][1]);
    return forward_of(camera) + tangent * (right * across + up * upwards);
}

glm::mat4 view_matrix(const Camera& camera) {
    const glm::vec3 along = forward_of(camera);
    return glm::lookAtRH(camera.eye, camera.target,
                         std::abs(along.y) > 0.99999F ? glm::vec3(0.0F, 0.0F, -1.0F) : kUp);
}

glm::mat4 projection_matrix(const Camera& camera, float aspect, float near) {
    const float scale = 1.0F / std::tan(0.5F * glm::radians(camera.field_of_view));
    glm::mat4 matrix(0.0F);
    matrix[0][0] = scale / aspect;
    matrix[1][1] = scale;
    matrix[2][3] = -1.0F;
    matrix[3][2] = near;
    return matrix;
}

float near_distance(const Camera& camera) {
    return std::clamp(0.01F * glm::distance(camera.eye, camera.target), kNearest, 1.0F);
}

} // namespace lsys::view
