#include "viewer/app/forest_edits.h"

#include <algorithm>
#include <cmath>

namespace lsys::view {

namespace {

constexpr double kDiskTrees = 0.7; // of discs, in a square of their distance

template <typename Target, typename Value>
void take(const std::optional<Value>& edit, Target& target) {
    if (edit) {
        target = *edit;
    }
}

} // namespace

SpeciesEdit& ForestEdits::of(const std::string& name) {
    const auto found = std::find_if(species.begin(), species.end(),
                                    [&](const SpeciesEdit& each) { return each.name == name; });
    if (found != species.end()) {
        return *found;
    }
    species.push_back({name, {}, {}, {}, {}, {}});
    return species.back();
}

bool ForestEdits::is_same(const ForestEdits& other) const {
    const auto covers = [](const ForestEdits& a, const ForestEdits& b) {
        return std::all_of(a.species.begin(), a.species.end(), [&](const SpeciesEdit& edit) {
            const SpeciesEdit none{edit.name, {}, {}, {}, {}, {}};
            return edit == none ||
                   std::find(b.species.begin(), b.species.end(), edit) != b.species.end();
        });
    };
    return cap == other.cap && key == other.key && method == other.method && count == other.count &&
           spacing == other.spacing && density == other.density && years == other.years &&
           ground == other.ground && hill_height == other.hill_height &&
           hill_feature == other.hill_feature && hill_seed == other.hill_seed &&
           covers(*this, other) && covers(other, *this);
}

bool ForestEdits::changes_placement() const {
    return key || method || count || spacing || density || years || ground || hill_height ||
           hill_feature || hill_seed ||
           std::any_of(species.begin(), species.end(),
                       [](const SpeciesEdit& edit) { return edit.share.has_value(); });
}

void apply(const ForestEdits& edits, Scene& scene) {
    for (const SpeciesEdit& edit : edits.species) {
        for (std::size_t i = 0; i < scene.species.size(); ++i) {
            if (scene.species[i].name != edit.name) {
                continue;
            }
            take(edit.heroes, scene.species[i].cache.heroes);
            take(edit.rho, scene.species[i].rho);
            PlacementSpecies& placed = scene.placement.species[i];
            take(edit.share, placed.share);
            take(edit.least_scale, placed.least_scale);
            take(edit.greatest_scale, placed.greatest_scale);
            placed.greatest_scale = std::max(placed.greatest_scale, placed.least_scale);
        }
    }
    for (SceneSpecies& species : scene.species) {
        take(edits.cap, species.cache.cap);
    }
    take(edits.key, scene.placement.key);
    take(edits.method, scene.placement.method);
    take(edits.count, scene.placement.count);
    take(edits.spacing, scene.placement.spacing);
    take(edits.density, scene.placement.density);
    take(edits.years, scene.placement.years);
    take(edits.ground, scene.terrain.kind);
    take(edits.hill_height, scene.terrain.noise.height);
    take(edits.hill_feature, scene.terrain.noise.feature);
    take(edits.hill_seed, scene.terrain.noise.seed);
}

void choose_method(ForestEdits& edits, PlacementMethod method, const Scene& scene) {
    const PlacementOptions& now = scene.placement;
    edits.method = method;
    const double area = std::max(now.region.area(), 1.0);
    double trees = 1000.0;
    if (reads_count(now.method) && now.count != 0) {
        trees = static_cast<double>(now.count);
    } else if (reads_spacing(now.method) && now.spacing > 0.0) {
        trees = kDiskTrees * area / (now.spacing * now.spacing);
    } else if (reads_density(now.method) && now.density > 0.0) {
        trees = area * now.density;
    }
    if (reads_count(method) && !reads_count(now.method)) {
        edits.count = static_cast<std::uint64_t>(std::max(trees, 1.0));
    }
    if (reads_spacing(method) && !reads_spacing(now.method)) {
        edits.spacing = std::sqrt(kDiskTrees * area / trees);
    }
    if (reads_density(method) && !reads_density(now.method)) {
        edits.density = trees / area;
    }
    if (method == PlacementMethod::Domination && now.years == 0) {
        edits.years = 50;
    }
}

bool reads_count(PlacementMethod method) {
    return method == PlacementMethod::Uniform || method == PlacementMethod::Domination;
}

bool reads_spacing(PlacementMethod method) {
    return method == PlacementMethod::PoissonDisk || method == PlacementMethod::Jittered ||
           method == PlacementMethod::PoissonCells;
}

bool reads_density(PlacementMethod method) {
    return method == PlacementMethod::DensityMap || method == PlacementMethod::UniformCells ||
           method == PlacementMethod::DensityCells;
}

} // namespace lsys::view
