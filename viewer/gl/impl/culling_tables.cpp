// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/culling_tables.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace lsys::view {

namespace {

// Sizes and offsets in words of the records of a form; also in shaders/culling_tables.glsl.
constexpr std::size_t kFormWords = 32;
constexpr std::size_t kInstanceWords = 16;
constexpr std::size_t kExitWords = 8;
constexpr std::size_t kTriangles = 9;
constexpr std::size_t kFirstKey = 13;
constexpr std::size_t kInstances = 14;
constexpr std::size_t kSlotsAt = 15;
constexpr std::size_t kInstancesAt = 16;
constexpr std::size_t kExitsAt = 17;

/// Max depth of nested instances, and max number of instances, of a branch that fills a slot.
struct SlotSize {
    std::uint32_t depth = 0;
    std::uint64_t branches = 0;
};

constexpr std::uint64_t kMostBranches = std::numeric_limits<std::uint32_t>::max();

SlotSize size_from_exits(const InstanceCache& cache,
                         const InstanceSlot& slot,
                         const std::vector<SlotSize>& sizes) {
    SlotSize size;
    for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
        const Instance& instance = cache.instances[cache.variants[slot.first_variant + v]];
        SlotSize one{1, 1};
        for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
            const SlotSize& next = sizes[cache.exits[instance.first_exit + e].slot];
            one.depth = std::max(one.depth, next.depth + 1);
            one.branches = std::min(one.branches + next.branches, kMostBranches);
        }
        size.depth = std::max(size.depth, one.depth);
        size.branches = std::max(size.branches, one.branches);
    }
    return size;
}

/// SlotSize of slot 0, which whole plants fill.
SlotSize size_of_plants(const InstanceCache& cache) {
    std::vector<SlotSize> sizes(cache.slots.size());
    std::vector<bool> begun(cache.slots.size());
    // Each item is a slot, and whether the sizes of the slots at the exits of its instances are
    // known.
    std::vector<std::pair<std::uint32_t, bool>> pending{{0, false}};
    while (!pending.empty()) {
        const auto [index, is_known] = pending.back();
        pending.pop_back();
        const InstanceSlot& slot = cache.slots[index];
        if (is_known) {
            sizes[index] = size_from_exits(cache, slot, sizes);
            continue;
        }
        if (begun[index]) {
            continue;
        }
        begun[index] = true;
        pending.emplace_back(index, true);
        for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
            const Instance& instance = cache.instances[cache.variants[slot.first_variant + v]];
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                pending.emplace_back(cache.exits[instance.first_exit + e].slot, false);
            }
        }
    }
    return sizes[0];
}

class Words {
public:
    explicit Words(std::vector<std::uint32_t>& words) : words_(words) {}
    void add(std::uint32_t value) { words_.push_back(value); }
    void add(float value) { words_.push_back(std::bit_cast<std::uint32_t>(value)); }
    void add(const glm::vec3& value) {
        for (const float part : {value.x, value.y, value.z}) {
            add(part);
        }
    }
    void add(const glm::quat& value) {
        for (const float part : {value.x, value.y, value.z, value.w}) {
            add(part);
        }
    }
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(words_.size()); }

private:
    std::vector<std::uint32_t>& words_;
};

void add_form(const TreeForm& form, std::size_t index, CullingTables& tables) {
    const InstanceCache& cache = *form.cache;
    const std::array<float, 9> sizes = {
        form.sphere.centre.x,
        form.sphere.centre.y,
        form.sphere.centre.z,
        form.sphere.radius,
        form.height(),
        form.low,
        form.high,
        std::hypot(form.radius, 0.5F * form.height()),
        glm::length(form.sphere.centre) + form.sphere.radius,
    };
    const std::size_t at = kFormWords * index;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        tables.words[at + i] = std::bit_cast<std::uint32_t>(sizes[i]);
    }
    for (std::uint32_t level = 0; level < kTreeLevels; ++level) {
        tables.words[at + kTriangles + level] = form.triangle_count(level);
    }
    tables.words[at + kFirstKey] = tables.first_keys[index];
    tables.words[at + kInstances] = static_cast<std::uint32_t>(cache.instances.size());
    Words words(tables.words);
    const std::uint32_t variants = words.size();
    for (const std::uint32_t variant : cache.variants) {
        words.add(variant);
    }
    tables.words[at + kSlotsAt] = words.size();
    for (const InstanceSlot& slot : cache.slots) {
        words.add(variants + slot.first_variant);
        words.add(slot.variant_count);
    }
    tables.words[at + kInstancesAt] = words.size();
    for (std::size_t i = 0; i < cache.instances.size(); ++i) {
        const Instance& instance = cache.instances[i];
        const std::uint32_t end = words.size() + kInstanceWords;
        words.add(glm::quat(glm::conjugate(instance.frame)));
        words.add(glm::vec3(instance.position));
        words.add(instance.first_exit);
        words.add(instance.exit_count);
        words.add(form.mesh_spheres[i].centre);
        words.add(form.mesh_spheres[i].radius);
        while (words.size() < end) {
            words.add(0U);
        }
    }
    tables.words[at + kExitsAt] = words.size();
    for (const InstanceExit& exit : cache.exits) {
        static_assert(kExitWords == 8);
        words.add(exit.rotation);
        words.add(exit.position);
        words.add(exit.slot);
    }
}

} // namespace

std::optional<CullingTables> make_culling_tables(const ForestModel& model) {
    CullingTables tables;
    std::uint64_t most = 0;
    for (const TreeForm& form : model.forms) {
        const SlotSize size = size_of_plants(*form.cache);
        if (size.depth > kMaxWalkDepth) {
            return std::nullopt;
        }
        most = std::max(most, size.branches);
        tables.first_keys.push_back(tables.key_count);
        tables.key_count +=
            kBranchGroups * static_cast<std::uint32_t>(form.cache->instances.size());
    }
    tables.max_branches = static_cast<std::uint32_t>(most);
    tables.words.resize(kFormWords * model.forms.size());
    for (std::size_t f = 0; f < model.forms.size(); ++f) {
        add_form(model.forms[f], f, tables);
    }
    return tables;
}

} // namespace lsys::view
