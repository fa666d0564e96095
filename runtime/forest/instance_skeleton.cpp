// SPDX-License-Identifier: MIT
#include "runtime/forest/instance_skeleton.h"

#include <iterator>
#include <map>
#include <span>

namespace lsys {

Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance) {
    const Skeleton& cache_skeleton = cache.skeleton;
    Skeleton skeleton;
    skeleton.mesh_files = cache_skeleton.mesh_files;
    skeleton.looks = cache_skeleton.looks;
    skeleton.l3d_compatible_surface = cache_skeleton.l3d_compatible_surface;
    skeleton.box_segments = cache_skeleton.box_segments;
    skeleton.leaf_droop = cache_skeleton.leaf_droop;
    // New number of the first segment of each range, by its number in the cache.
    std::map<std::uint32_t, std::uint32_t> shifts;
    const auto number_of = [&](std::uint32_t parent) {
        const auto after = shifts.upper_bound(parent);
        if (parent == kNoSegment || after == shifts.begin()) {
            return kNoSegment;
        }
        const auto& [begin, first] = *std::prev(after);
        const std::uint32_t number = first + parent - begin;
        return number < skeleton.segments.size() ? number : kNoSegment;
    };
    const std::span<const DrawnRange> ranges =
        std::span(cache.ranges).subspan(instance.first_range, instance.range_count);
    for (const DrawnRange& range : ranges) {
        shifts.emplace(range.begin.segments, static_cast<std::uint32_t>(skeleton.segments.size()));
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            Segment segment = cache_skeleton.segments[i];
            segment.parent = number_of(segment.parent);
            skeleton.segments.push_back(segment);
        }
    }
    for (const DrawnRange& range : ranges) {
        for (std::uint32_t i = range.begin.objects; i < range.end.objects; ++i) {
            PlacedObject object = cache_skeleton.objects[i];
            object.parent = number_of(object.parent);
            skeleton.objects.push_back(object);
        }
        for (std::uint32_t i = range.begin.polygons; i < range.end.polygons; ++i) {
            Polygon polygon = cache_skeleton.polygons[i];
            const auto first = static_cast<std::uint32_t>(skeleton.corners.size());
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                skeleton.corners.push_back(cache_skeleton.corners[polygon.first_corner + c]);
            }
            polygon.first_corner = first;
            polygon.parent = number_of(polygon.parent);
            skeleton.polygons.push_back(polygon);
        }
    }
    return skeleton;
}

} // namespace lsys
