// SPDX-License-Identifier: MIT
// Areas that rectangles cover in the views of AreaMeter, compared with closed forms.
#include "runtime/meshing/impl/visible_areas.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>

namespace lsys {

namespace {

/// A rectangle around the origin; its edges are `across` and `up`.
Mesh rectangle(const glm::vec3& across, const glm::vec3& up) {
    Mesh mesh;
    for (const glm::vec2 at : {glm::vec2(-0.5F), {0.5F, -0.5F}, glm::vec2(0.5F), {-0.5F, 0.5F}}) {
        mesh.positions.push_back(at.x * across + at.y * up);
        mesh.normals.push_back(glm::cross(across, up));
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.parts.push_back({0, 0, 6});
    mesh.materials.emplace_back();
    return mesh;
}

} // namespace

TEST_CASE("rectangles cover the areas of their projections", "[mesh]") {
    const Mesh facing_z = rectangle({1, 0, 0}, {0, 0.5F, 0});
    const Mesh facing_x = rectangle({0, 0, 1}, {0, 0.5F, 0});
    const Mesh level = rectangle({1, 0, 0}, {0, 0, 1});
    const Mesh none;
    Bounds frame;
    // So low that views from the horizon and from above have the same scale.
    frame.add({-0.5F, -0.25F, -0.5F});
    frame.add({0.5F, 0.25F, 0.5F});
    AreaMeter meter(facing_z, none, frame, 1);
    // Views from 12 directions, 30 degrees apart, each from the horizon and from an elevation with
    // the sine 0.6.
    double upright_views = 0.0;
    for (int i = 0; i < 12; ++i) {
        upright_views +=
            0.5 * (1.0 + 0.8) * std::abs(std::cos((15 + 30 * i) * std::numbers::pi / 180.0));
    }
    const double whole =
        meter.measure(facing_z, none, nullptr).wood / upright_views; // pixels / m^2
    CHECK(whole > 1000.0);
    CHECK(meter.measure(facing_x, none, nullptr).wood ==
          Approx(upright_views * whole).epsilon(0.01));
    CHECK(meter.measure(none, level, nullptr).foliage == Approx(12 * 0.6 * whole).epsilon(0.01));
    // Of two rectangles, the nearer one is seen: half of the views have each in front.
    Mesh behind = facing_z;
    Mesh before = facing_z;
    for (std::size_t i = 0; i < 4; ++i) {
        behind.positions[i].z = -0.01F;
        before.positions[i].z = 0.01F;
    }
    const VisibleAreas both = meter.measure(behind, before, nullptr);
    CHECK(both.wood == Approx(both.foliage).epsilon(0.01));
}

} // namespace lsys
