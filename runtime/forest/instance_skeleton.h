// The skeleton of one instance of a cache, with numbers of its own.
#pragma once

#include "runtime/forest/instance_cache.h"

namespace lsys {

/// The part of the heroes' skeleton that an instance draws.
[[nodiscard]] Skeleton skeleton_of(const InstanceCache& cache, const Instance& instance);

} // namespace lsys
