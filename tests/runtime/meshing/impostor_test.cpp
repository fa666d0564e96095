// SPDX-License-Identifier: MIT
// The normal maps of impostors: a card must be as bright as the crown that it shows, under any light.
#include "runtime/meshing/impl/impostor.h"
#include "runtime/meshing/texture.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

/// Leaves, much smaller than a texel, that face all directions, in a cube of side 1.
Mesh make_crown() {
    constexpr float kSize = 0.012F;
    std::mt19937 draws(7);
    const auto draw = [&draws] { return static_cast<float>(draws() >> 8U) / 16777216.0F; };
    Mesh mesh;
    LargeVector<std::uint32_t> indices;
    for (std::uint32_t leaf = 0; leaf < 30'000; ++leaf) {
        const glm::vec3 middle(draw(), draw(), draw());
        const float up = 2.0F * draw() - 1.0F;
        const float angle = 6.2831853F * draw();
        const float around = std::sqrt(1.0F - up * up);
        const glm::vec3 normal(around * std::cos(angle), up, around * std::sin(angle));
        const glm::vec3 other =
            std::abs(up) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
        const glm::vec3 along = glm::normalize(glm::cross(normal, other));
        const glm::vec3 across = glm::cross(normal, along);
        for (const glm::vec3& at : {middle, middle + kSize * along, middle + kSize * across}) {
            indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(at);
            mesh.normals.push_back(normal);
            mesh.texture_coordinates.emplace_back(0.0F, 0.0F);
        }
    }
    mesh.parts.push_back({.material = 0, .first_index = 0, .index_count = indices.size()});
    mesh.indices = TriangleList(std::move(indices));
    Material& material = mesh.materials.emplace_back();
    material.colour = glm::vec4(0.2F, 0.4F, 0.1F, 1.0F);
    material.two_sided = true;
    return mesh;
}

/// Mean light on the leaves that a viewer sees, who looks along -z: they turn a side to the viewer.
double light_on(const Mesh& crown, const glm::vec3& to_light) {
    double sum = 0.0;
    double area = 0.0;
    for (std::size_t i = 0; i < crown.normals.size(); i += 3) {
        const glm::vec3 normal = crown.normals[i].z < 0.0F ? -crown.normals[i] : crown.normals[i];
        const auto seen = static_cast<double>(normal.z);
        sum += seen * static_cast<double>(std::max(glm::dot(normal, to_light), 0.0F));
        area += seen;
    }
    return sum / area;
}

/// Mean light on the opaque texels of the cards, in the frame of each card.
double light_on_cards(const Mesh& cards, const glm::vec3& to_light) {
    const Texture& colour = *cards.materials[0].picture;
    const Texture& normals = *cards.materials[0].normal_map;
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < colour.texels.size(); i += 4) {
        if (colour.texels[i + 3] < 128) {
            continue;
        }
        glm::vec3 normal(0.0F);
        for (int axis = 0; axis < 3; ++axis) {
            normal[axis] =
                static_cast<float>(normals.texels[i + static_cast<std::size_t>(axis)]) / 127.5F -
                1.0F;
        }
        sum += static_cast<double>(std::max(glm::dot(normal, to_light), 0.0F));
        count += 1.0;
    }
    REQUIRE(count > 100.0);
    return sum / count;
}

} // namespace

TEST_CASE("an impostor is as bright as its crown with the light behind, beside and before it") {
    const Mesh crown = make_crown();
    const Mesh cards = ImpostorBaker(crown, 24.0F, 24).make(1.0, glm::vec3(1.0F));
    for (const glm::vec3& light : {glm::vec3(0.3F, 0.5F, -0.6F), glm::vec3(1.0F, 0.4F, 0.0F),
                                   glm::vec3(-0.2F, 0.8F, 0.9F)}) {
        const glm::vec3 to_light = glm::normalize(light);
        CAPTURE(to_light.z);
        const double expected = light_on(crown, to_light);
        CHECK(expected > 0.05);
        CHECK(light_on_cards(cards, to_light) == Approx(expected).epsilon(0.1));
    }
}
