#include "runtime/forest/instance_skeleton.h"

#include <iterator>
#include <map>
#include <span>

namespace lsys {

Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance) {
    const Skeleton& all = cache.skeleton;
    Skeleton own;
    own.mesh_files = all.mesh_files;
    own.looks = all.looks;
    own.l3d_compatible_surface = all.l3d_compatible_surface;
    own.box_segments = all.box_segments;
    own.leaf_droop = all.leaf_droop;
    std::map<std::uint32_t, std::uint32_t> shifts; // of segments, by the begin of their range
    const auto number_of = [&](std::uint32_t parent) {
        const auto after = shifts.upper_bound(parent);
        if (parent == kNoSegment || after == shifts.begin()) {
            return kNoSegment;
        }
        const auto& [begin, first] = *std::prev(after);
        const std::uint32_t number = first + parent - begin;
        return number < own.segments.size() ? number : kNoSegment;
    };
    const std::span<const DrawnRange> ranges =
        std::span(cache.ranges).subspan(instance.first_range, instance.range_count);
    for (const DrawnRange& range : ranges) {
        shifts.emplace(range.begin.segments, static_cast<std::uint32_t>(own.segments.size()));
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            Segment segment = all.segments[i];
            segment.parent = number_of(segment.parent);
            own.segments.push_back(segment);
        }
    }
    for (const DrawnRange& range : ranges) {
        for (std::uint32_t i = range.begin.objects; i < range.end.objects; ++i) {
            PlacedObject object = all.objects[i];
            object.parent = number_of(object.parent);
            own.objects.push_back(object);
        }
        for (std::uint32_t i = range.begin.polygons; i < range.end.polygons; ++i) {
            Polygon polygon = all.polygons[i];
            const auto first = static_cast<std::uint32_t>(own.corners.size());
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                own.corners.push_back(all.corners[polygon.first_corner + c]);
            }
            polygon.first_corner = first;
            polygon.parent = number_of(polygon.parent);
            own.polygons.push_back(polygon);
        }
    }
    return own;
}

} // namespace lsys
