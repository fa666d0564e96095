// SPDX-License-Identifier: MIT
#include "viewer/scene/lines.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys::view {

namespace {

using Colour = std::array<std::uint8_t, 4>;

constexpr Colour kJump = {150, 150, 150, 255};

/// Colour of a ramp from blue (0) through green and yellow to red (1).
Colour ramp(float at) {
    const float hue = 0.2F + 0.65F * at;
    const auto channel = [hue](float middle) {
        const float value = std::clamp(1.5F - 4.0F * std::abs(hue - middle), 0.0F, 1.0F);
        return static_cast<std::uint8_t>(std::lround(255.0F * value));
    };
    return {channel(0.75F), channel(0.5F), channel(0.25F), 255};
}

class LineMaker {
public:
    explicit LineMaker(std::vector<LineVertex>& lines) : lines_(lines) {}

    void add(const glm::vec3& from, const glm::vec3& to, const Colour& colour) {
        lines_.push_back({from, colour});
        lines_.push_back({to, colour});
    }

private:
    std::vector<LineVertex>& lines_;
};

float part_of(std::size_t index, std::size_t count) {
    return count < 2 ? 0.0F : static_cast<float>(index) / static_cast<float>(count - 1);
}

void add_skeleton(const Skeleton& skeleton, LineMaker& lines) {
    std::uint16_t max_order = 1;
    for (const Segment& segment : skeleton.segments) {
        max_order = std::max(max_order, segment.order);
    }
    const auto colour_of = [max_order](std::uint16_t order) {
        return ramp(static_cast<float>(std::min(order, max_order)) / static_cast<float>(max_order));
    };
    for (const Segment& segment : skeleton.segments) {
        lines.add(segment.base, tip(segment), colour_of(segment.order));
    }
    for (const Polygon& polygon : skeleton.polygons) {
        for (std::uint32_t i = 0; i < polygon.corner_count; ++i) {
            const std::uint32_t next = i + 1 == polygon.corner_count ? 0 : i + 1;
            lines.add(skeleton.corners[polygon.first_corner + i],
                      skeleton.corners[polygon.first_corner + next], colour_of(polygon.order));
        }
    }
}

/// Adds the jumps of the turtle before its segments: later lines cover earlier lines, and a jump
/// back along a branch would cover the branch.
void add_path(const Skeleton& skeleton, LineMaker& lines) {
    glm::vec3 at{0.0F};
    for (const Segment& segment : skeleton.segments) {
        if (glm::distance(at, segment.base) > 1e-5F * (1.0F + glm::length(at))) {
            lines.add(at, segment.base, kJump);
        }
        at = tip(segment);
    }
    const std::size_t count = skeleton.segments.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Segment& segment = skeleton.segments[i];
        lines.add(segment.base, tip(segment), ramp(part_of(i, count)));
    }
}

} // namespace

std::vector<LineVertex> make_lines(const Skeleton& skeleton, LineKind kind) {
    std::vector<LineVertex> lines;
    LineMaker maker(lines);
    switch (kind) {
    case LineKind::None:
        break;
    case LineKind::Skeleton:
        lines.reserve(2 * (skeleton.segments.size() + skeleton.corners.size()));
        add_skeleton(skeleton, maker);
        break;
    case LineKind::TurtlePath:
        lines.reserve(3 * skeleton.segments.size());
        add_path(skeleton, maker);
        break;
    }
    return lines;
}

} // namespace lsys::view
