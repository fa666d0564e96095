// SPDX-License-Identifier: MIT
#include "runtime/forest/tree_bounds.h"

#include "runtime/forest/instance_skeleton.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace lsys {

namespace {

/// Calls visit(slot) for each slot that trees can contain, after the calls for the slots at the
/// exits of its instances.
template <typename Visit>
void visit_slots(const InstanceCache& cache, const Visit& visit) {
    /// A slot whose exits are being followed.
    struct Open {
        std::uint32_t slot = 0;
        std::uint32_t variant = 0; // number of the instance in the slot
        std::uint32_t exit = 0;    // number of the exit of this instance to visit next
    };
    std::vector<bool> seen(cache.slots.size());
    std::vector<Open> path;
    const auto open = [&](std::uint32_t slot) {
        if (!seen[slot]) {
            seen[slot] = true;
            path.push_back({slot});
        }
    };
    if (!cache.slots.empty()) {
        open(0);
    }
    while (!path.empty()) {
        Open& at = path.back();
        const InstanceSlot& slot = cache.slots[at.slot];
        if (at.variant == slot.variant_count) {
            visit(at.slot);
            path.pop_back();
            continue;
        }
        const Instance& instance = cache.instances[cache.variants[slot.first_variant + at.variant]];
        if (at.exit == instance.exit_count) {
            at.exit = 0;
            ++at.variant;
        } else {
            open(cache.exits[instance.first_exit + at.exit++].slot);
        }
    }
}

} // namespace

std::vector<bool> reached_slots(const InstanceCache& cache) {
    std::vector<bool> reached(cache.slots.size());
    std::vector<std::uint32_t> pending;
    if (!cache.slots.empty()) {
        reached[0] = true;
        pending.push_back(0);
    }
    while (!pending.empty()) {
        const InstanceSlot& slot = cache.slots[pending.back()];
        pending.pop_back();
        for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
            const Instance& instance = cache.instances[cache.variants[slot.first_variant + v]];
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                const std::uint32_t next = cache.exits[instance.first_exit + e].slot;
                if (!reached[next]) {
                    reached[next] = true;
                    pending.push_back(next);
                }
            }
        }
    }
    return reached;
}

TreeBounds tree_bounds(const InstanceCache& cache, std::span<const double> own_reach) {
    TreeBounds bounds;
    bounds.reach.assign(cache.instances.size(), 0.0);
    bounds.deviation.assign(cache.instances.size(), 0.0);
    std::vector<double> reach_of_slot(cache.slots.size(), 0.0);
    std::vector<double> deviation_of_slot(cache.slots.size(), 0.0);
    visit_slots(cache, [&](std::uint32_t number) {
        const InstanceSlot& slot = cache.slots[number];
        for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
            const std::uint32_t i = cache.variants[slot.first_variant + v];
            const Instance& instance = cache.instances[i];
            bounds.reach[i] = own_reach[i];
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                const InstanceExit& exit = cache.exits[instance.first_exit + e];
                const auto distance = static_cast<double>(glm::length(exit.position));
                bounds.reach[i] = std::max(bounds.reach[i], distance + reach_of_slot[exit.slot]);
                bounds.deviation[i] = std::max(bounds.deviation[i], deviation_of_slot[exit.slot]);
            }
            reach_of_slot[number] = std::max(reach_of_slot[number], bounds.reach[i]);
        }
        // Every branch begins at the entry, so the distance of a point from another branch of the
        // slot is at most its distance from the entry.
        if (slot.variant_count == 1) {
            deviation_of_slot[number] = bounds.deviation[stand_in(cache, slot)];
        } else {
            deviation_of_slot[number] = reach_of_slot[number];
        }
    });
    return bounds;
}

} // namespace lsys
