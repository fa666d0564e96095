#include "runtime/meshing/axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace lsys {

namespace {

float straightness(const Segment& a, const Segment& b) {
    return glm::dot(direction(a.frame), direction(b.frame));
}

} // namespace

bool joins(const Segment& parent, const Segment& child) {
    if (!child.linked) {
        return false;
    }
    const glm::vec3 end = parent.base + parent.length * direction(parent.frame);
    const glm::vec3 gap = glm::abs(end - child.base);
    const glm::vec3 place = glm::abs(child.base);
    const float far = std::max(std::max(place.x, place.y), place.z);
    return std::max(std::max(gap.x, gap.y), gap.z) <=
           1e-2F * (parent.length + child.base_radius) + 1e-5F * far;
}

Axes find_axes(const Skeleton& skeleton) {
    const LargeVector<Segment>& segments = skeleton.segments;
    Axes axes;
    axes.next.resize(segments.size());
    std::vector<bool> used(std::size_t{1} << 16);
    std::uint32_t last_colour = ~std::uint32_t{0};
    for (std::uint32_t i = 0; i < segments.size(); ++i) {
        const Segment& segment = segments[i];
        axes.next[i] = segment.forked ? kForked : kNoSegment;
        if (segment.colour != last_colour) {
            last_colour = segment.colour;
            used[last_colour] = true;
        }
        if (segment.parent >= i || !joins(segments[segment.parent], segment)) {
            continue;
        }
        const Segment& parent = segments[segment.parent];
        std::uint32_t& next = axes.next[segment.parent];
        if (parent.order != segment.order) {
            next = next == kNoSegment ? kForked : next;
        } else if (next >= kForked ||
                   straightness(parent, segment) > straightness(parent, segments[next])) {
            next = i;
        }
    }
    for (std::uint32_t colour = 0; colour < used.size(); ++colour) {
        if (used[colour]) {
            axes.colours.push_back(static_cast<std::uint16_t>(colour));
        }
    }
    return axes;
}

} // namespace lsys
