// SPDX-License-Identifier: MIT
// Impostors of squares, whose pictures and cards are known.
#include "runtime/meshing/impl/impostor.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/texture.h"

#include <catch2/catch.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

/// Adds a square that faces +Z, with a material of its own. Its height is 1 m, from y = 0 to 1; its
/// lower edge goes from `left` to `right`.
void add_square(Mesh& mesh, const glm::vec3& left, const glm::vec3& right, ItemColour colour) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 up(0, 1, 0);
    for (const glm::vec3& corner : {left, right, right + up, left + up}) {
        mesh.positions.push_back(corner);
        mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
        mesh.texture_coordinates.emplace_back(0.0F);
        mesh.colours.push_back(colour);
    }
    mesh.parts.push_back(
        {static_cast<std::uint32_t>(mesh.materials.size()), mesh.indices.size(), 6});
    mesh.materials.emplace_back();
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        mesh.indices.push_back(first + corner);
    }
}

} // namespace

TEST_CASE("the picture of a plant shows what is in front, in the colours of the vertices") {
    Mesh mesh;
    add_square(mesh, {0, 0, 0}, {1, 0, 0}, kOwnColour + 0x0000FF);
    add_square(mesh, {0, 0, 1}, {1, 0, 1}, kOwnColour + 0xFF0000);
    const Mesh cards = ImpostorBaker(mesh, 60.0F, 8).make(1.0, glm::vec3(1.0F));
    REQUIRE(cards.materials.size() == 1);
    REQUIRE(cards.materials[0].picture != nullptr);
    const Texture& picture = *cards.materials[0].picture;
    const std::uint32_t side = picture.width / 2; // the picture seen along -Z is the first of four
    std::size_t opaque = 0;
    std::size_t red = 0;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint8_t* const texel =
                &picture.texels[std::size_t{4} * (y * picture.width + x)];
            opaque += texel[3] >= 128 ? 1U : 0U;
            red += texel[3] >= 128 && texel[0] >= 254 && texel[1] == 0 && texel[2] == 0 ? 1U : 0U;
        }
    }
    CHECK(opaque >= std::size_t{side - 4} * (side - 4));
    CHECK(red == opaque);
}

TEST_CASE("each of three cards shows its third of the depth of a plant") {
    // Depth and place of the square increase together, so each third of the depth is a third of the
    // width.
    Mesh mesh;
    add_square(mesh, {0, 0, 0}, {1, 0, 1}, 0);
    const Mesh cards = ImpostorBaker(mesh, 60.0F, kMinSlabTriangles).make(1.0, glm::vec3(1.0F));
    struct Extent {
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
    };
    std::array<Extent, 3> across; // of the cards that face +Z, from back to front
    constexpr float kTwoTexels = 2.0F / 62.0F;
    for (std::size_t i = 0; i < cards.positions.size(); ++i) {
        if (cards.normals[i] != glm::vec3(0, 0, 1)) {
            continue;
        }
        const glm::vec3& at = cards.positions[i];
        const float slab = 3.0F * at.z - 0.5F; // cards lie in the middle of their third
        REQUIRE(std::abs(slab - std::round(slab)) < 1e-4F);
        REQUIRE((slab > -0.5F && slab < 2.5F));
        Extent& extent = across[static_cast<std::size_t>(std::lround(slab))];
        extent.low = std::min(extent.low, at.x);
        extent.high = std::max(extent.high, at.x);
        CHECK(at.y >= -kTwoTexels);
        CHECK(at.y <= 1.0F + kTwoTexels);
    }
    for (std::size_t i = 0; i < across.size(); ++i) {
        CHECK(across[i].low == Approx(static_cast<float>(i) / 3.0F).margin(kTwoTexels));
        CHECK(across[i].high == Approx(static_cast<float>(i + 1) / 3.0F).margin(kTwoTexels));
    }
}

} // namespace lsys
