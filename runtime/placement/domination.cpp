// SPDX-License-Identifier: MIT
#include "runtime/placement/domination.h"

#include "runtime/placement/impl/check_options.h"
#include "runtime/placement/impl/crowding.h"
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"
#include "runtime/placement/impl/tree_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kPiece = 2048;     // plants
constexpr std::uint64_t kPiecesAtOnce = 8; // for each worker
/// Time in the shade after which a plant with tolerance 0 dies, as a fraction of the time that its
/// radius took to grow. Larger plants therefore live longer in the shade.
constexpr float kShadeTolerance = 0.25F;
constexpr float kLifeSpread = 0.2F; // max deviation from the lifespan, relative to it
constexpr std::uint32_t kMaxNumber = 0xFFFFFFFFu;

std::uint32_t oldest_age(const SpeciesGrowth& growth) {
    return growth.lifespan + growth.lifespan / 5 + 1;
}

/// Takes the first of two random points of the bounding square that lies in the unit disc. Returns
/// false if both points are outside of the disc, which happens once in 22 calls.
bool find_in_disc(const PhiloxBlock& words, std::array<double, 2>& point) {
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        point = {2.0 * unit(words[i]) - 1.0, 2.0 * unit(words[i + 1]) - 1.0};
        if (point[0] * point[0] + point[1] * point[1] <= 1.0) {
            return true;
        }
    }
    return false;
}

/// Growth of the radius of a plant that is not dominated, m per year.
float undominated_growth(const SpeciesGrowth& growth, float radius, float vigour) {
    return growth.rate * vigour * (1.0F - radius / growth.max_radius);
}

std::vector<float> undominated_radii(const SpeciesGrowth& growth) {
    std::vector<float> radii(oldest_age(growth) + 1);
    for (std::size_t age = 1; age < radii.size(); ++age) {
        radii[age] = radii[age - 1] + undominated_growth(growth, radii[age - 1], 1.0F);
    }
    return radii;
}

/// The place where a seed sprouts.
struct Sprout {
    glm::vec2 place;
    std::uint16_t species = 0;
};

/// The rules by which plants live and spread seeds in one year.
class Life {
public:
    Life(const PlacementOptions& options, const Terrain& terrain, std::uint32_t year)
        : options_(options), maker_(options, terrain), year_(year) {}

    [[nodiscard]] ForestPlant
    seedling(std::uint32_t number, std::uint16_t species, glm::vec2 place) const {
        const SpeciesGrowth& growth = options_.species[species].growth;
        const PhiloxBlock words = placement_draws(options_.key, number, kAppearanceBlock);
        ForestPlant plant;
        plant.place = place;
        plant.vigour = 1.0F - growth.vigour_spread * unit_interval(words[3]);
        plant.radius = undominated_growth(growth, 0.0F, plant.vigour);
        plant.number = number;
        plant.species = species;
        plant.age = 1;
        return plant;
    }

    void grow(ForestPlant& plant) const {
        const SpeciesGrowth& growth = growth_of(plant);
        ++plant.age;
        const float growth_in_year = undominated_growth(growth, plant.radius, plant.vigour);
        plant.radius += plant.dominated ? growth_in_year * growth.tolerance : growth_in_year;
    }

    /// Adds the stress of one year if the plant is dominated, else subtracts the recovery of one
    /// year.
    void update_stress(ForestPlant& plant) const {
        const SpeciesGrowth& growth = growth_of(plant);
        const float harm = growth.rate * plant.vigour / (plant.radius * kShadeTolerance);
        plant.stress = plant.dominated ? plant.stress + harm * (1.0F - growth.tolerance)
                                       : std::max(0.0F, plant.stress - harm);
    }

    [[nodiscard]] bool is_dead(const ForestPlant& plant) const {
        if (plant.stress >= 1.0F) {
            return true;
        }
        const auto span = static_cast<float>(growth_of(plant).lifespan);
        if (static_cast<float>(plant.age) < span * (1.0F - kLifeSpread)) {
            return false;
        }
        const float u = unit_interval(placement_draws(options_.key, plant.number, kLifeBlock)[0]);
        return static_cast<float>(plant.age) >= span * (1.0F + kLifeSpread * (2.0F * u - 1.0F));
    }

    /// Number of seeds of a plant this year.
    [[nodiscard]] std::uint32_t seed_count(const ForestPlant& plant) const {
        const SpeciesGrowth& growth = growth_of(plant);
        if (plant.dominated || plant.age < growth.maturity || growth.seeds <= 0.0F) {
            return 0;
        }
        const float u = unit_interval(placement_draws(options_.key, plant.number, seed_block())[0]);
        return static_cast<std::uint32_t>(growth.seeds + u);
    }

    /// Appends the places where the seeds that the plant spreads this year sprout.
    void sow(const ForestPlant& plant, std::vector<Sprout>& sprouts) const {
        const SpeciesGrowth& growth = growth_of(plant);
        const std::uint32_t count = seed_count(plant);
        for (std::uint32_t seed = 1; seed <= count; ++seed) {
            const PhiloxBlock words =
                placement_draws(options_.key, plant.number, seed_block() + seed);
            std::array<double, 2> to{};
            if (!find_in_disc(words, to)) {
                continue;
            }
            const auto reach = static_cast<double>(growth.seed_distance);
            const glm::vec2 place{
                static_cast<float>(static_cast<double>(plant.place.x) + reach * to[0]),
                static_cast<float>(static_cast<double>(plant.place.y) + reach * to[1])};
            if (options_.region.contains(place.x, place.y) &&
                maker_.can_live(plant.species, place.x, place.y)) {
                sprouts.push_back({place, plant.species});
            }
        }
    }

private:
    [[nodiscard]] std::uint32_t seed_block() const { return kSeedBlock + year_ * kMaxSeeds; }
    [[nodiscard]] const SpeciesGrowth& growth_of(const ForestPlant& plant) const {
        return options_.species[plant.species].growth;
    }

    const PlacementOptions& options_;
    TreeMaker maker_;
    std::uint32_t year_;
};

std::uint64_t piece_count(std::uint64_t plants) {
    return (plants + kPiece - 1) / kPiece;
}

/// Calls `visit` for each plant of piece number `piece`.
template <typename Visit>
void for_piece(std::span<ForestPlant> plants, std::uint64_t piece, const Visit& visit) {
    const std::uint64_t end = std::min<std::uint64_t>(plants.size(), (piece + 1) * kPiece);
    for (std::uint64_t i = piece * kPiece; i < end; ++i) {
        visit(plants[i]);
    }
}

std::uint64_t count_seeds(const Life& life, Workers& workers, std::span<ForestPlant> plants) {
    std::vector<std::uint64_t> counts(piece_count(plants.size()));
    workers.for_each(counts.size(), [&](std::uint64_t piece) {
        for_piece(plants, piece,
                  [&](const ForestPlant& plant) { counts[piece] += life.seed_count(plant); });
    });
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// Adds this year's seedlings in the order of their parents.
void add_seedlings(const Life& life,
                   Workers& workers,
                   std::uint32_t& next_number,
                   LargeVector<ForestPlant>& plants) {
    const std::size_t parents = plants.size();
    const std::uint64_t pieces = piece_count(parents);
    std::vector<std::vector<Sprout>> sprouts(std::min(pieces, kPiecesAtOnce * workers.count()));
    for (std::uint64_t first = 0; first < pieces; first += sprouts.size()) {
        const std::uint64_t count = std::min<std::uint64_t>(sprouts.size(), pieces - first);
        workers.for_each(count, [&](std::uint64_t i) {
            sprouts[i].clear();
            for_piece({plants.data(), parents}, first + i,
                      [&](const ForestPlant& plant) { life.sow(plant, sprouts[i]); });
        });
        for (std::uint64_t i = 0; i < count; ++i) {
            for (const Sprout& sprout : sprouts[i]) {
                plants.push_back(life.seedling(next_number++, sprout.species, sprout.place));
            }
        }
    }
}

} // namespace

Domination::Domination(const PlacementOptions& options, const Terrain& terrain)
    : options_(options), terrain_(&terrain) {
    for (const PlacementSpecies& species : options.species) {
        undominated_radii_.push_back(undominated_radii(species.growth));
    }
}

Result<Domination> Domination::begin(const PlacementOptions& options, const Terrain& terrain) {
    PlacementOptions first = options;
    first.method = PlacementMethod::Domination;
    if (const Result<double> checked = check_placement(first); !checked) {
        return checked.error();
    }
    Domination forest(first, terrain);
    Workers workers(first.threads);
    const TreeMaker maker(first, terrain);
    Placement placement;
    place_uniform({first, terrain, maker, workers}, placement);
    const Life life(forest.options_, terrain, 0);
    forest.plants_.reserve(placement.trees.size());
    for (const Tree& tree : placement.trees) {
        forest.plants_.push_back(
            life.seedling(tree.number, tree.species, {tree.position.x, tree.position.z}));
    }
    find_dominated(first.region, forest.plants_, workers);
    forest.next_number_ = static_cast<std::uint32_t>(first.count);
    forest.report_ = placement.report;
    return forest;
}

Result<void> Domination::step() {
    if (year_ == kMaxYears) {
        return Error{fmt::format("a forest grows for at most {} years", kMaxYears)};
    }
    const Life life(options_, *terrain_, year_ + 1);
    Workers workers(options_.threads);
    const std::uint64_t seeds = count_seeds(life, workers, plants_);
    const std::uint64_t max_plants = plants_.size() + seeds;
    if (max_plants > kMaxTrees || seeds > kMaxNumber - next_number_) {
        return Error{
            fmt::format("in year {} there are {} plants and {} seeds; a forest has at most "
                        "{} of both, and 2^32 plants in all years",
                        year_ + 1, plants_.size(), seeds, kMaxTrees)};
    }
    if (plants_.capacity() < max_plants) {
        plants_.reserve(
            std::max<std::size_t>(max_plants, plants_.capacity() + plants_.capacity() / 4));
    }
    const std::size_t parents = plants_.size();
    add_seedlings(life, workers, next_number_, plants_);
    workers.for_each(piece_count(parents), [&](std::uint64_t piece) {
        for_piece({plants_.data(), parents}, piece, [&](ForestPlant& plant) { life.grow(plant); });
    });
    find_dominated(options_.region, plants_, workers);
    workers.for_each(piece_count(plants_.size()), [&](std::uint64_t piece) {
        for_piece(plants_, piece, [&](ForestPlant& plant) { life.update_stress(plant); });
    });
    plants_.erase(std::remove_if(plants_.begin(), plants_.end(),
                                 [&](const ForestPlant& plant) { return life.is_dead(plant); }),
                  plants_.end());
    ++year_;
    return {};
}

std::uint16_t Domination::age_of(const ForestPlant& plant, const TreeMaker& maker) const {
    const PlacementSpecies& species = options_.species[plant.species];
    if (species.stages <= 1 || plant.number >= options_.count) {
        return plant.age;
    }
    const float start_age =
        static_cast<float>(maker.start_of(plant.number, plant.species)) * species.years_of_stage;
    return static_cast<std::uint16_t>(plant.age + static_cast<std::uint32_t>(std::ceil(start_age)));
}

LargeVector<Tree> Domination::trees() const {
    const TreeMaker maker(options_, *terrain_);
    LargeVector<Tree> trees(plants_.size());
    Workers workers(options_.threads);
    workers.for_each(piece_count(plants_.size()), [&](std::uint64_t piece) {
        const std::uint64_t end = std::min<std::uint64_t>(plants_.size(), (piece + 1) * kPiece);
        for (std::uint64_t i = piece * kPiece; i < end; ++i) {
            const ForestPlant& plant = plants_[i];
            const std::vector<float>& radii = undominated_radii_[plant.species];
            Tree tree = maker.appearance_of(plant.number, plant.species);
            tree.position = {plant.place.x, terrain_->height(plant.place.x, plant.place.y),
                             plant.place.y};
            tree.scale *= plant.radius / radii[std::min<std::size_t>(plant.age, radii.size() - 1)];
            tree.age = age_of(plant, maker);
            trees[i] = tree;
        }
    });
    return trees;
}

} // namespace lsys
