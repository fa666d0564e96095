// SPDX-License-Identifier: MIT
#include "viewer/app/square_source.h"

#include "grammar/base/contract.h"
#include "runtime/forest/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint32_t kSampledTrees = 64; // per species, for mean and max sizes

} // namespace

bool SquareSource::is_needed(const Scene& scene, const Project& project, const GrownForest& grown) {
    if (!is_tileable(scene.placement.method) || !scene.painting.empty()) {
        return false;
    }
    const Result<double> places = expected_places(placement_options(scene, project, grown));
    return places && places.value() > kMaxHeldTrees;
}

Result<std::shared_ptr<const SquareSource>>
SquareSource::make(const Scene& scene, const Project& project, const GrownForest& grown) {
    PlacementOptions options = placement_options(scene, project, grown);
    options.threads = 1;
    const Region all = options.region;
    // Cell numbers are largest at the corners of the ground. If they are valid there, they are
    // valid everywhere.
    for (const double x : {all.x, all.x + all.width}) {
        for (const double z : {all.z, all.z + all.depth}) {
            options.region = {std::max(x - 1.0, all.x), std::max(z - 1.0, all.z), 1.0, 1.0};
            if (const Result<Placement> placed = place_trees(options, *grown.terrain); !placed) {
                return placed.error();
            }
        }
    }
    return std::make_shared<const SquareSource>(scene, project, grown);
}

SquareSource::SquareSource(const Scene& scene, const Project& project, const GrownForest& grown)
    : options_(placement_options(scene, project, grown)), terrain_(*grown.terrain),
      kinds_(grown.forest), sizer_(unit_heights(scene, grown), grown.forest),
      field_(options_, terrain_) {
    options_.threads = 1;
    const Result<double> places = expected_places(options_);
    LSYS_CHECK(places);
    all_places_ = places.value();
    halo_ = halo_of(options_, kinds_, sizer_);
}

std::vector<Tree> SquareSource::trees_of(const Region& region) const {
    PlacementOptions options = options_;
    options.region = halo_ > 0.0 ? widened(region, halo_) : region;
    const Result<Placement> placed = place_trees(options, terrain_);
    LSYS_CHECK(placed, region.x, region.z, region.width, region.depth);
    std::vector<Tree> trees(placed.value().trees.begin(), placed.value().trees.end());
    if (halo_ > 0.0) {
        const auto is_outside = [](const Region& part) {
            return [&part](const Tree& tree) {
                return !part.contains(tree.position.x, tree.position.z);
            };
        };
        std::erase_if(trees, is_outside(options_.region));
        static_cast<void>(sizer_.size(trees));
        const std::vector<Tree> surrounding_trees = trees;
        std::erase_if(trees, is_outside(region));
        sense_surroundings(kinds_, surrounding_trees, trees, 1);
    } else {
        static_cast<void>(sizer_.size(trees));
    }
    std::sort(trees.begin(), trees.end(),
              [](const Tree& a, const Tree& b) { return a.number < b.number; });
    return trees;
}

double SquareSource::expected_trees(const Region& region) const {
    if (options_.method != PlacementMethod::DensityCells) {
        return field_.places_at(region.x, region.z) * region.area();
    }
    constexpr int kSide = 4;
    double sum = 0.0;
    for (int i = 0; i < kSide * kSide; ++i) {
        sum += field_.places_at(region.x + region.width * (0.5 + i % kSide) / kSide,
                                region.z + region.depth * (0.5 + i / kSide) / kSide);
    }
    return sum / (kSide * kSide) * region.area();
}

std::shared_ptr<const StreamedTrees> SquareSource::describe(const ForestModel& model) const {
    auto streamed = std::make_shared<StreamedTrees>();
    streamed->layout = make_square_layout(options_.region, all_places_ / options_.region.area());
    std::vector<double> scales(model.forms.size());
    std::vector<double> counts(model.forms.size());
    std::vector<double> crowns; // by species: mean area in m2 that a tree hides, seen from above
    for (std::size_t s = 0; s < options_.species.size(); ++s) {
        std::vector<Tree> trees;
        for (std::uint32_t number = 0; number < kSampledTrees; ++number) {
            trees.push_back(field_.tree_of(number, static_cast<std::uint16_t>(s)));
        }
        static_cast<void>(sizer_.size(trees));
        double area = 0.0;
        for (const Tree& tree : trees) {
            const std::uint32_t form = model.form_of(tree);
            scales[form] += static_cast<double>(tree.scale);
            counts[form] += 1.0;
            streamed->tallest =
                std::max(streamed->tallest, tree.scale * model.forms[form].height());
            // A crown fills about half of the circle of its farthest twig.
            const auto radius = static_cast<double>(tree.scale * model.forms[form].radius);
            area += 0.5 * std::numbers::pi * radius * radius;
        }
        crowns.push_back(area / kSampledTrees);
    }
    for (std::size_t form = 0; form < scales.size(); ++form) {
        streamed->mean_scales.push_back(
            counts[form] > 0.0 ? static_cast<float>(scales[form] / counts[form]) : 0.0F);
    }
    // Area of the crowns on the whole ground, estimated from the tree densities at the points of a
    // lattice.
    constexpr int kLattice = 24;
    std::vector<double> crown_sums(crowns.size());
    std::vector<double> densities_here(crowns.size());
    for (int i = 0; i < kLattice * kLattice; ++i) {
        const Region& ground = options_.region;
        field_.trees_at(ground.x + ground.width * (0.5 + i % kLattice) / kLattice,
                        ground.z + ground.depth * (0.5 + i / kLattice) / kLattice, densities_here);
        for (std::size_t s = 0; s < crowns.size(); ++s) {
            crown_sums[s] += densities_here[s] * crowns[s];
        }
    }
    streamed->crown_weights.resize(model.forms.size());
    for (std::size_t s = 0; s < crowns.size(); ++s) {
        const std::uint32_t first = model.first_form[s];
        const std::size_t end =
            s + 1 < crowns.size() ? model.first_form[s + 1] : model.forms.size();
        double trees = 0.0; // number of sampled trees of the species, all stages
        for (std::size_t form = first; form < end; ++form) {
            trees += counts[form];
        }
        for (std::size_t form = first; form < end; ++form) {
            streamed->crown_weights[form] =
                static_cast<float>(crown_sums[s] * counts[form] / trees);
        }
    }
    streamed->cover = [this, crowns = std::move(crowns)](double x, double z) {
        const Region& ground = options_.region;
        if (!ground.contains(static_cast<float>(x), static_cast<float>(z))) {
            return 0.0F;
        }
        std::vector<double> densities(crowns.size());
        field_.trees_at(x, z, densities);
        double area = 0.0; // m2 of crowns per m2 of ground
        for (std::size_t s = 0; s < crowns.size(); ++s) {
            area += densities[s] * crowns[s];
        }
        return static_cast<float>(1.0 - std::exp(-area)); // cover of crowns at independent places
    };
    constexpr float kViewDistance = 120'000.0F; // beyond the default visibility
    streamed->view_distance = kViewDistance;
    return streamed;
}

} // namespace lsys::view
