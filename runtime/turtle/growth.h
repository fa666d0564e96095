// SPDX-License-Identifier: MIT
// SkeletonGrowth: interpolates a plant between two generations. New parts grow from size 0, parts
// that are no longer drawn shrink to size 0, and other parts move from their old pose to the new
// one. Made by runtime/pipeline from drawings of two words whose modules were followed
// (Derivation::follow()).
//
// Pairs of old and new parts:
// - A module that is copied draws the same parts again: they correspond one to one.
// - A module that is rewritten corresponds to its successor. If both draw equally many segments
//   at equal bracket depths, these correspond one to one: F(l) -> F(l * r). If the module drew one
//   segment, the segments of the successor outside of inner brackets begin as pieces of this
//   segment, in proportion to their lengths: the first, third and fifth F of F -> F[+F]F[-F]F begin
//   on the old F and stretch. Other segments are new.
// - Objects of the same kind correspond in their order, and so do polygons.
//
// Poses are relative to the parent, so that joints stay closed while branches turn. Rotations take
// the shorter direction, by normalised linear interpolation, whose results are equal on all
// machines.
#pragma once

#include "runtime/derive/origin.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <memory>
#include <span>

namespace lsys {

struct GrowthCounts {
    std::uint64_t kept = 0;     // segments, objects and polygons that move from pose to pose
    std::uint64_t grown = 0;    // items that grow from size 0
    std::uint64_t vanished = 0; // items that shrink to size 0
    /// Polygons with fewer corners in the later drawing; the lost corners disappear at once.
    std::uint64_t polygons_with_fewer_corners = 0;
};

class SkeletonGrowth {
public:
    /// `before` and `after`: drawings with origins; Origin::place is the index of the module in the
    /// word of the drawing. `ancestors`: the origin of each module of the later word, after
    /// Derivation::follow(). May throw std::bad_alloc.
    SkeletonGrowth(Skeleton before,
                   Skeleton after,
                   std::uint32_t generation, // generation of `after`
                   std::span<const Origin> ancestors);
    ~SkeletonGrowth();
    SkeletonGrowth(SkeletonGrowth&&) noexcept;
    SkeletonGrowth& operator=(SkeletonGrowth&&) noexcept;

    /// Writes the plant at time `part`, 0 to 1, to `out`. 0 and 1 give exactly the skeletons before
    /// and after, without origins. In between, the segments of `after` come first, with its
    /// springs, masses, colours and sides; then the shrinking segments of `before`.
    void pose(double part, Skeleton& out) const;

    /// The two drawings between which the plant grows.
    [[nodiscard]] const Skeleton& before() const;
    [[nodiscard]] const Skeleton& after() const;
    /// Moves the later drawing out; the growth cannot be used afterwards.
    [[nodiscard]] Skeleton take_after();
    [[nodiscard]] const GrowthCounts& counts() const;
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
