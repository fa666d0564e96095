// SPDX-License-Identifier: MIT
// Transforms in the order of a file: cell by cell, group by group. One pass over the trees fills a
// window of consecutive groups; the pieces of their cells are distributed to threads. A group
// larger than the window is written without a window, by one pass for each of its three arrays.
#include "runtime/base/workers.h"
#include "runtime/export/impl/forest_formats.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::size_t kInstanceFloats = kInstanceBytes / sizeof(float);

using Write = std::function<bool(std::span<const std::byte>)>;
using Visit = std::function<void(std::span<const ForestGroup>, std::span<const float>)>;

/// Computes the transforms window by window.
class Transforms {
public:
    Transforms(const ForestPlan& plan,
               std::span<const ItemGrid> grids,
               const ForestExportInfo& info)
        : plan_(plan), grids_(grids), window_(info.window_bytes / kInstanceBytes),
          workers_(info.threads) {}

    void write_all(const Write& write) {
        for_each_window([&](std::size_t cell, std::size_t first, auto groups) {
            if (groups[0].count > window_) {
                write_large(plan_.cells()[cell], groups[0], write);
            } else {
                fill_window(cell, first, groups);
                pass_on(floats_, write);
            }
        });
    }

    void visit_all(const Visit& visit) {
        for_each_window([&](std::size_t cell, std::size_t first, auto groups) {
            fill_window(cell, first, groups);
            visit(groups, floats_);
        });
    }

private:
    /// Calls visit(cell, first, groups) for each window. `first`: number of its first group;
    /// `cell`: number of the cell of this group.
    template <typename Visitor>
    void for_each_window(const Visitor& visit) {
        std::size_t cell = 0;
        for (std::size_t first = 0; first < plan_.groups().size() && !stopped_;) {
            while (first >= end_of(plan_.cells()[cell])) {
                ++cell;
            }
            const std::span<const ForestGroup> groups = window_from(first);
            visit(cell, first, groups);
            first += groups.size();
        }
    }

    static std::size_t end_of(const ForestCell& cell) {
        return cell.first_group + cell.group_count;
    }

    /// The groups from number `first` on that fit into the window together; at least group `first`.
    [[nodiscard]] std::span<const ForestGroup> window_from(std::size_t first) const {
        const std::span<const ForestGroup> groups = plan_.groups().subspan(first);
        std::size_t count = 1;
        while (count < groups.size() &&
               groups[count].first + groups[count].count - groups[0].first <= window_) {
            ++count;
        }
        return groups.first(count);
    }

    /// Computes the transforms of `groups`. `first` and `cell`: as in for_each_window().
    void fill_window(std::size_t cell, std::size_t first, std::span<const ForestGroup> groups) {
        const std::size_t end = first + groups.size();
        std::vector<std::pair<const ForestCell*, const ForestPiece*>> pieces;
        for (; cell < plan_.cells().size() && plan_.cells()[cell].first_group < end; ++cell) {
            for (const ForestPiece& piece : plan_.pieces_of(plan_.cells()[cell])) {
                pieces.emplace_back(&plan_.cells()[cell], &piece);
            }
        }
        floats_.resize(kInstanceFloats *
                       (groups.back().first + groups.back().count - groups[0].first));
        workers_.for_each(pieces.size(), [&](std::uint64_t number) {
            const auto& [owner, piece] = pieces[number];
            const std::size_t from = std::max(first, owner->first_group);
            const std::size_t to = std::min(end, end_of(*owner));
            fill(plan_.groups().subspan(from, to - from), *piece, groups[0].first);
        });
    }

    /// Puts the instances of a piece that are in `groups`, all of one cell, into the window that
    /// begins with instance `begin`.
    void fill(std::span<const ForestGroup> groups, const ForestPiece& piece, std::uint64_t begin) {
        struct Place {
            float* base = nullptr;   // of the group; null: outside of the window
            std::uint64_t count = 0; // number of instances of the group
            std::uint64_t next = 0;  // number of the next instance in the group
        };
        std::vector<Place> places(plan_.instance_counts().size());
        auto group = groups.begin();
        for (const auto& [instance, before] : piece.counts_before) {
            while (group != groups.end() && group->instance < instance) {
                ++group;
            }
            if (group != groups.end() && group->instance == instance) {
                places[instance] = {floats_.data() + kInstanceFloats * (group->first - begin),
                                    group->count, before};
            }
        }
        plan_.for_each_branch(piece, [&](const ExportedStage& stage, std::uint32_t instance,
                                         const BranchInstance& branch) {
            Place& place = places[instance];
            if (place.base == nullptr) {
                return;
            }
            const std::uint64_t i = place.next++;
            put(pose(stage, branch), place.base + 3 * i, place.base + 3 * place.count + 4 * i,
                place.base + 7 * place.count + 3 * i);
        });
    }

    void write_large(const ForestCell& cell, const ForestGroup& group, const Write& write) {
        for (int array = 0; array < 3 && !stopped_; ++array) {
            floats_.clear();
            plan_.for_each_branch(cell, [&](const ExportedStage& stage, std::uint32_t instance,
                                            const BranchInstance& branch) {
                if (instance != group.instance || stopped_) {
                    return;
                }
                std::array<float, 3> translation{};
                std::array<float, 4> rotation{};
                std::array<float, 3> scale{};
                put(pose(stage, branch), translation.data(), rotation.data(), scale.data());
                const auto append = [this](std::span<const float> values) {
                    floats_.insert(floats_.end(), values.begin(), values.end());
                };
                array == 0 ? append(translation) : array == 1 ? append(rotation) : append(scale);
                if (floats_.size() * sizeof(float) > kPieceBytes) {
                    pass_on(floats_, write);
                    floats_.clear();
                }
            });
            pass_on(floats_, write);
        }
    }

    [[nodiscard]] InstancePose pose(const ExportedStage& stage,
                                    const BranchInstance& branch) const {
        const auto number = static_cast<std::size_t>(&stage - plan_.stages().data());
        return pose_of_items(pose_of(branch, stage.cache->instances[branch.instance]),
                             grids_[number]);
    }

    static void put(const InstancePose& pose, float* translation, float* rotation, float* scale) {
        for (int k = 0; k < 3; ++k) {
            translation[k] = pose.translation[k];
            scale[k] = pose.scale;
        }
        rotation[0] = pose.rotation.x;
        rotation[1] = pose.rotation.y;
        rotation[2] = pose.rotation.z;
        rotation[3] = pose.rotation.w;
    }

    void pass_on(std::span<const float> floats, const Write& write) {
        stopped_ = stopped_ || !write(std::as_bytes(floats));
    }

    const ForestPlan& plan_;
    std::span<const ItemGrid> grids_;
    std::uint64_t window_; // max count of instances
    Workers workers_;
    LargeVector<float> floats_; // of the window
    bool stopped_ = false;      // a call of write() has returned false
};

} // namespace

InstancePose pose_of_items(const InstancePose& pose, const ItemGrid& grid) {
    if (grid.step == 1.0F && grid.low == glm::vec3(0.0F)) {
        return pose;
    }
    InstancePose moved = pose;
    const double scale = static_cast<double>(pose.scale);
    moved.translation = glm::vec3(glm::dvec3(pose.translation) +
                                  glm::dquat(pose.rotation) * (scale * glm::dvec3(grid.low)));
    moved.scale = static_cast<float>(scale * static_cast<double>(grid.step));
    return moved;
}

void write_transforms(const ForestPlan& plan,
                      std::span<const ItemGrid> grids,
                      const ForestExportInfo& info,
                      const Write& write) {
    Transforms(plan, grids, info).write_all(write);
}

void for_each_transform_window(const ForestPlan& plan,
                               std::span<const ItemGrid> grids,
                               const ForestExportInfo& info,
                               const Visit& visit) {
    Transforms(plan, grids, info).visit_all(visit);
}

} // namespace lsys
