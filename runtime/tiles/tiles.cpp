// SPDX-License-Identifier: MIT
#include "runtime/tiles/tiles.h"

#include "grammar/base/hash.h"
#include "runtime/export/export.h"
#include "runtime/export/tile_document.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/hero_levels.h"
#include "runtime/tiles/impl/box_corners.h"
#include "runtime/tiles/impl/canopy.h"
#include "runtime/tiles/impl/geodesy.h"
#include "runtime/tiles/impl/ground_patch.h"
#include "runtime/tiles/impl/tileset.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kSubtreeLevels = 4;                // levels per tileset file
constexpr std::uint64_t kPictureHash = 0x6C616E6473636170; // initial state of the hash
constexpr double kMinTileTrees = 4.0; // mean number in a tile that is not divided further
constexpr double kGroundError = 0.05; // m, tolerated error of the ground in every tile
// Mean colour of the ground without a picture, as in make_terrain_mesh().
constexpr glm::dvec3 kGroundColour(0.055, 0.07, 0.025);

/// The name of a species as part of a path: letters, digits, `-` and `_`.
std::string path_part(const std::string& name) {
    std::string part;
    for (const char c : name) {
        const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '-' || c == '_';
        part += fits ? c : '_';
    }
    return part;
}

/// The position of a cell on the Z-order curve (Morton 1966). The cells of a tile are consecutive, at
/// every level of the quadtree.
std::uint64_t morton_code(std::uint32_t column, std::uint32_t row) {
    std::uint64_t number = 0;
    for (unsigned bit = 0; bit <= kMaxTileLevel; ++bit) {
        number |= std::uint64_t{column >> bit & 1U} << 2 * bit;
        number |= std::uint64_t{row >> bit & 1U} << (2 * bit + 1);
    }
    return number;
}

/// Cells along the side of a surface: the least power of two whose error is at most half of
/// `tree_error`, or kGroundError if that is more; at most kCanopyCells.
std::uint32_t patch_cells(const Terrain& terrain, double side, double tree_error) {
    const double allowed = std::max(0.5 * tree_error, kGroundError);
    std::uint32_t cells = kCanopyCells;
    while (cells > 1 && terrain.mesh_error(2.0 * side / cells) <= allowed) {
        cells /= 2;
    }
    return cells;
}

/// Widens the box of a tile by a point of its frame with +Y up.
void widen(TileContent& content, const glm::vec3& point) {
    const glm::dvec3 at = z_up(glm::dvec3(point));
    for (int axis = 0; axis < 3; ++axis) {
        double& low = content.low[static_cast<std::size_t>(axis)];
        double& high = content.high[static_cast<std::size_t>(axis)];
        low = std::min(low, at[axis]);
        high = std::max(high, at[axis]);
    }
}

} // namespace

struct TileForest::State {
    Scene scene;
    GrownForest grown;
    TileOptions options;
    GroundFrame earth{std::nullopt};
    Region square; // of level 0
    std::vector<TileLevel> levels;
    std::uint32_t first_tree_level = 0; // the first level with single trees
    std::vector<double> ground_errors;  // by level
    std::vector<std::uint32_t> cells;   // of the surface along each side of a tile, by level

    std::vector<Hero> heroes;
    // A kind is a species and stage.
    std::vector<std::size_t> first_kind;       // by species
    std::vector<std::size_t> hero_of_instance; // the hero of an instance, kind by kind
    std::vector<std::size_t>
        first_instance; // by kind: index of its first instance in `hero_of_instance`
    std::vector<std::vector<std::size_t>> detail;  // by level and hero: its level of detail
    std::vector<std::vector<MeshDocument>> models; // by level and hero
    std::vector<std::vector<Bounds>> hero_bounds;  // by level and hero
    std::vector<TileFile> files;
    std::string ground_picture; // its path relative to a tile; empty: none

    std::vector<std::uint64_t> order_keys; // morton_code() of the trees in order
    std::vector<std::uint32_t> order;      // trees by morton_code()
    std::vector<std::size_t> hero_of_tree; // by tree
    std::vector<Canopy> canopies;          // by level without trees
    double largest_extent = 0.0;           // m, of a tree, at least its height
    glm::dvec3 ground_colour = kGroundColour;

    [[nodiscard]] std::size_t kind_of(std::uint16_t species, std::uint32_t stage) const {
        return first_kind[species] + stage;
    }
    [[nodiscard]] std::uint32_t finest() const {
        return static_cast<std::uint32_t>(levels.size()) - 1;
    }
    [[nodiscard]] Region region_of(const TileId& tile) const {
        const double side = levels[tile.level].side;
        const double x = square.x + side * tile.column;
        const double z = square.z + side * tile.row;
        const Region& ground = scene.terrain.region;
        const double right = std::min(x + side, ground.x + ground.width);
        const double front = std::min(z + side, ground.z + ground.depth);
        return {x, z, right - x, front - z};
    }
    [[nodiscard]] glm::dmat4 frame_of(const TileId& tile) const {
        const double half = levels[tile.level].side / 2.0;
        return earth.frame(square.x + 2.0 * half * tile.column + half,
                           square.z + 2.0 * half * tile.row + half);
    }

    void find_heroes();
    void sort_trees();
    void plan_levels();
    [[nodiscard]] Outcome<void> make_models(const Project& project);
    void make_ground();
    [[nodiscard]] ExportInfo info_of(const std::string& name) const;
    [[nodiscard]] std::vector<PictureFile> pictures_of(const Mesh& mesh) const;
    [[nodiscard]] MeshDocument
    model_of(const Mesh& mesh, const std::string& name, std::string& buffer);
    [[nodiscard]] std::string picture_path(const std::string& bytes);
    [[nodiscard]] MeshDocument
    ground_of(const TileId& tile, const glm::dmat4& to_tile, TileContent& content) const;
    void add_trees(const TileId& tile,
                   const glm::dmat4& to_tile,
                   TileDocument& document,
                   TileContent& content) const;
};

TileForest::TileForest(std::unique_ptr<State> state) : state_(std::move(state)) {}
TileForest::TileForest(TileForest&& other) noexcept = default;
TileForest& TileForest::operator=(TileForest&& other) noexcept = default;
TileForest::~TileForest() = default;

const std::vector<TileLevel>& TileForest::levels() const {
    return state_->levels;
}
const std::vector<TileFile>& TileForest::files() const {
    return state_->files;
}
std::string TileForest::path_of(const TileId& tile) {
    return fmt::format("{}/{}/{}.glb", tile.level, tile.column, tile.row);
}

std::vector<TileId> TileForest::tiles(std::uint32_t level) const {
    std::vector<TileId> list;
    const std::uint32_t side = 1U << level;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const Region region = state_->region_of({level, column, row});
            if (region.width > 0.0 && region.depth > 0.0) {
                list.push_back({level, column, row});
            }
        }
    }
    return list;
}

/// Numbers the heroes of each kind, and finds the hero of every tree.
void TileForest::State::find_heroes() {
    std::size_t kinds = 0;
    std::size_t instances = 0;
    for (const ForestSpecies& species : grown.forest.species) {
        first_kind.push_back(kinds);
        kinds += species.stages.size();
        for (const ForestStage& stage : species.stages) {
            first_instance.push_back(instances);
            instances += stage.cache.instances.size();
        }
    }
    hero_of_instance.resize(instances);
    for (std::size_t i = 0; i < heroes.size(); ++i) {
        const Hero& hero = heroes[i];
        const std::size_t kind = first_kind[hero.species] + hero.stage;
        hero_of_instance[first_instance[kind] + hero.instance] = i;
    }
    hero_of_tree.reserve(grown.forest.trees.size());
    for (const Tree& tree : grown.forest.trees) {
        TreeExpander expander(grown.forest.cache_of(tree), grown.forest.key);
        const std::size_t kind = kind_of(tree.species, grown.forest.stage_of(tree));
        const std::size_t hero =
            hero_of_instance[first_instance[kind] + expander.root_instance(tree)];
        hero_of_tree.push_back(hero);
        largest_extent =
            std::max(largest_extent, static_cast<double>(tree.scale * heroes[hero].extent()));
    }
}

void TileForest::State::sort_trees() {
    const auto& trees = grown.forest.trees;
    const std::uint32_t side = 1U << finest();
    const auto cell = [&](double at) {
        const double number = std::floor(at / levels.back().side);
        return static_cast<std::uint32_t>(std::clamp(number, 0.0, static_cast<double>(side - 1)));
    };
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    keyed.reserve(trees.size());
    for (std::uint32_t i = 0; i < trees.size(); ++i) {
        const glm::dvec3 at(trees[i].position);
        keyed.emplace_back(morton_code(cell(at.x - square.x), cell(at.z - square.z)), i);
    }
    std::sort(keyed.begin(), keyed.end());
    for (const auto& [key, tree] : keyed) {
        order_keys.push_back(key);
        order.push_back(tree);
    }
}

void TileForest::State::plan_levels() {
    const Region& ground = scene.terrain.region;
    square = {ground.x, ground.z, std::max(ground.width, ground.depth),
              std::max(ground.width, ground.depth)};
    const double density = static_cast<double>(grown.forest.trees.size()) / ground.area();
    // Triangles per tree, if all heroes have the same number of trees.
    const auto mean_triangles = [&](const auto& level_of) {
        double sum = 0.0;
        for (const Hero& hero : heroes) {
            sum += static_cast<double>(hero.levels.levels[level_of(hero)].triangles);
        }
        return sum / static_cast<double>(std::max<std::size_t>(heroes.size(), 1));
    };
    const double budget = static_cast<double>(options.triangles);
    const double finest_triangles = mean_triangles([](const Hero&) { return std::size_t{0}; });
    const double coarsest_triangles =
        mean_triangles([](const Hero& hero) { return hero.levels.levels.size() - 1; });
    std::uint32_t depth = 0;
    const auto mean_trees = [&](std::uint32_t level) {
        const double side = square.width / static_cast<double>(1U << level);
        return density * std::min(side * side, ground.area());
    };
    while (depth < kMaxTileLevel && mean_trees(depth) * finest_triangles > budget &&
           mean_trees(depth + 1) >= kMinTileTrees) {
        ++depth;
    }
    levels.resize(depth + 1);
    detail.resize(depth + 1);
    std::vector<float> max_scales(heroes.size(), 0.0F);
    for (std::size_t i = 0; i < hero_of_tree.size(); ++i) {
        float& scale = max_scales[hero_of_tree[i]];
        scale = std::max(scale, grown.forest.trees[i].scale);
    }
    ground_errors.resize(depth + 1);
    cells.resize(depth + 1);
    double error = 0.0;
    for (std::uint32_t up = 0; up <= depth; ++up) {
        const std::uint32_t number = depth - up;
        TileLevel& level = levels[number];
        level.side = square.width / static_cast<double>(1U << number);
        level.trees = mean_trees(number);
        level.has_trees = up == 0 || (levels[number + 1].has_trees &&
                                      level.trees <= static_cast<double>(kMaxTileTrees) &&
                                      level.trees * coarsest_triangles <= budget);
        if (!level.has_trees) {
            // A canopy may be off by the height of a tree, and its colours by half a cell.
            cells[number] = kCanopyCells;
            ground_errors[number] = grown.terrain->mesh_error(level.side / kCanopyCells);
            error = std::max(
                {error, largest_extent, ground_errors[number], level.side / kCanopyCells / 2.0});
            level.error = error;
            continue;
        }
        first_tree_level = number;
        std::vector<std::size_t>& chosen = detail[number];
        double tree_error = 0.0;
        for (std::size_t i = 0; i < heroes.size(); ++i) {
            const std::vector<DetailLevel>& chain = heroes[i].levels.levels;
            std::size_t k = up == 0 ? 0 : detail[number + 1][i];
            while (up != 0 && k + 1 < chain.size() &&
                   static_cast<double>(chain[k].triangles) * level.trees > budget) {
                ++k;
            }
            chosen.push_back(k);
            heroes[i].in_use[k] = true;
            level.triangles += chain[k].triangles;
            tree_error = std::max(tree_error, static_cast<double>(chain[k].error * max_scales[i]));
        }
        cells[number] = patch_cells(*grown.terrain, level.side, tree_error);
        ground_errors[number] = grown.terrain->mesh_error(level.side / cells[number]);
        error = std::max({error, tree_error, ground_errors[number]});
        level.triangles /= std::max<std::size_t>(heroes.size(), 1);
        level.error = error;
    }
}

ExportInfo TileForest::State::info_of(const std::string& name) const {
    ExportInfo info;
    info.name = name;
    info.generator = options.generator;
    info.compression = ExportCompression::Meshopt;
    info.buffer_name = "buffer";
    info.picture_prefix = "picture";
    info.threads = 1;
    return info;
}

std::vector<PictureFile> TileForest::State::pictures_of(const Mesh& mesh) const {
    Outcome<std::vector<PictureFile>> pictures =
        make_picture_files(mesh, ExportFormat::Gltf, info_of(""));
    if (!pictures) {
        throw std::bad_alloc(); // its only stop
    }
    return std::move(pictures.value());
}

std::string TileForest::State::picture_path(const std::string& bytes) {
    std::string path =
        fmt::format("pictures/{:016x}.png", mix64(combine_bytes(kPictureHash, bytes)));
    const bool is_known = std::any_of(files.begin(), files.end(),
                                      [&](const TileFile& file) { return file.path == path; });
    if (!is_known) {
        files.push_back({path, bytes});
    }
    return path;
}

/// The document of a mesh, whose pictures become shared files; appends its buffer to `buffer`.
MeshDocument
TileForest::State::model_of(const Mesh& mesh, const std::string& name, std::string& buffer) {
    MeshDocument document = make_mesh_document(mesh, info_of(name));
    document.offset = buffer.size();
    buffer += std::exchange(document.data, {});
    buffer.resize((buffer.size() + 7) / 8 * 8, '\0');
    for (const PictureFile& picture : pictures_of(mesh)) {
        const std::string path = "../../" + picture_path(picture.bytes);
        for (auto& image : document.json["images"]) {
            if (image["uri"] == picture.name) {
                image = {{"uri", path}};
            }
        }
    }
    return document;
}

Outcome<void> TileForest::State::make_models(const Project& project) {
    Step step(project);
    if (!step.take(mesh_heroes(grown, options.mesh, project, heroes))) {
        return step.end();
    }
    models.resize(levels.size());
    hero_bounds.resize(levels.size());
    for (std::uint32_t level = first_tree_level; level < levels.size(); ++level) {
        models[level].resize(heroes.size());
        hero_bounds[level].resize(heroes.size());
        for (std::size_t first = 0; first < heroes.size();) {
            const auto is_same_kind = [&](const Hero& hero) {
                return hero.species == heroes[first].species && hero.stage == heroes[first].stage;
            };
            std::size_t end = first;
            std::string buffer;
            const ForestSpecies& species = grown.forest.species[heroes[first].species];
            const std::string stage =
                species.stages.size() == 1
                    ? std::string()
                    : fmt::format("-n{}", species.stages[heroes[first].stage].generations);
            for (; end < heroes.size() && is_same_kind(heroes[end]); ++end) {
                const std::string name = fmt::format("{}{} {}", species.name, stage, end - first);
                const Mesh& mesh = heroes[end].meshes[detail[level][end]];
                if (mesh.positions.empty()) {
                    continue;
                }
                models[level][end] = model_of(mesh, name, buffer);
                for (const glm::vec3& position : mesh.positions) {
                    hero_bounds[level][end].add(position);
                }
            }
            const std::string path = fmt::format("models/{}-{}{}-{}.bin", heroes[first].species,
                                                 path_part(species.name), stage, level);
            for (std::size_t i = first; i < end; ++i) {
                models[level][i].uri = "../../" + path;
                models[level][i].file_bytes = buffer.size();
            }
            files.push_back({path, std::move(buffer)});
            first = end;
        }
    }
    return step.done();
}

/// Makes the pictures of the ground, and the canopies.
void TileForest::State::make_ground() {
    std::vector<Crown> crowns;
    for (std::size_t i = 0; i < heroes.size(); ++i) {
        crowns.push_back(crown_of(heroes[i].meshes[detail[finest()][i]]));
    }
    if (grown.ground.colour != nullptr) {
        ground_colour = glm::dvec3(mean_colour(*grown.ground.colour));
        Mesh sample; // a triangle, because only materials in use have picture files
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
        ground_picture = "../../" + picture_path(pictures_of(sample).front().bytes);
    }
    if (first_tree_level == 0) {
        return;
    }
    const std::uint32_t across = kCanopyCells << (first_tree_level - 1);
    const double cell = square.width / across;
    Canopy canopy(across, cell);
    const auto cell_index = [&](double at) {
        return static_cast<std::uint32_t>(
            std::clamp(std::floor(at / cell), 0.0, static_cast<double>(across - 1)));
    };
    for (std::size_t i = 0; i < hero_of_tree.size(); ++i) {
        const Tree& tree = grown.forest.trees[i];
        const glm::dvec3 at(tree.position);
        canopy.add(cell_index(at.x - square.x), cell_index(at.z - square.z),
                   crowns[hero_of_tree[i]], static_cast<double>(tree.scale));
    }
    canopies.push_back(std::move(canopy));
    while (canopies.size() < first_tree_level) {
        canopies.push_back(canopies.back().coarser());
    }
    std::reverse(canopies.begin(), canopies.end());
}

MeshDocument TileForest::State::ground_of(const TileId& tile,
                                          const glm::dmat4& to_tile,
                                          TileContent& content) const {
    const TileLevel& level = levels[tile.level];
    const Region region = region_of(tile);
    const Terrain& terrain = *grown.terrain;
    Material material;
    material.name = "ground";
    PatchPlan plan{cells[tile.level], region, earth, to_tile, 0.0, material, {}, {}};
    const auto ground_height = [&terrain](double x, double z) {
        return static_cast<double>(terrain.height(static_cast<float>(x), static_cast<float>(z)));
    };
    // Max vertical distance between this surface and that of a neighbour of the next coarser level.
    plan.skirt = ground_errors[tile.level] + ground_errors[tile.level - std::min(tile.level, 1U)];
    plan.skirt = std::max(plan.skirt, level.has_trees ? 0.0 : largest_extent) + level.side / 1000.0;
    Texture colours;
    const GroundPictures& pictures = grown.ground;
    if (level.has_trees) {
        const bool tiled = pictures.colour != nullptr;
        plan.material.textured = tiled;
        plan.material.picture = pictures.colour;
        plan.material.relief = nullptr;
        plan.material.colour = glm::vec4(tiled ? glm::vec3(1.0F) : glm::vec3(ground_colour), 1.0F);
        const double width = tiled ? pictures.width : region.width;
        const double depth = tiled ? pictures.depth : region.depth;
        const double first_u = std::floor((region.x - pictures.origin_x) / width);
        const double first_v = std::floor((region.z - pictures.origin_z) / depth);
        plan.height = ground_height;
        plan.texture = [&, width, depth, first_u, first_v](std::uint32_t, std::uint32_t, double x,
                                                           double z) {
            return glm::vec2((x - pictures.origin_x) / width - first_u,
                             (z - pictures.origin_z) / depth - first_v);
        };
    } else {
        const Canopy& canopy = canopies[tile.level];
        const double cell = level.side / kCanopyCells;
        const auto canopy_at = [&, cell](double x, double z) {
            return canopy.at_corner(std::llround((x - square.x) / cell),
                                    std::llround((z - square.z) / cell));
        };
        plan.height = [ground_height, canopy_at](double x, double z) {
            return ground_height(x, z) + canopy_at(x, z).height;
        };
        static constexpr std::uint32_t kSide = kCanopyCells + 1;
        colours = {kSide, kSide, std::vector<std::uint8_t>(std::size_t{4} * kSide * kSide)};
        plan.material.textured = true;
        plan.material.roughness = 1.0F;
        plan.texture = [&, canopy_at](std::uint32_t column, std::uint32_t row, double x, double z) {
            const CanopyPoint crowns = canopy_at(x, z);
            const glm::dvec3 colour = glm::mix(ground_colour, crowns.colour, crowns.cover);
            std::uint8_t* const texel = &colours.texels[4 * (std::size_t{row} * kSide + column)];
            for (int i = 0; i < 3; ++i) {
                texel[i] = nearest_srgb_byte(static_cast<float>(colour[i]));
            }
            texel[3] = 255;
            const auto texel_centre = [](std::uint32_t at) {
                return (static_cast<float>(at) + 0.5F) / static_cast<float>(kSide);
            };
            return glm::vec2(texel_centre(column), texel_centre(row));
        };
    }
    Mesh mesh = make_patch(plan);
    if (!level.has_trees) {
        mesh.materials.front().picture = std::make_shared<const Texture>(std::move(colours));
    }
    for (const glm::vec3& position : mesh.positions) {
        widen(content, position);
    }
    MeshDocument document =
        make_mesh_document(mesh, info_of(level.has_trees ? "ground" : "forest"));
    if (!level.has_trees) {
        embed_picture(0, pictures_of(mesh).front().bytes, document);
    } else if (pictures.colour != nullptr) {
        document.json["images"][0]["uri"] = ground_picture;
    }
    return document;
}

void TileForest::State::add_trees(const TileId& tile,
                                  const glm::dmat4& to_tile,
                                  TileDocument& document,
                                  TileContent& content) const {
    const unsigned shift = 2 * (finest() - tile.level);
    const std::uint64_t number = morton_code(tile.column, tile.row);
    const auto first = std::lower_bound(order_keys.begin(), order_keys.end(), number << shift);
    const auto end = std::lower_bound(first, order_keys.end(), (number + 1) << shift);
    std::map<std::size_t, std::vector<TileTree>> groups; // by hero
    for (auto at = first; at != end; ++at) {
        const std::uint32_t index = order[static_cast<std::size_t>(at - order_keys.begin())];
        const Tree& tree = grown.forest.trees[index];
        const std::size_t hero = hero_of_tree[index];
        if (models[tile.level][hero].json.is_null()) {
            continue; // draws nothing
        }
        // Placed at the origin first: binary32 is too coarse for places far from it.
        Tree here = tree;
        here.position = glm::vec3(0.0F);
        const InstanceCache& cache = grown.forest.cache_of(tree);
        InstancePose pose;
        TreeExpander(cache, grown.forest.key).expand(here, [&](const BranchInstance& branch) {
            pose = pose_of(branch, cache.instances[branch.instance]);
        });
        const glm::dvec3 place(tree.position);
        const glm::vec3 foot(
            y_up(glm::dvec3(to_tile * glm::dvec4(earth.place(place.x, place.y, place.z), 1.0))));
        const glm::vec3 above(y_up(
            glm::dvec3(to_tile * glm::dvec4(earth.place(place.x, place.y + 1.0, place.z), 1.0))));
        // Trees stand upright at their place, not at the middle of the tile.
        const glm::vec3 up = glm::normalize(above - foot);
        const glm::quat tilt =
            glm::normalize(glm::quat(1.0F + up.y, up.z, 0.0F, -up.x)); // from +Y to `up`
        const float height = static_cast<float>(tree.scale) *
                             (heroes[hero].bounds.high.y - heroes[hero].bounds.low.y);
        const TileTree placed{tilt * pose.rotation,
                              foot + tilt * pose.translation,
                              pose.scale,
                              height,
                              tree.number,
                              tree.species,
                              tree.age};
        groups[hero].push_back(placed);
        const Bounds& box = hero_bounds[tile.level][hero];
        for_each_corner(box.low, box.high, [&](const glm::vec3& point) {
            widen(content, placed.translation + placed.scale * (placed.rotation * point));
        });
    }
    for (const auto& [hero, trees] : groups) {
        document.add_trees(models[tile.level][hero], trees);
    }
}

TileContent TileForest::content(const TileId& tile) const {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    TileContent content;
    content.low.fill(kInfinite);
    content.high.fill(-kInfinite);
    const glm::dmat4 to_tile = inverse_of_frame(state_->frame_of(tile));
    TileDocument document(state_->options.generator);
    document.add_surface(state_->ground_of(tile, to_tile, content));
    if (state_->levels[tile.level].has_trees) {
        state_->add_trees(tile, to_tile, document, content);
    }
    std::vector<std::string> species;
    for (const ForestSpecies& each : state_->grown.forest.species) {
        species.push_back(each.name);
    }
    content.bytes = document.write(species);
    return content;
}

std::vector<TileFile>
TileForest::tilesets(const std::vector<std::vector<TileContent>>& contents) const {
    TilesetPlan plan{state_->options.generator, state_->square.width, {}, contents, {}};
    for (std::uint32_t level = 0; level < contents.size(); ++level) {
        plan.levels.push_back({state_->levels[level].error, tiles(level)});
    }
    plan.frame_of = [this](const TileId& tile) { return state_->frame_of(tile); };
    return make_tilesets(plan);
}

Outcome<TileForest> make_tile_forest(const Scene& scene,
                                     GrownForest grown,
                                     const TileOptions& options,
                                     const Project& project) {
    Step step(project);
    auto state = std::make_unique<TileForest::State>();
    state->scene = scene;
    state->options = options;
    state->earth = GroundFrame(options.origin);
    state->grown = std::move(grown);
    if (!step.take(plan_heroes(state->grown, options.mesh, project), state->heroes)) {
        return step.end();
    }
    state->find_heroes();
    state->plan_levels();
    state->sort_trees();
    if (!step.take(state->make_models(project))) {
        return step.end();
    }
    state->make_ground();
    return step.done(TileForest(std::move(state)));
}

} // namespace lsys
