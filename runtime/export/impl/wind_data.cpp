// SPDX-License-Identifier: MIT
#include "runtime/export/impl/wind_data.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

// Successive multiples of the golden ratio, modulo 1, are spread evenly.
constexpr double kGolden = 0.6180339887498949;

double phase_of(std::uint32_t bough) {
    const double turns = kGolden * static_cast<double>(bough);
    return turns - std::floor(turns);
}

/// Whether `child` continues the trunk rather than `other`: the thicker segment, else the segment
/// in fewer brackets, else the child that was drawn first.
bool continues(const Segment& child, const Segment& other) {
    return child.base_radius > other.base_radius ||
           (child.base_radius == other.base_radius && child.order < other.order);
}

/// Marks the segments of the trunks of a plant: from each root, follows the child that continues
/// the trunk.
std::vector<bool> trunks_of(const Skeleton& plant) {
    const auto count = static_cast<std::uint32_t>(plant.segments.size());
    std::vector<std::uint32_t> next(count, kNoSegment);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = plant.segments[i].parent;
        if (parent < i && (next[parent] == kNoSegment ||
                           continues(plant.segments[i], plant.segments[next[parent]]))) {
            next[parent] = i;
        }
    }
    std::vector<bool> is_trunk(count, false);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = plant.segments[i].parent;
        is_trunk[i] = parent >= i || (is_trunk[parent] && next[parent] == i);
    }
    return is_trunk;
}

} // namespace

WindData::WindData(const Skeleton& plant) : plant_(&plant) {
    const std::vector<bool> is_trunk = trunks_of(plant);
    const auto count = static_cast<std::uint32_t>(plant.segments.size());
    places_.resize(count);
    // The sum of the angles of the segments from the pivot to the tip of each segment, and the
    // bending at base and tip of each segment.
    std::vector<double> angles(count, 0.0);
    std::vector<std::array<double, 2>> bends(count);
    double max_bend = 0.0;
    std::uint32_t boughs = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Segment& segment = plant.segments[i];
        const std::uint32_t parent = segment.parent;
        const bool begins = parent >= i || (is_trunk[parent] && !is_trunk[i]);
        Place& place = places_[i];
        double angle = 0.0;
        if (begins) {
            place.pivot_height = segment.base.y;
            place.phase = static_cast<float>(phase_of(boughs++));
        } else {
            place.pivot_height = places_[parent].pivot_height;
            place.phase = places_[parent].phase;
            place.distance = places_[parent].distance + plant.segments[parent].length;
            bends[i][0] = bends[parent][1];
            angle = angles[parent];
        }
        const double length = static_cast<double>(segment.length);
        const double radius =
            static_cast<double>(std::max(segment.base_radius, segment.tip_radius));
        if (is_trunk[i]) {
            continue;
        }
        angles[i] = angle + (radius > 0.0 ? length / radius : 0.0);
        bends[i][1] = bends[i][0] + length * angles[i];
        max_bend = std::max(max_bend, bends[i][1]);
    }
    for (std::uint32_t i = 0; i < count && max_bend > 0.0; ++i) {
        places_[i].bend = {static_cast<float>(bends[i][0] / max_bend),
                           static_cast<float>(bends[i][1] / max_bend)};
    }
}

WindVertex WindData::on(std::uint32_t number, const glm::vec3& position) const {
    if (number >= places_.size()) {
        return {{0.0F, 0.0F}, {0.0F, 1.0F}};
    }
    const Segment& segment = plant_->segments[number];
    const Place& place = places_[number];
    const float along =
        std::clamp(glm::dot(position - segment.base, heading(segment.frame)), 0.0F, segment.length);
    const float part = segment.length > 0.0F ? along / segment.length : 0.0F;
    const float bend = place.bend[0] + part * (place.bend[1] - place.bend[0]);
    return {{place.pivot_height, place.distance + along},
            {place.phase, std::clamp(1.0F - bend, 0.0F, 1.0F)}};
}

WindVertex WindData::at(const VertexSegments& bound, const glm::vec3& position) const {
    // A vertex at a joint takes the values of the segment that ends there.
    return on(bound[0], position);
}

} // namespace lsys
