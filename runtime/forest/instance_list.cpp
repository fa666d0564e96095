// SPDX-License-Identifier: MIT
#include "runtime/forest/instance_list.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/forest/instance_meshes.h"

#include <span>

namespace lsys {

namespace {

/// Numbers the instances of all caches; the instances of one cache have consecutive numbers.
class GroupNumbers {
public:
    explicit GroupNumbers(const Forest& forest) : forest_(forest) {
        for (const ForestSpecies& species : forest.species) {
            first_.emplace_back();
            for (const ForestStage& stage : species.stages) {
                first_.back().push_back(count_);
                count_ += stage.cache.instances.size();
            }
        }
    }

    [[nodiscard]] std::uint64_t count() const { return count_; }
    /// Number of the first instance in the cache of the tree.
    [[nodiscard]] std::uint64_t first_of(const Tree& tree) const {
        return first_[tree.species][forest_.stage_of(tree)];
    }

private:
    const Forest& forest_;
    /// Number of the first instance of each cache, by species and stage.
    std::vector<std::vector<std::uint64_t>> first_;
    std::uint64_t count_ = 0;
};

/// Calls visit(tree, cache, first, expander) for each of `trees`, with the cache of the tree and
/// the number of the first instance in this cache.
template <typename Visit>
void visit_trees(const Forest& forest,
                 const GroupNumbers& numbers,
                 std::span<const Tree> trees,
                 const Visit& visit) {
    const InstanceCache* last = nullptr;
    std::optional<TreeExpander> expander;
    for (const Tree& tree : trees) {
        const InstanceCache& cache = forest.cache_of(tree);
        if (&cache != last) {
            expander.emplace(cache, forest.key);
            last = &cache;
        }
        visit(tree, cache, numbers.first_of(tree), *expander);
    }
}

std::optional<Stop>
make_list(const Forest& forest, const InstanceListOptions& options, InstanceList& list) {
    const auto is_cancelled = [&options] {
        return options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed);
    };
    const GroupNumbers numbers(forest);
    // By piece and instance number (GroupNumbers): first the count of instances, later the index in
    // list.instances for the next instance with this number.
    std::vector<std::vector<std::uint64_t>> places(piece_count(forest));
    for_each_piece(forest, options.threads, [&](std::uint64_t piece, std::span<const Tree> trees) {
        if (is_cancelled()) {
            return;
        }
        std::vector<std::uint64_t>& counts = places[piece];
        counts.resize(numbers.count());
        visit_trees(forest, numbers, trees,
                    [&](const Tree& tree, const InstanceCache& /*cache*/, std::uint64_t first,
                        TreeExpander& expander) {
                        expander.expand_instances(
                            tree, [&](std::uint32_t instance) { ++counts[first + instance]; });
                    });
    });
    if (is_cancelled()) {
        return Stop::Cancelled;
    }
    std::uint64_t total = 0;
    std::uint64_t number = 0;
    std::vector<std::uint32_t> groups(numbers.count());
    for (std::uint32_t s = 0; s < forest.species.size(); ++s) {
        for (std::uint32_t stage = 0; stage < forest.species[s].stages.size(); ++stage) {
            const InstanceCache& cache = forest.species[s].stages[stage].cache;
            for (std::uint32_t i = 0; i < cache.instances.size(); ++i, ++number) {
                const std::uint64_t first = total;
                for (std::vector<std::uint64_t>& piece : places) {
                    const std::uint64_t count = piece[number];
                    piece[number] = total;
                    total += count;
                }
                if (total != first) {
                    groups[number] = static_cast<std::uint32_t>(list.groups.size());
                    list.groups.push_back({s, stage, i, first, total - first});
                }
            }
        }
    }
    if (total > options.max_bytes / sizeof(ForestInstance)) {
        return Stop::Limit;
    }
    list.instances.resize(total);
    for_each_piece(forest, options.threads, [&](std::uint64_t piece, std::span<const Tree> trees) {
        if (is_cancelled()) {
            return;
        }
        std::vector<std::uint64_t>& next = places[piece];
        visit_trees(forest, numbers, trees,
                    [&](const Tree& tree, const InstanceCache& cache, std::uint64_t first,
                        TreeExpander& expander) {
                        const auto index = static_cast<std::uint32_t>(&tree - forest.trees.data());
                        expander.expand(tree, [&](const BranchInstance& branch) {
                            const std::uint64_t at = first + branch.instance;
                            const InstancePose pose =
                                pose_of(branch, cache.instances[branch.instance]);
                            list.instances[next[at]++] = {pose.translation, pose.scale,
                                                          pose.rotation, index, groups[at]};
                        });
                    });
    });
    return is_cancelled() ? std::optional(Stop::Cancelled) : std::nullopt;
}

} // namespace

std::optional<Stop>
make_instance_list(const Forest& forest, const InstanceListOptions& options, InstanceList& list) {
    list = {};
    return catch_out_of_memory([&] { return make_list(forest, options, list); },
                               []() -> std::optional<Stop> { return Stop::OutOfMemory; });
}

} // namespace lsys
