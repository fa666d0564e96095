// SPDX-License-Identifier: MIT
#include "runtime/placement/impl/tree_maker.h"

#include "runtime/placement/impl/draws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

constexpr float kTurn = 6.28318531F;
constexpr std::uint64_t kPiecesAtOnce = 8; // per worker

bool lives_everywhere(const PlacementSpecies& species) {
    return std::isinf(species.lowest) && std::isinf(species.highest) &&
           std::isinf(species.steepest);
}

bool fits(const PlacementSpecies& species, float height, float slope) {
    return height >= species.lowest && height <= species.highest && slope <= species.steepest;
}

} // namespace

TreeMaker::TreeMaker(const PlacementOptions& options, const Terrain& terrain)
    : options_(options), terrain_(terrain) {
    for (const PlacementSpecies& species : options.species) {
        total_share_ += species.share;
        has_limits_ = has_limits_ || !lives_everywhere(species);
        has_steepest_ = has_steepest_ || !std::isinf(species.steepest);
    }
}

std::uint32_t TreeMaker::choose_species(std::uint32_t word, float x, float height, float z) const {
    const std::vector<PlacementSpecies>& species = options_.species;
    const float slope = has_steepest_ ? terrain_.slope(x, z) : 0.0F;
    double shares = total_share_;
    if (has_limits_) {
        shares = 0.0;
        for (const PlacementSpecies& each : species) {
            shares += fits(each, height, slope) ? each.share : 0.0;
        }
    }
    double left = unit(word) * shares;
    std::uint32_t last = kNoSpecies; // the result if rounding leaves `left` at 0 or above
    for (std::size_t i = 0; i < species.size(); ++i) {
        if (species[i].share <= 0.0 || (has_limits_ && !fits(species[i], height, slope))) {
            continue;
        }
        last = static_cast<std::uint32_t>(i);
        left -= species[i].share;
        if (left < 0.0) {
            break;
        }
    }
    return last;
}

Tree TreeMaker::make_appearance(std::uint32_t number,
                                std::uint16_t species,
                                const PhiloxBlock& words) const {
    const PlacementSpecies& kind = options_.species[species];
    Tree tree;
    tree.yaw = kTurn * unit_interval(words[1]);
    const bool has_height = kind.max_height > 0.0F;
    tree.scale =
        draw_in_range(has_height ? kind.min_height : kind.min_scale,
                      has_height ? kind.max_height : kind.max_scale, unit_interval(words[2]));
    tree.number = number;
    tree.species = species;
    if (kind.stages > 1) {
        constexpr auto kYears = static_cast<std::uint64_t>(kYearsPerStage);
        const std::uint64_t last = kind.stages - 1;
        const std::uint64_t stage = std::min<std::uint64_t>(
            start_of(number, species) + std::uint64_t{options_.stages_passed}, last);
        tree.age = static_cast<std::uint16_t>(kYears * stage + 1);
    }
    return tree;
}

std::uint32_t TreeMaker::start_of(std::uint32_t number, std::uint16_t species) const {
    const PlacementSpecies& kind = options_.species[species];
    return kind.stages <= 1 || kind.start == StageStart::First
               ? 0
               : number_below(placement_draws(options_.key, number, kLifeBlock)[1], kind.stages);
}

Tree TreeMaker::appearance_of(std::uint32_t number, std::uint16_t species) const {
    return make_appearance(number, species,
                           placement_draws(options_.key, number, kAppearanceBlock));
}

void TreeMaker::make(std::uint32_t number, float x, float z, TreeChunk& chunk) const {
    ++chunk.places;
    const PhiloxBlock words = placement_draws(options_.key, number, kAppearanceBlock);
    const float height = terrain_.height(x, z);
    const std::uint32_t species = choose_species(words[0], x, height, z);
    if (species == kNoSpecies) {
        ++chunk.refused;
        return;
    }
    Tree tree = make_appearance(number, static_cast<std::uint16_t>(species), words);
    tree.position = {x, height, z};
    chunk.trees.push_back(tree);
}

void TreeMaker::shares_at(float x, float z, std::span<double> shares) const {
    const float height = has_limits_ ? terrain_.height(x, z) : 0.0F;
    const float slope = has_steepest_ ? terrain_.slope(x, z) : 0.0F;
    double sum = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const PlacementSpecies& species = options_.species[i];
        shares[i] = !has_limits_ || fits(species, height, slope) ? species.share : 0.0;
        sum += shares[i];
    }
    for (double& share : shares) {
        share = sum > 0.0 ? share / sum : 0.0;
    }
}

bool TreeMaker::can_live(std::uint16_t species, float x, float z) const {
    const PlacementSpecies& kind = options_.species[species];
    return !has_limits_ || lives_everywhere(kind) ||
           fits(kind, terrain_.height(x, z), has_steepest_ ? terrain_.slope(x, z) : 0.0F);
}

void collect_trees(Workers& workers,
                   std::uint64_t pieces,
                   const std::function<void(std::uint64_t, TreeChunk&)>& piece,
                   Placement& placement) {
    std::vector<TreeChunk> chunks(std::min(pieces, kPiecesAtOnce * workers.count()));
    for (std::uint64_t first = 0; first < pieces; first += chunks.size()) {
        const std::uint64_t count = std::min<std::uint64_t>(chunks.size(), pieces - first);
        workers.for_each(count, [&](std::uint64_t i) {
            chunks[i].trees.clear();
            chunks[i].places = 0;
            chunks[i].refused = 0;
            piece(first + i, chunks[i]);
        });
        for (std::uint64_t i = 0; i < count; ++i) {
            placement.trees.insert(placement.trees.end(), chunks[i].trees.begin(),
                                   chunks[i].trees.end());
            placement.report.places += chunks[i].places;
            placement.report.refused += chunks[i].refused;
        }
    }
}

} // namespace lsys
