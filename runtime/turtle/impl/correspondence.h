// SPDX-License-Identifier: MIT
// Correspondence between the drawings of two consecutive generations; growth.h has the rules.
#pragma once

#include "runtime/derive/origin.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// A piece of a segment of the earlier drawing; `low` and `high` are fractions of its length.
struct SegmentPiece {
    std::uint32_t segment = kNoSegment;
    float low = 0.0F;
    float high = 1.0F;
};

/// For each item of the later drawing, the item of the earlier drawing that it continues; kNone or
/// kNoSegment for a new item.
struct Correspondence {
    std::vector<SegmentPiece> pieces; // by segment; pieces of one segment follow each other
    std::vector<std::uint32_t> objects;
    std::vector<std::uint32_t> polygons;
};

/// See SkeletonGrowth for the arguments.
[[nodiscard]] Correspondence find_correspondence(const Skeleton& before,
                                                 const Skeleton& after,
                                                 std::uint32_t generation,
                                                 std::span<const Origin> ancestors);

} // namespace lsys
