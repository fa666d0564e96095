// SPDX-License-Identifier: MIT
// Surroundings of trees: which of the four quarters around a tree are taken by neighbours. A
// species that senses its surroundings has heroes for each of the six cases, and a tree takes a
// hero of its case, turned to fit (samples/scenes/README.md). The decisions are comparisons of
// sums and products in binary64, so they are the same on every machine, for any number of
// threads, and for any part of a forest that contains the neighbours.
#pragma once

#include "runtime/forest/tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace lsys {

struct Forest;
struct InstanceCache;

/// The taken quarters, up to rotation.
enum class Surroundings : std::uint8_t { Open, One, Adjacent, Opposite, Three, Closed };
inline constexpr std::array<std::string_view, kSurroundings> kSurroundingsNames{
    "open", "one", "adjacent", "opposite", "three", "closed"};

/// Distance in crown radii within which a tree takes a quarter of another tree: crowns that are
/// farther apart do not touch.
inline constexpr double kNeighbourReach = 2.0;
/// Height of the lowest plant that takes a quarter, as a part of the height of the tree: flowers
/// and seedlings below a tree do not shade it.
inline constexpr double kNeighbourHeight = 0.5;
/// Distance in crown radii at which the neighbours of heroes stand: the middle of the distances at
/// which trees take quarters. Shadow is short, so crowns that only touch would hardly shade.
inline constexpr double kNeighbourDistance = 1.0;

/// The quarters that are taken around the heroes of a case: bit q stands for the quarter whose
/// middle is at yaw q * 90 degrees from +X. Quarter 0 is taken in every case except Open.
[[nodiscard]] std::uint32_t taken_quarters(Surroundings surroundings);

struct TurnedSurroundings {
    Surroundings surroundings = Surroundings::Open;
    std::uint32_t turns = 0; // quarter turns that move the quarters of the case to the taken ones
};
/// The case of a set of taken quarters, with the fewest turns. Precondition: `taken` < 16.
[[nodiscard]] TurnedSurroundings match_quarters(std::uint32_t taken);

/// Radius of the crown of a cache's plants in m: the mean over its heroes of a quarter of the
/// width plus the depth of the box around the hero. 0 if they draw nothing.
[[nodiscard]] double crown_radius_of(const InstanceCache& cache);

/// Sets the crown radii and heights of the stages if a species of the forest senses its
/// surroundings. Reads the key of the forest. Call it again after any change of species.
void measure_plants(Forest& forest);

/// Whether a species of the forest senses its surroundings.
[[nodiscard]] bool has_sensed_surroundings(const Forest& forest);
/// The largest distance in m at which a tree can depend on another: kNeighbourReach times the
/// largest crown radius times `max_scales`[species], over the species that sense; 0 if none does.
[[nodiscard]] double reach_of_surroundings(const Forest& forest,
                                           std::span<const double> max_scales);

/// Sets the surroundings and the yaw of those `trees` whose species senses them; other trees keep
/// their values. A neighbour of a tree is a tree of `all`, of any species, at most kNeighbourReach
/// crown radii away and at least kNeighbourHeight times as tall, but not at the same place. A
/// height is the scale times ForestStage::plant_height. A quarter with a neighbour is taken.
/// Quarter 0 is centred on the direction of the nearest neighbour (ties: the lowest number); each
/// quarter contains its border at the lower yaw. A tree without neighbours gets a random yaw, a
/// function of the key of the forest, its number and its place. `forest`: its trees are not used.
/// `all`: contains the neighbours of `trees`, with their final scales, and may be the same trees. 0
/// threads: as many as the machine has. Throws std::bad_alloc.
void sense_surroundings(const Forest& forest,
                        std::span<const Tree> all,
                        std::span<Tree> trees,
                        std::uint32_t threads);

/// Calls sense_surroundings() for all trees of the forest, if a species senses.
void sense_surroundings(Forest& forest, std::uint32_t threads);

} // namespace lsys
