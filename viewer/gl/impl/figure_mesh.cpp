// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/figure_mesh.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace lsys::view {

namespace {

/// A limb between two round ends; lengths in m. `depth`: factor of its extent along Z, from its
/// axis.
struct Limb {
    glm::vec3 low;
    float low_radius;
    glm::vec3 high;
    float high_radius;
    float depth;
    bool has_mirror; // the body has a mirrored copy of it
};
// Proportions of a standing adult: legs 0.9 m, arms to the middle of the thigh, head 0.23 m.
constexpr std::array<Limb, 8> kLimbs = {{
    {{0.0F, 1.66F, 0.0F}, 0.080F, {0.0F, 1.70F, 0.0F}, 0.100F, 1.1F, false},     // head
    {{0.0F, 1.46F, 0.0F}, 0.060F, {0.0F, 1.60F, 0.0F}, 0.055F, 1.0F, false},     // neck
    {{0.0F, 1.05F, 0.0F}, 0.150F, {0.0F, 1.33F, 0.0F}, 0.170F, 0.62F, false},    // chest
    {{0.0F, 0.93F, 0.0F}, 0.150F, {0.0F, 1.05F, 0.0F}, 0.145F, 0.68F, false},    // hips
    {{0.10F, 0.08F, 0.0F}, 0.045F, {0.085F, 0.90F, 0.0F}, 0.085F, 1.0F, true},   // leg
    {{0.11F, 0.04F, 0.13F}, 0.035F, {0.10F, 0.05F, -0.02F}, 0.045F, 1.0F, true}, // foot
    {{0.19F, 1.38F, 0.0F}, 0.058F, {0.12F, 1.42F, 0.0F}, 0.060F, 0.9F, true},    // shoulder
    {{0.25F, 0.80F, 0.04F}, 0.032F, {0.195F, 1.38F, 0.0F}, 0.050F, 1.0F, true},  // arm
}};
constexpr std::uint32_t kSides = 12;
constexpr std::uint32_t kRings = 10; // half of them around each end

/// Appends a limb; with `side` -1 its mirror image in X.
void add_limb(const Limb& limb, float side, const glm::vec3& feet, Mesh& mesh) {
    const glm::vec3 axis = glm::normalize(limb.high - limb.low);
    const glm::vec3 across = glm::normalize(glm::cross(axis, glm::vec3(0.3F, 0.1F, 1.0F)));
    const glm::vec3 aside = glm::cross(axis, across);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    constexpr float kPi = std::numbers::pi_v<float>;
    for (std::uint32_t ring = 0; ring < kRings; ++ring) {
        const bool is_high = ring >= kRings / 2;
        // Latitude from -90 degrees at the low end to 90 degrees at the high end; both rings at the
        // middle are equators.
        const float step =
            static_cast<float>(ring - (is_high ? 1U : 0U)) / static_cast<float>(kRings - 2);
        const float latitude = kPi * (step - 0.5F);
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const float turn = 2.0F * kPi * static_cast<float>(i) / static_cast<float>(kSides);
            const glm::vec3 outward =
                std::cos(latitude) * (std::cos(turn) * across + std::sin(turn) * aside) +
                std::sin(latitude) * axis;
            glm::vec3 place = (is_high ? limb.high : limb.low) +
                              (is_high ? limb.high_radius : limb.low_radius) *
                                  glm::vec3(outward.x, outward.y, outward.z * limb.depth);
            glm::vec3 normal =
                glm::normalize(glm::vec3(outward.x, outward.y, outward.z / limb.depth));
            place.x *= side;
            normal.x *= side;
            mesh.positions.push_back(feet + place);
            mesh.normals.push_back(normal);
        }
    }
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
        for (std::uint32_t i = 0; i < kSides; ++i) {
            const std::uint32_t low = first + ring * kSides;
            const std::uint32_t next = (i + 1) % kSides;
            // The mirror image of a triangle has its corners in reverse order.
            const std::uint32_t one = side > 0.0F ? low + next : low + kSides + i;
            const std::uint32_t other = side > 0.0F ? low + kSides + i : low + next;
            const std::uint32_t opposite = low + kSides + next;
            for (const std::uint32_t index : {low + i, one, opposite, low + i, opposite, other}) {
                mesh.indices.push_back(index);
            }
        }
    }
}

} // namespace

Mesh make_figure_mesh(const glm::vec3& feet) {
    Mesh mesh;
    for (const Limb& limb : kLimbs) {
        add_limb(limb, 1.0F, feet, mesh);
        if (limb.has_mirror) {
            add_limb(limb, -1.0F, feet, mesh);
        }
    }
    mesh.texture_coordinates.resize(mesh.positions.size());
    mesh.tangents.resize(mesh.positions.size());
    Material cloth;
    cloth.colour = {0.30F, 0.05F, 0.03F, 1.0F}; // visible against leaves, ground and sky
    mesh.materials = {cloth};
    mesh.parts = {{0, 0, mesh.indices.size()}};
    return mesh;
}

} // namespace lsys::view
