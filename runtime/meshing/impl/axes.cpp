// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/axes.h"

#include "runtime/base/workers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <set>

namespace lsys {

namespace {

constexpr std::size_t kSegmentsPerRange = std::size_t{1} << 16;

/// Cosine of the bend between two segments.
float straightness(const Segment& a, const Segment& b) {
    return glm::dot(direction(a.frame), direction(b.frame));
}

/// Lets the joined segment `child` continue its parent unless an earlier child bends less.
void follow(const Skeleton& skeleton, std::uint32_t child, LargeVector<std::uint32_t>& nexts) {
    const Segment& segment = skeleton.segments[child];
    const Segment& parent = skeleton.segments[segment.parent];
    std::uint32_t& next = nexts[segment.parent];
    if (parent.order != segment.order) {
        next = next == kNoSegment ? kForked : next;
    } else if (next >= kForked ||
               straightness(parent, segment) > straightness(parent, skeleton.segments[next])) {
        next = child;
    }
}

/// A range of segments that one thread handles. Children of segments in earlier ranges are handled
/// after all ranges, so that the children of a segment are compared in order.
class Range {
public:
    Range(std::size_t begin, std::size_t end) : begin_(begin), end_(end) {}

    void find(const Skeleton& skeleton, LargeVector<std::uint32_t>& nexts) {
        ItemColour last_colour = ~ItemColour{0};
        for (auto i = static_cast<std::uint32_t>(begin_); i < end_; ++i) {
            const Segment& segment = skeleton.segments[i];
            nexts[i] = segment.forked ? kForked : kNoSegment;
            if (segment.colour != last_colour) {
                last_colour = segment.colour;
                colours_.insert(segment.colour);
            }
            if (segment.parent >= i || !joins(skeleton.segments[segment.parent], segment)) {
                continue;
            }
            if (segment.parent < begin_) {
                late_.push_back(i);
            } else {
                follow(skeleton, i, nexts);
            }
        }
    }

    /// Joined segments whose parents are in earlier ranges.
    [[nodiscard]] const std::vector<std::uint32_t>& late() const { return late_; }
    /// Colours of the segments of the range.
    [[nodiscard]] const std::set<ItemColour>& colours() const { return colours_; }

private:
    std::size_t begin_;
    std::size_t end_;
    std::vector<std::uint32_t> late_;
    std::set<ItemColour> colours_;
};

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

Axes find_axes(const Skeleton& skeleton, Workers& workers) {
    const std::size_t segments = skeleton.segments.size();
    Axes axes;
    axes.next.resize(segments);
    std::vector<Range> ranges;
    for (std::size_t begin = 0; begin < segments; begin += kSegmentsPerRange) {
        ranges.emplace_back(begin, std::min(begin + kSegmentsPerRange, segments));
    }
    workers.for_each(ranges.size(), [&](std::uint64_t i) { ranges[i].find(skeleton, axes.next); });
    std::set<ItemColour> colours;
    for (const Range& range : ranges) {
        for (const std::uint32_t child : range.late()) {
            follow(skeleton, child, axes.next);
        }
        colours.insert(range.colours().begin(), range.colours().end());
    }
    axes.colours.assign(colours.begin(), colours.end());
    return axes;
}

} // namespace lsys
