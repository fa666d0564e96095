// BranchPool: the branches of trees that are near, in one array of places that the device has a
// copy of. A tree's branches lie side by side and stay where they are until it is forgotten.
#pragma once

#include "runtime/forest/instance_cache.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace lsys::view {

/// A branch as the device reads it.
struct PoolBranch {
    glm::vec3 position{}; // m, of the heroes' origin
    float scale = 1.0F;
    std::array<std::int16_t, 4> rotation{}; // x, y, z, w in 1/32767
    std::uint32_t mesh = 0;                 // instance in its form's cache
    std::uint32_t tree = 0;                 // in ForestLod::trees()

    /// Where the branch has a place of its hero.
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
    /// Most branches at a time.
    explicit BranchPool(std::uint32_t capacity = kMaxBranches) : capacity_(capacity) {}

    /// The branches of a tree that are there; count 0: none. They are in use for the current turn.
    [[nodiscard]] PoolSpan find(std::uint32_t tree);
    /// Places for the branches of a tree that has none, in use for the current turn. Count 0: there
    /// is no room, even without those that are not in use.
    [[nodiscard]] PoolSpan add(std::uint32_t tree, std::span<const PoolBranch> branches);
    /// Begins a turn; forgets what was in use last more than `kept` turns ago.
    void begin_frame(std::uint32_t kept);
    /// A tree is another one now, or gone.
    void forget(std::uint32_t tree);
    void clear();

    [[nodiscard]] std::span<const PoolBranch> branches() const { return branches_; }
    [[nodiscard]] std::size_t tree_count() const { return trees_.size(); }
    [[nodiscard]] std::uint64_t used() const { return used_; }
    /// Places that were written since the last take_written().
    [[nodiscard]] std::vector<PoolSpan> take_written();
    /// Those in use or kept, by tree.
    [[nodiscard]] std::map<std::uint32_t, PoolSpan> spans() const;

    static constexpr std::uint32_t kMaxBranches = 2U << 20U; // 64 MiB

private:
    struct Entry {
        PoolSpan span;
        std::uint64_t last_use = 0; // frame
    };

    void release(const PoolSpan& span);
    bool allocate(std::uint32_t count, std::uint32_t& first);
    void forget_before(std::uint64_t frame);

    std::uint32_t capacity_;
    std::uint64_t frame_ = 0;
    std::uint64_t used_ = 0;
    std::vector<PoolBranch> branches_;
    std::unordered_map<std::uint32_t, Entry> trees_;
    std::map<std::uint32_t, std::uint32_t> free_; // first and count; neighbours are joined
    std::vector<PoolSpan> written_;
};

} // namespace lsys::view
