// SkeletonGrowth: a plant between two generations, as a function of the time between them. What the
// later generation writes grows from nothing, what it no longer draws shrinks to nothing, and the
// rest moves from its old pose to the new one. Made by runtime/pipeline from drawings of two words
// whose modules were followed (Derivation::follow()).
//
// Which segment becomes which:
// - A module that is copied draws the same again: its parts correspond one to one.
// - A module that is rewritten corresponds to its successor. If both draw equally many segments
//   with equal brackets, these correspond one to one: F(l) -> F(l * r). If it drew one, the
//   segments of the successor outside of inner brackets, one after another, begin as pieces of it,
//   by their lengths: the three F of F -> F[+F]F[-F]F lie on the old F and stretch from there.
//   Other segments are new.
// - Objects correspond in their order if they are of one kind, polygons in their order.
//
// Poses are relative to the parent, so that joints stay closed while branches turn. Turns take the
// shorter way (normalised linear interpolation, which needs no function that differs between
// machines).
#pragma once

#include "runtime/derive/origin.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <memory>
#include <span>

namespace lsys {

struct GrowthCounts {
    std::uint64_t kept = 0;  // segments, objects and polygons that move from pose to pose
    std::uint64_t grown = 0; // that grow from nothing
    std::uint64_t gone = 0;  // that shrink to nothing
    /// Polygons that have fewer corners afterwards, and lose them at once.
    std::uint64_t sharp = 0;
};

class SkeletonGrowth {
public:
    /// `before` and `after`: drawings with origins, whose places are indexes of modules in their
    /// words. `ancestors`: of each module of the later word, its followed origin. May throw
    /// std::bad_alloc.
    SkeletonGrowth(Skeleton before,
                   Skeleton after,
                   std::uint32_t generation, // of `after`
                   std::span<const Origin> ancestors);
    ~SkeletonGrowth();
    SkeletonGrowth(SkeletonGrowth&&) noexcept;
    SkeletonGrowth& operator=(SkeletonGrowth&&) noexcept;

    /// Writes the plant at `part` of the way, 0 to 1, to `out`. 0 and 1 give exactly the skeletons
    /// before and after, without origins. Between them the segments of `after` come first, with its
    /// springs, masses, colours and sides, then what shrinks.
    void pose(double part, Skeleton& out) const;

    [[nodiscard]] const Skeleton& before() const;
    [[nodiscard]] const Skeleton& after() const;
    /// Gives the later drawing away; the growth is then of no use.
    [[nodiscard]] Skeleton take_after();
    [[nodiscard]] const GrowthCounts& counts() const;
    [[nodiscard]] std::uint64_t byte_count() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
