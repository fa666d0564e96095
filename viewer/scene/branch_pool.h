// SPDX-License-Identifier: MIT
// BranchPool: branches of near trees in one array, of which the device has a copy. The branches of
// a tree are consecutive and stay in place until the pool forgets the tree.
#pragma once

#include "runtime/forest/instance_cache.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace lsys::view {

/// A branch in the layout of the device's copy.
struct PoolBranch {
    glm::vec3 position{}; // m, position of the hero's origin
    float scale = 1.0F;
    std::array<std::int16_t, 4> rotation{}; // x, y, z, w in 1/32767
    std::uint32_t mesh = 0;                 // instance in its form's cache
    std::uint32_t tree = 0;                 // number for ForestLod::lod_tree()

    /// Transforms a point of the hero, in m, to coordinates of the forest.
    [[nodiscard]] glm::vec3 at(const glm::vec3& place) const;
};
static_assert(sizeof(PoolBranch) == 32);
[[nodiscard]] PoolBranch
pool_branch(const BranchInstance& branch, const Instance& instance, std::uint32_t tree);

struct PoolSpan {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    friend bool operator==(const PoolSpan&, const PoolSpan&) = default;
};

class BranchPool {
public:
    /// `capacity`: max number of branches.
    explicit BranchPool(std::uint32_t capacity = kMaxBranches) : capacity_(capacity) {}

    /// The branches of a tree, which are marked as used in this frame. Count 0: the pool does not
    /// have the tree.
    [[nodiscard]] PoolSpan find(std::uint32_t tree);
    /// Stores the branches of a tree that the pool does not have, and marks them as used in this
    /// frame. If there is no room, removes branches that were not used in this frame. Count 0:
    /// there is still no room.
    [[nodiscard]] PoolSpan add(std::uint32_t tree, std::span<const PoolBranch> branches);
    /// Begins a frame and forgets trees whose branches were last used more than `kept` frames ago.
    void begin_frame(std::uint32_t kept);
    /// Forgets a tree that was removed or replaced by another tree.
    void forget(std::uint32_t tree);
    void clear(); // forgets all trees

    [[nodiscard]] std::span<const PoolBranch> branches() const { return branches_; }
    [[nodiscard]] std::size_t tree_count() const { return trees_.size(); }
    /// Number of branches in the pool.
    [[nodiscard]] std::uint64_t used_branches() const { return used_branches_; }
    /// Ranges that were written since the last call.
    [[nodiscard]] std::vector<PoolSpan> take_written();
    /// Range of each tree in the pool, by number of the tree.
    [[nodiscard]] std::map<std::uint32_t, PoolSpan> spans() const;

    static constexpr std::uint32_t kMaxBranches = 2U << 20U; // 64 MiB of PoolBranch

private:
    struct Entry {
        PoolSpan span;
        std::uint64_t last_use = 0; // number of the frame
    };

    void release(const PoolSpan& span); // makes a range free
    /// Takes a free range of `count` branches; returns false if there is none.
    bool allocate(std::uint32_t count, std::uint32_t& first);
    void forget_before(std::uint64_t frame); // trees that were last used before `frame`

    std::uint32_t capacity_;
    std::uint64_t frame_ = 0; // number of the current frame
    std::uint64_t used_branches_ = 0;
    std::vector<PoolBranch> branches_;
    std::unordered_map<std::uint32_t, Entry> trees_; // by number of the tree
    std::map<std::uint32_t, std::uint32_t>
        free_;                      // free ranges: first and count; adjacent ones are merged
    std::vector<PoolSpan> written_; // for take_written()
};

} // namespace lsys::view
