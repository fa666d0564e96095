// SPDX-License-Identifier: MIT
#include "viewer/scene/branch_pool.h"

#include "runtime/forest/instance_meshes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace lsys::view {

PoolBranch pool_branch(const BranchInstance& branch, const Instance& instance, std::uint32_t tree) {
    const InstancePose pose = pose_of(branch, instance);
    PoolBranch packed;
    packed.position = pose.translation;
    packed.scale = pose.scale;
    const std::array<float, 4> parts = {pose.rotation.x, pose.rotation.y, pose.rotation.z,
                                        pose.rotation.w};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        packed.rotation[i] =
            static_cast<std::int16_t>(std::lround(std::clamp(parts[i], -1.0F, 1.0F) * 32767.0F));
    }
    packed.mesh = branch.instance;
    packed.tree = tree;
    return packed;
}

glm::vec3 PoolBranch::at(const glm::vec3& place) const {
    const glm::quat turn(static_cast<float>(rotation[3]), static_cast<float>(rotation[0]),
                         static_cast<float>(rotation[1]), static_cast<float>(rotation[2]));
    return position + glm::normalize(turn) * (scale * place);
}

PoolSpan BranchPool::find(std::uint32_t tree) {
    const auto entry = trees_.find(tree);
    if (entry == trees_.end()) {
        return {};
    }
    entry->second.last_use = frame_;
    return entry->second.span;
}

PoolSpan BranchPool::add(std::uint32_t tree, std::span<const PoolBranch> branches) {
    const auto count = static_cast<std::uint32_t>(branches.size());
    if (branches.empty() || branches.size() > capacity_) {
        return {};
    }
    PoolSpan span{0, count};
    if (!allocate(count, span.first)) {
        forget_before(frame_);
        if (!allocate(count, span.first)) {
            return {};
        }
    }
    std::copy(branches.begin(), branches.end(),
              branches_.begin() + static_cast<std::ptrdiff_t>(span.first));
    trees_.emplace(tree, Entry{span, frame_});
    used_branches_ += count;
    if (!written_.empty() && written_.back().first + written_.back().count == span.first) {
        written_.back().count += count;
    } else {
        written_.push_back(span);
    }
    return span;
}

void BranchPool::begin_frame(std::uint32_t kept) {
    ++frame_;
    forget_before(frame_ > kept ? frame_ - kept : 0);
}

void BranchPool::forget(std::uint32_t tree) {
    if (const auto entry = trees_.find(tree); entry != trees_.end()) {
        release(entry->second.span);
        trees_.erase(entry);
    }
}

void BranchPool::clear() {
    *this = BranchPool(capacity_);
}

std::vector<PoolSpan> BranchPool::take_written() {
    return std::exchange(written_, {});
}

std::map<std::uint32_t, PoolSpan> BranchPool::spans() const {
    std::map<std::uint32_t, PoolSpan> spans;
    for (const auto& [tree, entry] : trees_) {
        spans.emplace(tree, entry.span);
    }
    return spans;
}

void BranchPool::release(const PoolSpan& span) {
    used_branches_ -= span.count;
    auto at = free_.emplace(span.first, span.count).first;
    if (const auto next = std::next(at);
        next != free_.end() && at->first + at->second == next->first) {
        at->second += next->second;
        free_.erase(next);
    }
    if (at != free_.begin()) {
        const auto before = std::prev(at);
        if (before->first + before->second == at->first) {
            before->second += at->second;
            free_.erase(at);
        }
    }
}

bool BranchPool::allocate(std::uint32_t count, std::uint32_t& first) {
    for (auto room = free_.begin(); room != free_.end(); ++room) {
        if (room->second >= count) {
            first = room->first;
            const std::uint32_t left = room->second - count;
            free_.erase(room);
            if (left != 0) {
                free_.emplace(first + count, left);
            }
            return true;
        }
    }
    // Allocates at the end of the array; a free range at the end becomes part of the new range.
    first = static_cast<std::uint32_t>(branches_.size());
    const auto last = free_.empty() ? free_.end() : std::prev(free_.end());
    const bool free_end = last != free_.end() && last->first + last->second == first;
    if (free_end) {
        first = last->first;
    }
    if (count > capacity_ - first) {
        return false;
    }
    if (free_end) {
        free_.erase(last);
    }
    branches_.resize(std::size_t{first} + count);
    return true;
}

void BranchPool::forget_before(std::uint64_t frame) {
    for (auto entry = trees_.begin(); entry != trees_.end();) {
        if (entry->second.last_use < frame) {
            release(entry->second.span);
            entry = trees_.erase(entry);
        } else {
            ++entry;
        }
    }
}

} // namespace lsys::view
