// SPDX-License-Identifier: MIT
#include "runtime/export/impl/outline.h"

#include "grammar/base/trigonometry.h"
#include "runtime/export/impl/opacity_outline.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/organ_shape.h"
#include "runtime/meshing/shapes.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace lsys {

namespace {

constexpr int kDirections = 128; // in which the farthest point is kept

/// Point `i` of a spiral that covers the sphere evenly (Swinbank and Purser, "Fibonacci grids",
/// 2006).
glm::vec3 direction(int i) {
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double radius = std::sqrt(1.0 - z * z);
    const SineCosine turn = sine_cosine(golden * i);
    return glm::vec3(glm::dvec3(radius * turn.cosine, radius * turn.sine, z));
}

/// The farthest point in each of many directions, without duplicates.
std::vector<glm::vec3> extreme_points(const std::vector<glm::vec3>& points) {
    std::vector<std::size_t> extreme;
    for (int i = 0; i < kDirections && !points.empty(); ++i) {
        const glm::vec3 ahead = direction(i);
        std::size_t farthest = 0;
        for (std::size_t p = 1; p < points.size(); ++p) {
            if (glm::dot(points[p], ahead) > glm::dot(points[farthest], ahead)) {
                farthest = p;
            }
        }
        extreme.push_back(farthest);
    }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    std::vector<glm::vec3> found;
    found.reserve(extreme.size());
    for (const std::size_t p : extreme) {
        found.push_back(points[p]);
    }
    return found;
}

/// Flat part of a mesh: texture coordinates (u, v) are at origin + u * along_u + v * along_v.
struct Card {
    glm::vec3 origin;
    glm::vec3 along_u;
    glm::vec3 along_v;
    glm::vec2 low; // box of its texture coordinates
    glm::vec2 high;
    float area = 0.0F; // of its triangles in texture coordinates

    [[nodiscard]] glm::vec3 at(const glm::vec2& t) const {
        return origin + t.x * along_u + t.y * along_v;
    }
};

using Triangle = std::array<std::uint32_t, 3>;

/// The card of a triangle; nothing if the triangle has no area in texture coordinates.
std::optional<Card> card_of(const UserMesh& mesh, const Triangle& corners) {
    const auto& t = mesh.texture_coordinates;
    const auto& p = mesh.positions;
    const glm::vec2 a = t[corners[1]] - t[corners[0]];
    const glm::vec2 b = t[corners[2]] - t[corners[0]];
    const float determinant = a.x * b.y - a.y * b.x;
    if (!(std::fabs(determinant) > 1e-9F)) {
        return std::nullopt;
    }
    const glm::vec3 to_a = (p[corners[1]] - p[corners[0]]) / determinant;
    const glm::vec3 to_b = (p[corners[2]] - p[corners[0]]) / determinant;
    Card card;
    card.along_u = to_a * b.y - to_b * a.y;
    card.along_v = to_b * a.x - to_a * b.x;
    card.origin = p[corners[0]] - t[corners[0]].x * card.along_u - t[corners[0]].y * card.along_v;
    card.low = t[corners[0]];
    card.high = card.low;
    return card;
}

bool contains(const Card& card, const UserMesh& mesh, const Triangle& corners, float tolerance) {
    return std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
        return glm::distance(card.at(mesh.texture_coordinates[corner]), mesh.positions[corner]) <=
               tolerance;
    });
}

/// The cards of a mesh; none if the mesh has parts that are not cards.
std::vector<Card> find_cards(const UserMesh& mesh) {
    constexpr std::size_t kMaxCards = 64;
    constexpr float kTolerance = 1e-3F; // fraction of the size of the mesh
    constexpr float kMinFilled = 0.6F;  // of the box of texture coordinates; a triangle fills 0.5
    constexpr float kBeyond = 0.01F;    // farther outside 0 to 1 the picture repeats
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    const float tolerance = kTolerance * glm::distance(bounds.low, bounds.high);
    std::vector<Card> cards;
    if (mesh.texture_coordinates.size() != mesh.positions.size()) {
        return cards;
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Triangle corners{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
        const std::optional<Card> triangle_card = card_of(mesh, corners);
        auto card = std::find_if(cards.begin(), cards.end(), [&](const Card& each) {
            return contains(each, mesh, corners, tolerance);
        });
        if (!triangle_card || (card == cards.end() && cards.size() == kMaxCards)) {
            return {};
        }
        if (card == cards.end()) {
            cards.push_back(*triangle_card);
            card = cards.end() - 1;
        }
        const auto& t = mesh.texture_coordinates;
        for (const std::uint32_t corner : corners) {
            card->low = glm::min(card->low, t[corner]);
            card->high = glm::max(card->high, t[corner]);
        }
        const glm::vec2 a = t[corners[1]] - t[corners[0]];
        const glm::vec2 b = t[corners[2]] - t[corners[0]];
        card->area += 0.5F * std::fabs(a.x * b.y - a.y * b.x);
    }
    const bool flat = std::all_of(cards.begin(), cards.end(), [](const Card& card) {
        const glm::vec2 size = card.high - card.low;
        return card.area >= kMinFilled * size.x * size.y && card.low.x >= -kBeyond &&
               card.low.y >= -kBeyond && card.high.x <= 1.0F + kBeyond &&
               card.high.y <= 1.0F + kBeyond;
    });
    return flat ? cards : std::vector<Card>{};
}

/// Outlines of the opaque parts of a mesh of cards; empty for other meshes and for pictures without
/// holes.
std::vector<std::vector<glm::vec3>> picture_outline(const UserMesh& mesh) {
    std::vector<std::vector<glm::vec3>> loops;
    if (!has_holes(*mesh.picture)) {
        return loops;
    }
    for (const Card& card : find_cards(mesh)) {
        for (const std::vector<glm::vec2>& outline :
             opacity_outline(*mesh.picture, card.low, card.high)) {
            std::vector<glm::vec3>& loop = loops.emplace_back();
            for (const glm::vec2& point : outline) {
                loop.push_back(card.at(point));
            }
        }
    }
    return loops;
}

float turn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

std::vector<Outline> object_outlines(const PlacedObject& object,
                                     const std::vector<UserMesh>& user_meshes,
                                     const Looks* looks) {
    Shape shape;
    if (object.kind != TurtleOperation::MeshFile) {
        shape = make_shape(object.kind, 0);
    } else if (object.mesh_file < user_meshes.size()) {
        shape = make_shape(user_meshes[object.mesh_file]);
    }
    std::vector<Outline> outlines;
    for (const ShapePart& part : shape.parts) {
        const bool has_object_colour = part.takes_colour && object.colour != 0;
        outlines.push_back(
            {extreme_points(part.positions),
             {},
             plain_colour(looks, has_object_colour ? object.colour : part.material.palette)});
        if (part.material.textured && object.kind == TurtleOperation::MeshFile) {
            const UserMesh& mesh = user_meshes[object.mesh_file];
            const Look* const look =
                looks == nullptr
                    ? nullptr
                    : looks->find(has_object_colour ? object.colour : part.material.palette);
            if (look == nullptr || look->picture == nullptr) {
                outlines.back().colour =
                    mean_colour(*mesh.picture) *
                    (look != nullptr ? look->colour.value_or(glm::vec3(1.0F)) : glm::vec3(1.0F));
            }
            outlines.back().loops = picture_outline(mesh);
        }
    }
    // The calyx, the last part of a flower, is drawn first, so that petals cover it.
    std::rotate(outlines.begin(), outlines.end() - (outlines.size() > 1 ? 1 : 0), outlines.end());
    return outlines;
}

std::vector<Outline> organ_outlines(const Skeleton& skeleton, const PlacedObject& object) {
    std::vector<Outline> outlines;
    for (OrganStrip& strip : organ_strips(skeleton, object)) {
        outlines.push_back(
            {std::move(strip.corners), {}, plain_colour(skeleton.looks.get(), strip.colour)});
    }
    return outlines;
}

std::vector<glm::vec2> convex_hull(std::vector<glm::vec2>& points) {
    // Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
    std::sort(points.begin(), points.end(), [](const glm::vec2& a, const glm::vec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<glm::vec2> chain;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = chain.size();
        for (const glm::vec2& point : points) {
            while (chain.size() >= start + 2 &&
                   turn(chain[chain.size() - 2], chain.back(), point) <= 0.0F) {
                chain.pop_back();
            }
            chain.push_back(point);
        }
        if (!chain.empty()) {
            chain.pop_back(); // the other chain begins with this point
        }
        std::reverse(points.begin(), points.end());
    }
    return chain;
}

} // namespace lsys
