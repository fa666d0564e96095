// SPDX-License-Identifier: MIT
#include "viewer/scene/camera.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <cmath>

using namespace lsys;
using namespace lsys::view;

namespace {

bool near(const glm::vec3& a, const glm::vec3& b) {
    return glm::distance(a, b) < 1e-4F * (1.0F + glm::length(a));
}

glm::vec3 clip(const Camera& camera, float aspect, const glm::vec3& place) {
    const glm::vec4 at = projection_matrix(camera, aspect, near_distance(camera)) *
                         view_matrix(camera) * glm::vec4(place, 1.0F);
    return glm::vec3(at) / at.w;
}

} // namespace

TEST_CASE("a written camera is read back unchanged") {
    Camera camera;
    camera.eye = {0.1F, -3.25e-5F, 1e4F};
    camera.target = {1.0F / 3.0F, 2.0F, -7.0F};
    camera.field_of_view = 33.3F;
    const Result<Camera> read = parse_camera(to_text(camera), Camera{});
    REQUIRE(read);
    CHECK(read.value() == camera);

    camera.eye = {0.1F, -3.25e-5F, 1e6F};
    const Result<Camera> far = parse_camera(to_text(camera), Camera{});
    REQUIRE(far);
    CHECK(far.value().origin == glm::dvec3(0.0, 0.0, 244.0 * kOriginStep));
    CHECK(relative_to(far.value(), camera.origin) == camera);
}

TEST_CASE("mistakes in a camera have messages with the range") {
    CHECK(parse_camera("eye 1,2,3 eye 2,3,4", Camera{}).error().message ==
          "a camera has one `eye`");
    CHECK(parse_camera("eye 1e18,0,0", Camera{}).error().message ==
          "a camera's eye is X,Y,Z, each at most 1e+07 metres, not `1e18,0,0`");
}

TEST_CASE("parts of a camera may be omitted") {
    const Camera default_camera;
    const Result<Camera> read = parse_camera("fov 20", default_camera);
    REQUIRE(read);
    CHECK(read.value().eye == default_camera.eye);
    CHECK(read.value().field_of_view == 20.0F);
    CHECK(parse_camera("", default_camera).value() == default_camera);

    Camera first;
    first.eye = {1.0F, 2.0F, 30.0F};
    const Camera narrow = with_parts("fov 20", first);
    CHECK(narrow.eye == first.eye);
    CHECK(narrow.field_of_view == 20.0F);
    CHECK(with_parts("target 1,2,30", first) == first); // refused: eye and target are equal
}

TEST_CASE("an invalid camera is refused with a message") {
    const char* const text =
        GENERATE("eye 1,2", "eye 1,2,3,4", "eye 1,2,x", "fov 0", "fov 180", "fov nan",
                 "eye inf,0,0", "zoom 2", "eye", "target 4,2,6", "eye 1,2,3 eye");
    CAPTURE(text);
    const Result<Camera> read = parse_camera(text, Camera{});
    REQUIRE_FALSE(read);
    CHECK(read.error().message.find("camera") != std::string::npos);
}

TEST_CASE("orbiting keeps target and distance and stops before the pole") {
    const Camera camera;
    const float distance = glm::distance(camera.eye, camera.target);
    const Camera around = orbited(orbited(camera, 1.0F, 0.3F), -1.0F, -0.3F);
    CHECK(near(around.eye, camera.eye));
    const Camera above = orbited(camera, 0.4F, 100.0F);
    CHECK(above.target == camera.target);
    CHECK(std::abs(glm::distance(above.eye, above.target) - distance) < 1e-3F * distance);
    CHECK(forward_of(above).y > -1.0F);
    CHECK(forward_of(above).y < -0.99F);
}

TEST_CASE("moving follows the axes of the picture, and turning keeps the position") {
    const Camera camera;
    const Camera to_right = moved(camera, 2.0F, 0.0F, 0.0F);
    CHECK(near(to_right.eye - camera.eye, 2.0F * right_of(camera)));
    CHECK(near(forward_of(to_right), forward_of(camera)));
    const Camera ahead = moved(camera, 0.0F, 0.0F, 1.5F);
    CHECK(near(ahead.eye - camera.eye, 1.5F * forward_of(camera)));
    const Camera about = turned(camera, 0.5F, -0.2F);
    CHECK(about.eye == camera.eye);
    CHECK(std::abs(glm::dot(forward_of(about), forward_of(camera)) - 1.0F) > 0.05F);
    CHECK(glm::distance(zoomed(camera, 0.5F).eye, camera.target) ==
          Approx(0.5F * glm::distance(camera.eye, camera.target)));
}

TEST_CASE("a framed box lies within the picture and touches its border") {
    const float aspect = GENERATE(0.5F, 1.0F, 16.0F / 9.0F);
    Bounds bounds;
    bounds.add({-1.0F, 0.0F, -2.0F});
    bounds.add({3.0F, 7.0F, 2.5F});
    const Camera camera =
        framing(orbited(Camera{}, GENERATE(0.0F, 0.7F, 2.5F), 0.2F), bounds, aspect);
    float farthest = 0.0F;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 at =
            clip(camera, aspect,
                 {(corner & 1U) != 0 ? 3.0F : -1.0F, (corner & 2U) != 0 ? 7.0F : 0.0F,
                  (corner & 4U) != 0 ? 2.5F : -2.0F});
        CHECK(at.z > 0.0F);
        CHECK(at.z < 1.0F);
        farthest = std::max(farthest, std::max(std::abs(at.x), std::abs(at.y)));
    }
    CHECK(farthest <= 1.0F);
    CHECK(farthest > 0.85F);
}

TEST_CASE("depth is 1 at the near plane and falls with the distance") {
    Camera camera;
    camera.eye = {0.0F, 0.0F, 10.0F};
    camera.target = {0.0F, 0.0F, 0.0F};
    const float near_plane = near_distance(camera);
    CHECK(clip(camera, 1.0F, {0.0F, 0.0F, 10.0F - near_plane}).z == Approx(1.0F));
    CHECK(clip(camera, 1.0F, {0.0F, 0.0F, 0.0F}).z > clip(camera, 1.0F, {0.0F, 0.0F, -1.0F}).z);
    CHECK(clip(camera, 1.0F, {0.0F, 0.0F, -1e6F}).z > 0.0F);
}

TEST_CASE("standard views look along the axes and keep target and distance") {
    Camera camera;
    camera.target = {1.0F, 2.0F, 3.0F};
    const float distance = glm::distance(camera.eye, camera.target);
    const Camera front = seen_from(StandardView::Front, camera);
    CHECK(near(front.eye, camera.target + glm::vec3(0.0F, 0.0F, distance)));
    CHECK(near(right_of(front), {1.0F, 0.0F, 0.0F}));
    const Camera side = seen_from(StandardView::Side, camera);
    CHECK(near(side.eye, camera.target + glm::vec3(distance, 0.0F, 0.0F)));
    CHECK(near(right_of(side), {0.0F, 0.0F, -1.0F}));
    const Camera top = seen_from(StandardView::Top, camera);
    CHECK(top.target == camera.target);
    CHECK(forward_of(top).y < -0.99F);
    CHECK(near(right_of(top), {1.0F, 0.0F, 0.0F}));
}
