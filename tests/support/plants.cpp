// SPDX-License-Identifier: MIT
#include "tests/support/plants.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys::test {

namespace {

/// The rotation from +Y to `unit`.
glm::quat aimed(const glm::vec3& unit) {
    if (unit.y < -0.9999F) {
        return {0.0F, 0.0F, 0.0F, 1.0F};
    }
    return glm::normalize(glm::quat(1.0F + unit.y, unit.z, 0.0F, -unit.x));
}

} // namespace

std::uint32_t
Plant::add(std::uint32_t parent, const glm::vec3& direction, float length, const Look& look) {
    Segment segment;
    segment.base = parent == kNoSegment ? glm::vec3(0.0F) : tip(skeleton_.segments[parent]);
    segment.length = length;
    segment.frame =
        aimed(glm::normalize(direction)) * glm::angleAxis(look.roll, glm::vec3(0.0F, 1.0F, 0.0F));
    segment.base_radius = look.base_radius;
    segment.tip_radius = look.tip_radius;
    segment.parent = parent;
    segment.order = look.order;
    segment.colour = look.colour;
    segment.sides = look.sides;
    segment.linked = parent != kNoSegment;
    skeleton_.segments.push_back(segment);
    return static_cast<std::uint32_t>(skeleton_.segments.size() - 1);
}

glm::vec3 RandomNumbers::direction() {
    for (;;) {
        const glm::vec3 v(uniform(-1.0F, 1.0F), uniform(-1.0F, 1.0F), uniform(-1.0F, 1.0F));
        const float square = glm::dot(v, v);
        if (square > 0.01F && square < 1.0F) {
            return v / std::sqrt(square);
        }
    }
}

Skeleton random_tree(std::uint32_t seed, std::uint32_t orders) {
    struct Bud {
        std::uint32_t parent = kNoSegment;
        glm::vec3 direction{0.0F, 1.0F, 0.0F};
        float radius = 0.12F;
        std::uint16_t order = 0;
    };
    RandomNumbers numbers(seed);
    Plant plant;
    std::vector<Bud> buds{Bud{}};
    while (!buds.empty()) {
        Bud bud = buds.back();
        buds.pop_back();
        const std::uint32_t pieces = 8;
        const float taper = 0.9F;
        for (std::uint32_t i = 0; i < pieces; ++i) {
            const float after = bud.radius * taper;
            bud.parent = plant.add(bud.parent, bud.direction, bud.order == 0 ? 0.6F : 0.35F,
                                   {.base_radius = bud.radius,
                                    .tip_radius = after,
                                    .order = bud.order,
                                    .roll = numbers.uniform(-3.0F, 3.0F)});
            bud.radius = after;
            const glm::vec3 drift = numbers.direction();
            if (bud.order < orders && i > 1) {
                buds.push_back({bud.parent, glm::normalize(bud.direction + 1.2F * drift),
                                bud.radius * 0.45F, static_cast<std::uint16_t>(bud.order + 1)});
            }
            bud.direction = glm::normalize(bud.direction + 0.15F * numbers.direction());
        }
    }
    return std::move(plant.skeleton());
}

std::size_t coverage(const Mesh& mesh, const Bounds& frame, std::uint32_t size, float turn) {
    const glm::vec3 middle = 0.5F * (frame.low + frame.high);
    const glm::vec3 half = frame.high - middle;
    const float reach = std::max(half.y, std::hypot(half.x, half.z));
    const float scale = 0.5F * static_cast<float>(size) / reach;
    const auto place = [&](std::uint32_t vertex) {
        const glm::vec3 p = mesh.positions[vertex] - middle;
        return scale * glm::vec2(std::cos(turn) * p.x + std::sin(turn) * p.z + reach, p.y + reach);
    };
    std::vector<bool> covered(std::size_t{size} * size);
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const glm::vec2 a = place(mesh.indices[t]);
        const glm::vec2 b = place(mesh.indices[t + 1]);
        const glm::vec2 c = place(mesh.indices[t + 2]);
        const auto first = [&](float low) {
            return std::max(0, static_cast<int>(std::floor(low)));
        };
        const auto last = [&](float high) {
            return std::min(static_cast<int>(size) - 1, static_cast<int>(std::floor(high)));
        };
        for (int y = first(std::min({a.y, b.y, c.y})); y <= last(std::max({a.y, b.y, c.y})); ++y) {
            for (int x = first(std::min({a.x, b.x, c.x})); x <= last(std::max({a.x, b.x, c.x}));
                 ++x) {
                const glm::vec2 p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
                const auto side = [&](const glm::vec2& from, const glm::vec2& to) {
                    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
                };
                const float ab = side(a, b);
                const float bc = side(b, c);
                const float ca = side(c, a);
                if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0)) {
                    covered[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)] =
                        true;
                }
            }
        }
    }
    return static_cast<std::size_t>(std::count(covered.begin(), covered.end(), true));
}

} // namespace lsys::test
