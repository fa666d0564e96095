// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tile_digest.h"

#include "grammar/base/hash.h"

namespace lsys {

namespace {

std::uint64_t combine_place(std::uint64_t state, const glm::dquat& turn, const glm::dvec3& at) {
    return combine_numbers(state, turn.x, turn.y, turn.z, turn.w, at.x, at.y, at.z);
}

std::uint64_t combine_box(std::uint64_t state, const Bounds& box) {
    return combine_numbers(state, box.low.x, box.low.y, box.low.z, box.high.x, box.high.y,
                           box.high.z);
}

} // namespace

// Structured bindings list all members, so that a new member which a hash lacks does not compile.

std::uint64_t combine_plan(std::uint64_t state, const LevelPlan& plan) {
    const auto& [levels, first_tree_level, cells, skirts, details, canopy_levels] = plan;
    state = combine_numbers(state, first_tree_level, levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto& [side, error, has_content, has_trees, trees, triangles] = levels[i];
        static_cast<void>(trees);
        static_cast<void>(triangles);
        state = combine_numbers(state, side, error, has_content, has_trees, cells[i], skirts[i]);
        const auto& [detail, is_whole] = details[i];
        for (const std::size_t number : detail) {
            state = combine(state, number);
        }
        for (const bool whole : is_whole) {
            state = combine_numbers(state, whole);
        }
    }
    for (const std::size_t level : canopy_levels) {
        state = combine(state, level);
    }
    return state;
}

std::uint64_t combine_hero(std::uint64_t state, const Hero& hero) {
    state = combine_numbers(state, hero.species, hero.stage, hero.instance, hero.ends_at_exits,
                            hero.reach, hero.levels.levels.size());
    return combine_box(state, hero.bounds);
}

std::uint64_t combine_assembly(std::uint64_t state, const InstanceCache& cache) {
    for (const InstanceSlot& slot : cache.slots) {
        state = combine_numbers(state, slot.first_variant, slot.variant_count);
    }
    for (const std::uint32_t variant : cache.variants) {
        state = combine(state, variant);
    }
    for (const Instance& instance : cache.instances) {
        state = combine_numbers(state, instance.slot, instance.first_exit, instance.exit_count,
                                instance.order);
        state = combine_place(state, instance.frame, instance.position);
    }
    for (const InstanceExit& exit : cache.exits) {
        state = combine_numbers(state, exit.slot, exit.order);
        state = combine_place(state, glm::dquat(exit.rotation), glm::dvec3(exit.position));
    }
    return state;
}

std::uint64_t combine_heights(std::uint64_t state, const HeightTable& table) {
    const auto& [boxes, whole, min_height] = table;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        state = combine_box(combine_numbers(state, whole[i].value_or(-1.0)), boxes[i]);
    }
    return combine_numbers(state, min_height);
}

std::uint64_t combine_ground(std::uint64_t state, const GroundPictures& ground) {
    const auto& [colour, normals, origin_x, origin_z, width, depth] = ground;
    static_cast<void>(normals); // tiles have no normal map
    return combine_numbers(state, colour != nullptr, origin_x, origin_z, width, depth);
}

} // namespace lsys
