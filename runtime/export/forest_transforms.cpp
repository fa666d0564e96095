// Transforms in the order of a file: cell by cell, group by group. A window of groups is filled in
// one walk over the trees of the cell; a group that is larger than a window takes a walk for each
// of its three arrays and no room at all.
#include "runtime/export/forest_formats.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::uint64_t kWindow = std::uint64_t{1} << 21; // instances: 80 MiB
constexpr std::size_t kFloats = kInstanceBytes / sizeof(float);

using Write = std::function<bool(std::span<const std::byte>)>;

class Transforms {
public:
    Transforms(const ForestPlan& plan, const Write& write)
        : plan_(plan), write_(write), place_(plan.uses().size(), kNone) {}

    void write_all() {
        for (const ForestCell& cell : plan_.cells()) {
            std::span<const ForestGroup> groups = plan_.groups_of(cell);
            while (!groups.empty() && !stopped_) {
                std::size_t some = 1;
                std::uint64_t count = groups[0].count;
                while (some < groups.size() && count + groups[some].count <= kWindow) {
                    count += groups[some++].count;
                }
                if (count > kWindow) {
                    write_large(cell, groups[0]);
                } else {
                    write_window(cell, groups.first(some), count);
                }
                groups = groups.subspan(some);
            }
        }
    }

private:
    void
    write_window(const ForestCell& cell, std::span<const ForestGroup> groups, std::uint64_t count) {
        floats_.resize(kFloats * count);
        next_.assign(groups.size(), 0);
        for (std::size_t g = 0; g < groups.size(); ++g) {
            place_[groups[g].instance] = static_cast<std::uint32_t>(g);
        }
        plan_.for_each_branch(cell, [&](const ForestKind& kind, std::uint32_t instance,
                                        const BranchInstance& branch) {
            const std::uint32_t g = place_[instance];
            if (g == kNone) {
                return;
            }
            const InstancePose pose = pose_of(branch, kind.cache->instances[branch.instance]);
            const ForestGroup& group = groups[g];
            const std::uint64_t i = next_[g]++;
            float* const base = floats_.data() + kFloats * (group.first - groups[0].first);
            put(pose, base + 3 * i, base + 3 * group.count + 4 * i, base + 7 * group.count + 3 * i);
        });
        for (const ForestGroup& group : groups) {
            place_[group.instance] = kNone;
        }
        hand_over(floats_);
    }

    void write_large(const ForestCell& cell, const ForestGroup& group) {
        for (int array = 0; array < 3 && !stopped_; ++array) {
            floats_.clear();
            plan_.for_each_branch(cell, [&](const ForestKind& kind, std::uint32_t instance,
                                            const BranchInstance& branch) {
                if (instance != group.instance || stopped_) {
                    return;
                }
                const InstancePose pose = pose_of(branch, kind.cache->instances[branch.instance]);
                std::array<float, 3> translation{};
                std::array<float, 4> rotation{};
                std::array<float, 3> scale{};
                put(pose, translation.data(), rotation.data(), scale.data());
                const auto append = [this](std::span<const float> values) {
                    floats_.insert(floats_.end(), values.begin(), values.end());
                };
                array == 0 ? append(translation) : array == 1 ? append(rotation) : append(scale);
                if (floats_.size() > kPieceBytes) {
                    hand_over(floats_);
                    floats_.clear();
                }
            });
            hand_over(floats_);
        }
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

    void hand_over(std::span<const float> floats) {
        stopped_ = stopped_ || !write_(std::as_bytes(floats));
    }

    const ForestPlan& plan_;
    const Write& write_;
    std::vector<std::uint32_t> place_; // of each instance among the groups of the window
    std::vector<std::uint64_t> next_;  // in each group of the window
    LargeVector<float> floats_;
    bool stopped_ = false;
};

} // namespace

void write_transforms(const ForestPlan& plan, const Write& write) {
    Transforms(plan, write).write_all();
}

} // namespace lsys
