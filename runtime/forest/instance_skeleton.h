// SPDX-License-Identifier: MIT
// The skeleton of one instance of a cache, with segments numbered from 0.
#pragma once

#include "runtime/forest/instance_cache.h"

namespace lsys {

/// The part of the heroes' skeleton that an instance draws, in the coordinates of the heroes.
/// Parents outside of the instance become kNoSegment.
[[nodiscard]] Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance);

} // namespace lsys
