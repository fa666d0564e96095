// SPDX-License-Identifier: MIT
// Skeletons of the instances of a cache.
#pragma once

#include "runtime/forest/instance_cache.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// The part of the heroes' skeleton that an instance draws, with segments numbered from 0, in the
/// coordinates of the heroes. Segments whose parent is outside of the instance have the parent
/// kNoSegment.
[[nodiscard]] Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance);

/// The segments of the heroes with a fork (glossary of runtime/forest/README.md) whose branch draws
/// a segment at its entry.
[[nodiscard]] std::vector<std::uint32_t> forked_segments(const InstanceCache& cache);

/// The stand-in of a slot: its first instance, which PartSkeletons::whole() takes for every
/// instance of the slot.
[[nodiscard]] inline std::uint32_t stand_in(const InstanceCache& cache, const InstanceSlot& slot) {
    return cache.variants[slot.first_variant];
}

/// Skeletons of parts of trees, each to be meshed alone. A part keeps the heroes' coordinates
/// of its first instance, so pose_of() of this instance places the whole part.
class PartSkeletons {
public:
    /// `cache` must outlive the object.
    explicit PartSkeletons(const InstanceCache& cache);

    /// An instance without the instances at its exits. Segments whose parent is in another instance
    /// get a closed base.
    [[nodiscard]] Skeleton alone(std::uint32_t instance) const;
    /// An instance with stand-ins at its exits, with stand-ins at the exits of these, and so on.
    [[nodiscard]] Skeleton whole(std::uint32_t instance) const;

private:
    const InstanceCache& cache_;
    std::vector<bool> forked_; // by segment of the heroes
};

} // namespace lsys
