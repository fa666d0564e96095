// SPDX-License-Identifier: MIT
#include "runtime/tiles/tiles.h"

#include "grammar/base/hash.h"
#include "runtime/export/export.h"
#include "runtime/export/tile_document.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/forest/tree_bounds.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/hero_levels.h"
#include "runtime/placement/density_field.h"
#include "runtime/tiles/impl/canopy.h"
#include "runtime/tiles/impl/canopy_field.h"
#include "runtime/tiles/impl/geodesy.h"
#include "runtime/tiles/impl/ground_patch.h"
#include "runtime/tiles/impl/hero_table.h"
#include "runtime/tiles/impl/level_plan.h"
#include "runtime/tiles/impl/model_files.h"
#include "runtime/tiles/impl/subtree.h"
#include "runtime/tiles/impl/tile_boxes.h"
#include "runtime/tiles/impl/tile_digest.h"
#include "runtime/tiles/impl/tile_ground.h"
#include "runtime/tiles/impl/tileset.h"
#include "runtime/tiles/impl/tree_source.h"
#include "runtime/tiles/tree_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <new>
#include <utility>

namespace lsys {

namespace {

constexpr const char* kGroundPicture = "pictures/ground.png";
/// Number of sample trees per species of a placement on an unbounded grid; their crowns are
/// averaged.
constexpr std::uint32_t kSampleTrees = 1024;
/// Mean linear colour of the ground without a picture, as in make_terrain_mesh().
constexpr glm::dvec3 kGroundColour(0.055, 0.07, 0.025);

} // namespace

struct TileForest::State {
    Scene scene;
    GrownForest grown;
    TileOptions options;
    GroundFrame earth{std::nullopt};
    TileGrid grid{Region()};
    std::vector<Hero> heroes;  // plants, then branches
    bool has_branches = false; // whether trees are assembled from branches
    std::vector<std::vector<HeightTable>> height_tables; // by species and stage; only with branches
    std::optional<HeroTable> hero_table;
    LevelPlan plan;
    std::optional<TileBoxes> boxes;

    PlacementOptions placement;
    std::optional<TreeSizer> sizer;
    std::unique_ptr<TreeSource> source;
    std::vector<double> max_scales; // by species: largest scale of a tree
    /// By species: kSampleTrees trees; only of a placement on an unbounded grid.
    std::vector<std::vector<Tree>> samples;
    double density = 0.0;        // mean number of trees per m2
    double places = 0.0;         // expected number of places; only for an unbounded grid
    double largest_extent = 0.0; // m, largest extent of a tree, at least its height

    std::unique_ptr<DensityField> field;     // only for a placement on an unbounded grid
    std::optional<CanopyField> field_canopy; // only for a placement on an unbounded grid
    std::vector<Canopy> counted_canopies;    // for other placements; by level without trees
    CanopyAtCorner canopy_at;

    std::optional<TileParts> parts;
    /// Number of the part, by hero and level of detail; nullopt: the hero draws nothing.
    std::vector<std::vector<std::optional<std::size_t>>> part_numbers;
    std::vector<TileFile> files;
    std::vector<std::string> species_names;
    std::map<std::uint32_t, MeshOrder> ground_orders; // by number of cells along a side
    std::string ground_picture;                       // its path relative to a tile; empty: none
    glm::dvec3 ground_colour = kGroundColour;
    std::uint64_t parts_digest = 0; // hash of the documents of `parts`
    std::uint64_t trees_digest = 0; // placement_digest() of runtime/pipeline/forest.h

    [[nodiscard]] Outcome<void> place_trees(const Project& project);
    [[nodiscard]] Outcome<void> read_trees(const Project& project);
    [[nodiscard]] Outcome<void> measure_placed_trees(const Project& project);
    [[nodiscard]] Outcome<void> sample_trees(const Project& project);
    void note_missing_trees(Messages& messages) const;
    [[nodiscard]] Outcome<void> plan_all_heroes(const Project& project);
    [[nodiscard]] std::vector<TreeBounds> bounds_of_stages(std::uint32_t species) const;
    void plan_levels();
    [[nodiscard]] Outcome<void> make_models(const Project& project);
    [[nodiscard]] bool is_plant(std::size_t hero) const;
    [[nodiscard]] std::vector<Tree> sample_trees() const;
    [[nodiscard]] double height_of(const Tree& tree) const;
    void make_ground_picture();
    void order_ground();
    void make_canopies();
    [[nodiscard]] MeshDocument ground_of(const TileId& tile, const TileFrame& frame) const;
    std::uint64_t
    add_trees(const TileId& tile, const TileFrame& frame, TileDocument& document) const;
};

TileForest::TileForest(std::unique_ptr<State> state) : state_(std::move(state)) {}
TileForest::TileForest(TileForest&& other) noexcept = default;
TileForest& TileForest::operator=(TileForest&& other) noexcept = default;
TileForest::~TileForest() = default;

const std::vector<TileLevel>& TileForest::levels() const {
    return state_->plan.levels;
}
const std::vector<TileFile>& TileForest::files() const {
    return state_->files;
}
bool TileForest::has_tile(const TileId& tile) const {
    return tile.level < levels().size() && state_->grid.has_ground(tile);
}
bool TileForest::has_tileset(std::uint32_t level) const {
    return level == 0 ||
           (!state_->options.implicit && has_nested_tileset(level, state_->plan.finest()));
}
bool TileForest::has_subtree(std::uint32_t level) const {
    const auto all = static_cast<std::uint32_t>(levels().size());
    return state_->options.implicit && level < all && level % subtree_levels(all) == 0;
}
std::string TileForest::content_path(const TileId& tile) {
    return fmt::format("{}/{}/{}.glb", tile.level, tile.column, tile.row);
}
std::string TileForest::tileset_path(const TileId& root) {
    return root.level == 0 ? "tileset.json"
                           : fmt::format("{}/{}/{}.json", root.level, root.column, root.row);
}

std::string TileForest::subtree_path(const TileId& root) {
    return fmt::format("{}/{}/{}.subtree", root.level, root.column, root.row);
}

TileExtent TileForest::extent(std::uint32_t level) const {
    // The first tiles of each row and column are those with ground, because ground and square begin
    // at the same corner.
    const auto count = [level](const auto& has_tile_at) {
        std::uint32_t low = 0;
        std::uint32_t high = TileGrid::tiles_across(level);
        while (low < high) {
            const std::uint32_t middle = low + (high - low) / 2;
            has_tile_at(middle) ? low = middle + 1 : high = middle;
        }
        return low;
    };
    return {count([&](std::uint32_t column) {
                return has_tile({level, column, 0});
            }),
            count([&](std::uint32_t row) {
                return has_tile({level, 0, row});
            })};
}

std::vector<TileId> TileForest::tiles(std::uint32_t level) const {
    const TileExtent all = extent(level);
    std::vector<TileId> list;
    list.reserve(all.count());
    for (std::uint32_t row = 0; row < all.rows; ++row) {
        for (std::uint32_t column = 0; column < all.columns; ++column) {
            list.push_back({level, column, row});
        }
    }
    return list;
}

/// Sets all trees of a scene: reads them from the tree file, or places them.
Outcome<void> TileForest::State::place_trees(const Project& project) {
    if (options.tree_file) {
        return read_trees(project);
    }
    Step step(project);
    if (!step.take(place_forest(scene, project, grown))) {
        return step.end();
    }
    sort_by_tile(grid, grown.forest.trees);
    return step.done();
}

Outcome<void> TileForest::State::read_trees(const Project& project) {
    Step step(project);
    const TreeFileScene wanted{placement_digest(scene, project, grown, *sizer),
                               scene.terrain.region, grown.forest.species.size()};
    Result<LargeVector<Tree>> trees = read_tree_file(*options.tree_file, wanted);
    if (!trees) {
        return step.fail(fmt::format("`{}`: {}", options.tree_file_path, trees.error().message));
    }
    grown.forest.trees = std::move(trees.value());
    return step.done();
}

/// Measures density and scales of a placement of which all trees are placed.
Outcome<void> TileForest::State::measure_placed_trees(const Project& project) {
    Step step(project);
    if (!step.take(place_trees(project))) {
        return step.end();
    }
    density = static_cast<double>(grown.forest.trees.size()) / scene.terrain.region.area();
    for (const Tree& tree : grown.forest.trees) {
        max_scales[tree.species] =
            std::max(max_scales[tree.species], static_cast<double>(tree.scale));
    }
    return step.done();
}

/// Measures density and scales of a placement on an unbounded grid from samples, without placing
/// it.
Outcome<void> TileForest::State::sample_trees(const Project& project) {
    Step step(project);
    if (const Result<void> checked = CellTrees::check(placement, *grown.terrain); !checked) {
        return step.fail(fmt::format("placement: {}", checked.error().message));
    }
    field = std::make_unique<DensityField>(placement, *grown.terrain);
    for (std::size_t i = 0; i < max_scales.size(); ++i) {
        const auto s = static_cast<std::uint16_t>(i);
        max_scales[s] = max_scale(placement, *sizer, s);
        std::vector<Tree>& trees = samples.emplace_back();
        for (std::uint32_t number = 0; number < kSampleTrees; ++number) {
            trees.push_back(field->tree_of(number, s));
        }
        if (sizer->size(trees)) {
            return step.fail(fmt::format("{}: a tree lies flat, so it cannot be given a height",
                                         grown.forest.species[s].name));
        }
    }
    // The means are taken over the middles of the cells of a grid.
    constexpr int kSamples = 64; // along each side
    const Region& region = scene.terrain.region;
    std::vector<double> densities(max_scales.size());
    double trees = 0.0;
    for (int i = 0; i < kSamples * kSamples; ++i) {
        const double x = region.x + region.width * (i % kSamples + 0.5) / kSamples;
        const int row = i / kSamples;
        const double z = region.z + region.depth * (row + 0.5) / kSamples;
        field->trees_at(x, z, densities);
        for (const double each : densities) {
            trees += each;
        }
        places += field->places_at(x, z);
    }
    density = trees / (kSamples * kSamples);
    places *= region.area() / (kSamples * kSamples);
    return step.done();
}

/// Adds a message about places without trees, as placement_note() returns for a forest whose trees
/// are all placed.
void TileForest::State::note_missing_trees(Messages& messages) const {
    if (places == 0.0) {
        messages.add_info("there are hardly any trees: the density map is black nearly all over "
                          "the region");
        return;
    }
    constexpr double kNoted = 0.005; // smaller fractions are within the error of the samples
    const double refused = 1.0 - density * scene.terrain.region.area() / places;
    if (refused > kNoted) {
        messages.add_info(fmt::format("about {:.0f} % of places have no tree: no species can live "
                                      "there, by its limits of altitude and slope",
                                      100.0 * refused));
    }
}

/// Plans the levels of detail of the plants and, if trees are assembled from branches, of the
/// branches.
Outcome<void> TileForest::State::plan_all_heroes(const Project& project) {
    Step step(project);
    if (!step.take(plan_heroes(grown, options.mesh, project), heroes)) {
        return step.end();
    }
    for (const ForestSpecies& species : grown.forest.species) {
        for (const ForestStage& stage : species.stages) {
            has_branches = has_branches || !stage.cache.exits.empty();
        }
    }
    if (has_branches) {
        std::vector<Hero> branches;
        if (!step.take(plan_branches(grown, options.mesh, project), branches)) {
            return step.end();
        }
        std::move(branches.begin(), branches.end(), std::back_inserter(heroes));
        for (const ForestSpecies& species : grown.forest.species) {
            std::vector<HeightTable>& tables = height_tables.emplace_back();
            for (const ForestStage& stage : species.stages) {
                tables.push_back(make_height_table(stage.cache));
            }
        }
    }
    hero_table.emplace(grown.forest, heroes);
    return step.done();
}

/// TreeBounds of each stage of a species.
std::vector<TreeBounds> TileForest::State::bounds_of_stages(std::uint32_t species) const {
    std::vector<TreeBounds> bounds;
    for (std::uint32_t i = 0; i < grown.forest.species[species].stages.size(); ++i) {
        std::vector<double> own_reach;
        for (const InstanceHeroes& instance : hero_table->instances_of(species, i)) {
            const std::size_t own = instance.alone == kNoHero ? instance.whole : instance.alone;
            own_reach.push_back(own == kNoHero ? 0.0 : heroes[own].reach);
        }
        bounds.push_back(tree_bounds(grown.forest.species[species].stages[i].cache, own_reach));
    }
    return bounds;
}

void TileForest::State::plan_levels() {
    std::vector<std::vector<TreeBounds>> bounds; // by species and stage
    for (std::uint32_t s = 0; s < grown.forest.species.size(); ++s) {
        bounds.push_back(bounds_of_stages(s));
    }
    TreeReach reach;
    std::vector<double> deviations;
    for (const Hero& hero : heroes) {
        const InstanceCache& cache = grown.forest.species[hero.species].stages[hero.stage].cache;
        const Instance& instance = cache.instances[hero.instance];
        const TreeBounds& of_stage = bounds[hero.species][hero.stage];
        const double deviation = of_stage.deviation[hero.instance];
        const double scale = max_scales[hero.species];
        deviations.push_back(hero.ends_at_exits ? 0.0 : deviation);
        // The surface of a coarser level of detail exceeds the finest surface by at most its error.
        const double margin = static_cast<double>(hero.levels.levels.back().error);
        if (instance.exit_count > 0 || instance.slot != 0) {
            const double all = scale * (of_stage.reach[hero.instance] + margin);
            if (instance.slot == 0) {
                largest_extent = std::max(
                    largest_extent, scale * (static_cast<double>(hero.extent()) + 2.0 * deviation));
                reach.around = std::max(reach.around, all);
                reach.above = std::max(reach.above, all);
                reach.below = std::max(reach.below, all);
            }
            continue;
        }
        BranchInstance whole;
        whole.instance = hero.instance;
        const InstancePose pose = pose_of(whole, instance);
        largest_extent = std::max(largest_extent, scale * static_cast<double>(hero.extent()));
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 point((corner & 1) != 0 ? hero.bounds.high.x : hero.bounds.low.x,
                                  (corner & 2) != 0 ? hero.bounds.high.y : hero.bounds.low.y,
                                  (corner & 4) != 0 ? hero.bounds.high.z : hero.bounds.low.z);
            const glm::dvec3 at(pose.translation + pose.scale * (pose.rotation * point));
            const double around = std::sqrt(at.x * at.x + at.z * at.z);
            reach.around = std::max(reach.around, scale * (around + margin));
            reach.above = std::max(reach.above, scale * (at.y + margin));
            reach.below = std::max(reach.below, scale * (margin - at.y));
        }
    }
    const std::vector<Tree> trees = sample_trees();
    plan = plan_tile_levels({*grown.terrain, grid, grown.forest, heroes, *hero_table,
                             std::move(deviations), trees, max_scales, density, largest_extent,
                             options});
    for (const LevelDetail& level : plan.details) {
        for (std::size_t i = 0; i < level.detail.size(); ++i) {
            if (level.detail[i] != kNotShown) {
                heroes[i].in_use[level.detail[i]] = true;
            }
        }
    }
    if (plan.first_tree_level > 0) {
        for (std::size_t i = 0; i < heroes.size(); ++i) {
            if (is_plant(i)) {
                heroes[i].in_use[plan.canopy_levels[i]] = true;
            }
        }
    }
    boxes.emplace(*grown.terrain, earth, grid, reach, plan.skirts);
}

Outcome<void> TileForest::State::make_models(const Project& project) {
    Step step(project);
    if (!step.take(mesh_heroes(grown, options.mesh, project, heroes))) {
        return step.end();
    }
    std::vector<std::string> names;
    std::size_t first = 0; // number of the first plant or branch of this stage
    for (std::size_t i = 0; i < heroes.size(); ++i) {
        const Hero& hero = heroes[i];
        if (hero.species != heroes[first].species || hero.stage != heroes[first].stage ||
            is_plant(i) != is_plant(first)) {
            first = i;
        }
        const ForestSpecies& species = grown.forest.species[hero.species];
        std::string stage = stage_name(species, hero.stage);
        if (!stage.empty()) {
            std::replace(stage.begin(), stage.end(), ' ', '-');
            stage.insert(0, 1, '-');
        }
        names.push_back(
            fmt::format("{}{}{} {}", species.name, stage, is_plant(i) ? "" : " branch", i - first));
    }
    ModelFiles made = make_model_files(heroes, names, plan, options.generator);
    files = std::move(made.files);
    parts.emplace(options.generator, species_names);
    for (const std::vector<MeshDocument>& details : made.models) {
        std::vector<std::optional<std::size_t>>& numbers = part_numbers.emplace_back();
        for (const MeshDocument& model : details) {
            parts_digest = combine_bytes(parts_digest, model.json.dump());
            numbers.push_back(model.json.is_null() ? std::nullopt
                                                   : std::optional(parts->add(model)));
        }
    }
    return step.done();
}

void TileForest::State::make_ground_picture() {
    if (grown.ground.colour == nullptr) {
        return;
    }
    ground_colour = glm::dvec3(mean_colour(*grown.ground.colour));
    Mesh sample; // one triangle: only materials in use have picture files
    sample.positions = {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}};
    sample.normals.assign(3, {0.0F, 1.0F, 0.0F});
    sample.texture_coordinates = {{0.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 0.0F}};
    LargeVector<std::uint32_t> indices{0, 1, 2};
    sample.indices = TriangleList(std::move(indices));
    Material material;
    material.name = "ground";
    material.textured = true;
    material.picture = grown.ground.colour;
    sample.materials.push_back(material);
    sample.parts.push_back({0, 0, 3});
    files.push_back({kGroundPicture, tile_pictures(sample).front().bytes});
    ground_picture = std::string("../../") + kGroundPicture;
}

void TileForest::State::order_ground() {
    for (const std::uint32_t cells : plan.cells) {
        if (!ground_orders.contains(cells)) {
            ground_orders[cells] =
                make_mesh_order(make_level_patch(cells), tile_part_info("", options.generator));
        }
    }
}

void TileForest::State::make_canopies() {
    if (plan.first_tree_level == 0) {
        return;
    }
    std::vector<Crown> crowns; // by hero: crowns of plants, which represent their trees
    for (std::size_t i = 0; i < heroes.size() && is_plant(i); ++i) {
        crowns.push_back(crown_of(heroes[i].meshes[plan.canopy_levels[i]]));
    }
    if (field != nullptr) {
        std::vector<CrownSums> means(max_scales.size());
        for (std::size_t s = 0; s < means.size(); ++s) {
            for (const Tree& tree : samples[s]) {
                means[s].add(
                    sums_of(crowns[hero_table->hero_of(tree)], static_cast<double>(tree.scale)),
                    1.0 / kSampleTrees);
            }
        }
        field_canopy.emplace(*field, std::move(means), grid);
        canopy_at = [this](std::uint32_t level, std::int64_t column, std::int64_t row) {
            return field_canopy->at_corner(level, column, row);
        };
        return;
    }
    const std::uint32_t tiles = TileGrid::tiles_across(plan.first_tree_level - 1);
    Canopy canopy(kCanopyCells * tiles, grid.square().width / kCanopyCells / tiles);
    for (const Tree& tree : grown.forest.trees) {
        // Cells are tiles of a deeper level.
        const TileId cell = grid.tile_at(plan.first_tree_level - 1 + kCanopyLevels, tree.position.x,
                                         tree.position.z);
        canopy.add(cell.column, cell.row, crowns[hero_table->hero_of(tree)],
                   static_cast<double>(tree.scale));
    }
    counted_canopies.push_back(std::move(canopy));
    while (counted_canopies.size() < plan.first_tree_level) {
        counted_canopies.push_back(counted_canopies.back().coarser());
    }
    std::reverse(counted_canopies.begin(), counted_canopies.end());
    canopy_at = [this](std::uint32_t level, std::int64_t column, std::int64_t row) {
        return counted_canopies[level].at_corner(column, row);
    };
}

MeshDocument TileForest::State::ground_of(const TileId& tile, const TileFrame& frame) const {
    static const CanopyAtCorner no_canopy;
    const bool has_trees = plan.levels[tile.level].has_trees;
    const Mesh mesh = make_tile_ground({*grown.terrain, grown.ground, ground_colour, frame, grid,
                                        has_trees ? no_canopy : canopy_at, tile,
                                        plan.cells[tile.level], plan.skirts[tile.level]});
    MeshDocument document =
        make_mesh_document(mesh, tile_part_info(has_trees ? "ground" : "forest", options.generator),
                           ground_orders.at(plan.cells[tile.level]));
    if (!has_trees) {
        embed_picture(0, tile_pictures(mesh).front().bytes, document);
    } else if (!ground_picture.empty()) {
        document.json["images"][0]["uri"] = ground_picture;
    }
    return document;
}

/// Adds the trees of a tile to the document. Returns their number.
std::uint64_t TileForest::State::add_trees(const TileId& tile,
                                           const TileFrame& frame,
                                           TileDocument& document) const {
    const std::vector<Tree> trees = source->trees_of(tile);
    const LevelDetail& level = plan.details[tile.level];
    std::vector<TileTree> properties;
    std::map<std::size_t, std::vector<TileInstance>> groups; // by hero
    for (const Tree& tree : trees) {
        const auto number = static_cast<std::uint32_t>(properties.size());
        properties.push_back(
            {static_cast<float>(height_of(tree)), tree.number, tree.species, tree.age});
        // The tree is expanded at the origin, because binary32 is too coarse for places far from
        // the origin.
        Tree here = tree;
        here.position = glm::vec3(0.0F);
        const glm::dvec3 place(tree.position);
        const glm::vec3 foot(y_up(frame.place(place.x, place.y, place.z)));
        const glm::vec3 above(y_up(frame.place(place.x, place.y + 1.0, place.z)));
        // A tree follows the vertical at its own place, which differs from the vertical at the
        // middle of the tile.
        const glm::vec3 up = glm::normalize(above - foot);
        const glm::quat tilt =
            glm::normalize(glm::quat(1.0F + up.y, up.z, 0.0F, -up.x)); // rotation from +Y to `up`
        const InstanceCache& cache = grown.forest.cache_of(tree);
        const std::span<const InstanceHeroes> instances = hero_table->instances_of(tree);
        TreeExpander(cache, grown.forest.key).expand_until(here, [&](const BranchInstance& branch) {
            const InstanceHeroes& own = instances[branch.instance];
            const bool is_whole = level.is_whole[own.whole];
            const InstancePose pose = pose_of(branch, cache.instances[branch.instance]);
            groups[is_whole ? own.whole : own.alone].push_back(
                {tilt * pose.rotation, foot + tilt * pose.translation, pose.scale, number});
            return !is_whole;
        });
    }
    document.set_trees(std::move(properties));
    for (auto& [hero, group] : groups) {
        if (const auto part = part_numbers[hero][level.detail[hero]]) {
            document.add_instances(*part, std::move(group));
        }
    }
    return trees.size();
}

/// Height of a tree in m: height of its mesh if trees are whole heroes, else height of the axes of
/// its branches.
double TileForest::State::height_of(const Tree& tree) const {
    if (!has_branches) {
        const Bounds& bounds = heroes[hero_table->hero_of(tree)].bounds;
        return static_cast<double>(tree.scale * (bounds.high.y - bounds.low.y));
    }
    TreeMeasure measure(grown.forest.cache_of(tree),
                        height_tables[tree.species][grown.forest.stage_of(tree)], grown.forest.key);
    return static_cast<double>(tree.scale) * measure.height_of(tree.number).value_or(0.0);
}

/// Whether a hero is a plant, not a branch.
bool TileForest::State::is_plant(std::size_t hero) const {
    const Hero& each = heroes[hero];
    const InstanceCache& cache = grown.forest.species[each.species].stages[each.stage].cache;
    return !each.ends_at_exits && cache.instances[each.instance].slot == 0;
}

/// Some trees, over which means are computed: sample trees of each species of a placement on an
/// unbounded grid, else every n-th placed tree.
std::vector<Tree> TileForest::State::sample_trees() const {
    constexpr std::size_t kTrees = 64; // of each species, or about 4 * kTrees of all placed trees
    std::vector<Tree> trees;
    for (const std::vector<Tree>& of_species : samples) {
        trees.insert(trees.end(), of_species.begin(),
                     of_species.begin() +
                         static_cast<std::ptrdiff_t>(std::min(kTrees, of_species.size())));
    }
    const LargeVector<Tree>& placed = grown.forest.trees;
    const std::size_t step = std::max<std::size_t>(placed.size() / (4 * kTrees), 1);
    for (std::size_t i = 0; i < placed.size() && samples.empty(); i += step) {
        trees.push_back(placed[i]);
    }
    return trees;
}

TileContent TileForest::content(const TileId& tile) const {
    TileContent content;
    const TileFrame frame(state_->earth, inverse_of_frame(state_->boxes->frame_of(tile)),
                          state_->grid.region_of(tile));
    TileDocument document(*state_->parts);
    document.set_surface(state_->ground_of(tile, frame));
    if (levels()[tile.level].has_trees) {
        content.trees = state_->add_trees(tile, frame, document);
    }
    if (state_->options.implicit) {
        document.move(frame_in_root(*state_->boxes, tile));
    }
    content.bytes = document.write();
    return content;
}

std::string TileForest::tileset(const TileId& root) const {
    const TilesetPlan plan{state_->options.generator, levels(), state_->grid, *state_->boxes};
    return state_->options.implicit ? make_implicit_tileset(plan) : make_tileset(plan, root);
}

std::string TileForest::subtree(const TileId& root) const {
    return make_subtree({state_->options.generator, levels(), state_->grid, *state_->boxes}, root);
}

std::uint64_t TileForest::digest() const {
    const State& made = *state_;
    std::uint64_t state = combine_numbers(0, made.trees_digest, made.parts_digest);
    state = combine_bytes(state, tileset({0, 0, 0})); // the program, the root and its frame
    for (std::uint32_t level = 0; level < levels().size(); ++level) {
        state = combine_numbers(state, extent(level).columns, extent(level).rows);
    }
    state = combine_ground(combine_plan(state, made.plan), made.grown.ground);
    state = combine_numbers(state, made.ground_colour.x, made.ground_colour.y, made.ground_colour.z,
                            made.has_branches);
    if (const std::optional<GeoPlace>& origin = made.options.origin) {
        state = combine_numbers(state, origin->longitude, origin->latitude, origin->height);
    }
    for (const Hero& hero : made.heroes) {
        state = combine_hero(state, hero);
    }
    for (const ForestSpecies& species : made.grown.forest.species) {
        state = combine_bytes(state, species.name);
        for (const ForestStage& stage : species.stages) {
            state = combine_assembly(combine_numbers(state, stage.generations), stage.cache);
        }
    }
    for (const std::vector<HeightTable>& tables : made.height_tables) {
        for (const HeightTable& table : tables) {
            state = combine_heights(state, table);
        }
    }
    for (const TileFile& file : made.files) {
        state = combine_bytes(combine_bytes(state, file.path), file.bytes);
    }
    return finish(state);
}

bool is_placed_by_tile(const Scene& scene) {
    return is_tileable(scene.placement.method) && scene.painting.empty();
}

Outcome<TileForest>
make_tile_forest(LoadedScene loaded, const TileOptions& options, const Project& project) {
    Step step(project);
    auto state = std::make_unique<TileForest::State>();
    TileForest::State& made = *state;
    if (!step.take(grow_species(loaded, project, {}), made.grown)) {
        return step.end();
    }
    made.scene = std::move(loaded.scene);
    made.options = options;
    made.earth = GroundFrame(options.origin);
    made.grid = TileGrid(made.scene.terrain.region);
    made.placement = placement_options(made.scene, project, made.grown);
    for (const ForestSpecies& species : made.grown.forest.species) {
        made.species_names.push_back(species.name);
    }
    made.max_scales.assign(made.grown.forest.species.size(), 0.0);
    made.sizer.emplace(unit_heights(made.scene, made.grown), made.grown.forest);
    const bool is_grid = is_placed_by_tile(made.scene);
    if (!step.take(is_grid ? made.sample_trees(project) : made.measure_placed_trees(project)) ||
        !step.take(made.plan_all_heroes(project))) {
        return step.end();
    }
    made.plan_levels();
    const bool keeps_trees =
        options.tree_file || (options.keep_trees && made.places <= kMaxKeptTrees);
    if (is_grid && !keeps_trees) {
        made.note_missing_trees(step.messages);
        made.source = std::make_unique<CellTrees>(made.placement, *made.grown.terrain, *made.sizer,
                                                  made.grown.forest, made.grid);
    } else {
        if (is_grid && !step.take(made.place_trees(project))) {
            return step.end();
        }
        made.source = std::make_unique<PlacedTrees>(made.grown.forest.trees, made.grid);
    }
    if (!step.take(made.make_models(project))) {
        return step.end();
    }
    made.make_ground_picture();
    made.order_ground();
    made.make_canopies();
    made.options.tree_file.reset();
    made.trees_digest = placement_digest(made.scene, project, made.grown, *made.sizer);
    return step.done(TileForest(std::move(state)));
}

Outcome<PlacedScene> place_scene(const LoadedScene& loaded, const Project& project) {
    Step step(project);
    GrownForest grown;
    if (!step.take(grow_species(loaded, project, {}), grown) ||
        !step.take(place_forest(loaded.scene, project, grown))) {
        return step.end();
    }
    const TreeSizer sizer(unit_heights(loaded.scene, grown), grown.forest);
    PlacedScene placed{placement_digest(loaded.scene, project, grown, sizer),
                       std::move(grown.forest.trees)};
    sort_by_tile(TileGrid(loaded.scene.terrain.region), placed.trees);
    return step.done(std::move(placed));
}

} // namespace lsys
