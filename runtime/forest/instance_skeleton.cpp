// SPDX-License-Identifier: MIT
#include "runtime/forest/instance_skeleton.h"

#include "runtime/forest/instance_meshes.h"
#include "runtime/turtle/organs.h"

#include <cstddef>
#include <iterator>
#include <map>
#include <span>

namespace lsys {

namespace {

/// Whether an instance draws a segment that begins at its entry, at the tip of the parent segment.
bool draws_at_entry(const InstanceCache& cache, const Instance& instance) {
    for (std::uint32_t r = 0; r < instance.range_count; ++r) {
        const DrawnRange& range = cache.ranges[instance.first_range + r];
        const std::uint32_t first = cache.ranges[instance.first_range].begin.segments;
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            const Segment& segment = cache.skeleton.segments[i];
            if (segment.parent < first || segment.parent == kNoSegment) {
                if (segment.linked) {
                    return true;
                }
            }
        }
    }
    return false;
}

/// By slot: whether a segment begins at the entry of its instances. The segment belongs to the
/// instance itself, or to an instance at an exit whose place is the entry.
std::vector<bool> find_slots_with_segments(const InstanceCache& cache) {
    std::vector<bool> begins(cache.slots.size());
    // Repeats until nothing changes: exits whose place is the entry of their instance form chains,
    // which are no longer than the depth of brackets.
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t s = 0; s < cache.slots.size(); ++s) {
            const InstanceSlot& slot = cache.slots[s];
            if (begins[s] || slot.variant_count == 0) {
                continue;
            }
            const Instance& instance = cache.instances[cache.variants[slot.first_variant]];
            bool found = draws_at_entry(cache, instance);
            for (std::uint32_t e = 0; e < instance.exit_count && !found; ++e) {
                const InstanceExit& exit = cache.exits[instance.first_exit + e];
                found = begins[exit.slot] && exit.position == glm::vec3(0.0F);
            }
            begins[s] = found;
            changed = changed || found;
        }
    }
    return begins;
}

/// Appends the items of the instance `part`, which are in the coordinates of the heroes, to
/// `skeleton`, at the place of the branch `at`.
void append_placed(const Skeleton& part,
                   const BranchInstance& at,
                   const Instance& instance,
                   Skeleton& skeleton) {
    const InstancePose pose = pose_of(at, instance);
    const auto place = [&pose](glm::vec3& point, glm::quat* frame) {
        point = pose.translation + pose.rotation * point;
        if (frame != nullptr) {
            *frame = pose.rotation * *frame;
        }
    };
    const auto first = static_cast<std::uint32_t>(skeleton.segments.size());
    const auto placed = [&](auto item) {
        item.parent = item.parent == kNoSegment ? kNoSegment : item.parent + first;
        item.order = static_cast<std::uint16_t>(item.order + at.order - instance.order);
        return item;
    };
    for (const Segment& each : part.segments) {
        skeleton.segments.push_back(placed(each));
        place(skeleton.segments.back().base, &skeleton.segments.back().frame);
    }
    for (const PlacedObject& each : part.objects) {
        skeleton.objects.push_back(placed(each));
        place(skeleton.objects.back().position, &skeleton.objects.back().frame);
        copy_organ(part, skeleton.objects.back(), skeleton);
    }
    const auto first_corner = static_cast<std::uint32_t>(skeleton.corners.size());
    for (const Polygon& each : part.polygons) {
        Polygon polygon = placed(each);
        polygon.first_corner += first_corner;
        polygon.frame = pose.rotation * polygon.frame;
        skeleton.polygons.push_back(polygon);
    }
    for (glm::vec3 corner : part.corners) {
        place(corner, nullptr);
        skeleton.corners.push_back(corner);
    }
}

} // namespace

std::vector<std::uint32_t> forked_segments(const InstanceCache& cache) {
    const std::vector<bool> begins = find_slots_with_segments(cache);
    std::vector<std::uint32_t> segments;
    for (const InstanceFork& fork : cache.forks) {
        if (begins[fork.slot]) {
            segments.push_back(fork.segment);
        }
    }
    return segments;
}

Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance) {
    const Skeleton& cache_skeleton = cache.skeleton;
    Skeleton skeleton;
    skeleton.mesh_files = cache_skeleton.mesh_files;
    skeleton.looks = cache_skeleton.looks;
    skeleton.contours = cache_skeleton.contours;
    skeleton.l3d_compatible_surface = cache_skeleton.l3d_compatible_surface;
    skeleton.box_segments = cache_skeleton.box_segments;
    skeleton.leaf_droop = cache_skeleton.leaf_droop;
    skeleton.tube_shape = cache_skeleton.tube_shape;
    // For each range: its first segment's number in the cache, and the new number of this segment.
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
            copy_organ(cache_skeleton, object, skeleton);
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

PartSkeletons::PartSkeletons(const InstanceCache& cache)
    : cache_(cache), forked_(cache.skeleton.segments.size()) {
    for (const std::uint32_t segment : forked_segments(cache)) {
        forked_[segment] = true;
    }
}

Skeleton PartSkeletons::alone(std::uint32_t number) const {
    const Instance& instance = cache_.instances[number];
    Skeleton skeleton = skeleton_of(cache_, instance);
    std::size_t next = 0;
    for (std::uint32_t r = 0; r < instance.range_count; ++r) {
        const DrawnRange& range = cache_.ranges[instance.first_range + r];
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            Segment& segment = skeleton.segments[next++];
            segment.forked = segment.forked || forked_[i];
            if (instance.slot != 0 && segment.parent == kNoSegment) {
                segment.linked = false;
                segment.cut = true;
            }
        }
    }
    return skeleton;
}

Skeleton PartSkeletons::whole(std::uint32_t number) const {
    Skeleton skeleton = alone(number);
    const Instance& top = cache_.instances[number];
    std::vector<BranchInstance> pending;
    const auto add_exits = [&](const BranchInstance& at) {
        const Instance& instance = cache_.instances[at.instance];
        for (std::uint32_t i = instance.exit_count; i-- > 0;) {
            const InstanceExit& exit = cache_.exits[instance.first_exit + i];
            pending.push_back({at.rotation * exit.rotation,
                               at.position + at.rotation * exit.position, at.scale,
                               stand_in(cache_, cache_.slots[exit.slot]), at.order + exit.order});
        }
    };
    add_exits({glm::quat(top.frame), glm::vec3(top.position), 1.0F, number, top.order});
    while (!pending.empty()) {
        const BranchInstance at = pending.back();
        pending.pop_back();
        append_placed(alone(at.instance), at, cache_.instances[at.instance], skeleton);
        add_exits(at);
    }
    return skeleton;
}

} // namespace lsys
