// SPDX-License-Identifier: MIT
#include "runtime/pipeline/forest_lods.h"

#include "runtime/pipeline/hero_levels.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxVertices = std::numeric_limits<std::uint32_t>::max() - 1;
bool is_same(const Material& a, const Material& b) {
    return std::tie(a.name, a.kind, a.two_sided, a.cut_out, a.textured, a.picture, a.normal_map,
                    a.roughness, a.translucency) == std::tie(b.name, b.kind, b.two_sided, b.cut_out,
                                                             b.textured, b.picture, b.normal_map,
                                                             b.roughness, b.translucency) &&
           a.colour == b.colour;
}

template <typename Item>
void append(LargeVector<Item>& to, const LargeVector<Item>& from) {
    for (const Item& item : from) {
        to.push_back(item);
    }
}

/// Appends `mesh` to `all` as the mesh of the next instance, parts in the order of materials.
void add_instance(const Mesh& mesh, InstanceMeshes& all, LargeVector<std::uint32_t>& indices) {
    const auto first_vertex = static_cast<std::uint32_t>(all.mesh.positions.size());
    append(all.mesh.positions, mesh.positions);
    append(all.mesh.normals, mesh.normals);
    append(all.mesh.texture_coordinates, mesh.texture_coordinates);
    append(all.mesh.tangents, mesh.tangents);
    append(all.mesh.colours, mesh.colours);
    all.mesh.looks = mesh.looks;
    std::vector<MeshPart> parts = mesh.parts;
    for (MeshPart& part : parts) {
        const Material& material = mesh.materials[part.material];
        std::vector<Material>& known = all.mesh.materials;
        const auto found = std::find_if(known.begin(), known.end(), [&](const Material& other) {
            return is_same(material, other);
        });
        part.material = static_cast<std::uint32_t>(found - known.begin());
        if (found == known.end()) {
            known.push_back(material);
        }
    }
    std::sort(parts.begin(), parts.end(),
              [](const MeshPart& a, const MeshPart& b) { return a.material < b.material; });
    TriangleReader reader(mesh.indices);
    for (MeshPart& part : parts) {
        const std::uint64_t from = part.first_index;
        part.first_index = indices.size();
        for (std::uint64_t i = 0; i < part.index_count; ++i) {
            indices.push_back(first_vertex + reader[from + i]);
        }
        all.mesh.parts.push_back(part);
    }
}

/// Viewpoint outside the forest, near the tree that is outermost in the direction of the initial
/// camera of lsview.
glm::vec3 edge_viewpoint(const Forest& forest, const std::vector<float>& heights) {
    constexpr float kHorizontalDistance = 3.5F; // horizontal distance / height of the tallest tree
    constexpr float kVerticalDistance = 2.0F;   // vertical distance / height of the tallest tree
    const glm::vec2 outward(0.5665F, 0.8241F);  // of length 1
    float farthest = -std::numeric_limits<float>::infinity();
    glm::vec3 edge(0.0F);
    float height = 0.0F;
    for (std::size_t i = 0; i < forest.trees.size(); ++i) {
        const glm::vec3& at = forest.trees[i].position;
        const float far = glm::dot(glm::vec2(at.x, at.z), outward);
        height = std::max(height, heights[i]);
        if (far > farthest) {
            farthest = far;
            edge = at;
        }
    }
    const glm::vec2 away = kHorizontalDistance * height * outward;
    return edge + glm::vec3(away.x, kVerticalDistance * height, away.y);
}

std::size_t level_for(const DetailLevels& levels, float pixels) {
    std::size_t level = 0;
    while (level + 1 < levels.levels.size() && pixels <= levels.levels[level + 1].pixels) {
        ++level;
    }
    return level;
}

} // namespace

Outcome<ForestLods> make_forest_lods(const GrownForest& grown,
                                     const MeshOptions& options,
                                     std::optional<glm::vec3> viewpoint,
                                     const Project& project) {
    Step step(project);
    std::vector<Hero> heroes;
    if (!step.take(plan_heroes(grown, options, project), heroes)) {
        return step.end();
    }
    const Forest& forest = grown.forest;
    // Key: species, stage and instance.
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, Hero*> hero_of;
    for (Hero& hero : heroes) {
        hero_of[{hero.species, hero.stage, hero.instance}] = &hero;
    }
    std::vector<Hero*> heroes_of_trees;
    std::vector<float> heights;
    for (const Tree& tree : forest.trees) {
        TreeExpander expander(forest.cache_of(tree), forest.key);
        Hero* const hero =
            hero_of.at({tree.species, forest.stage_of(tree), expander.root_instance(tree)});
        heroes_of_trees.push_back(hero);
        heights.push_back(tree.scale * (hero->bounds.high.y - hero->bounds.low.y));
    }
    ForestLods result;
    result.viewpoint = viewpoint.value_or(edge_viewpoint(forest, heights));
    result.forest.key = forest.key;

    // Choose levels by distance. Each combination of species, stage and level in use becomes a
    // species of the result.
    constexpr float kLines = 1080.0F; // pixels, height of the picture for which levels are chosen
    constexpr float kHalfCotangent = 0.8660254F; // 1 / (2 tan 30 degrees)
    using KindKey = std::tuple<std::uint32_t, std::uint32_t, std::size_t>;
    std::map<KindKey, std::uint16_t> kinds;
    std::vector<KindKey> keys_of_trees;
    for (std::size_t i = 0; i < forest.trees.size(); ++i) {
        const Tree& tree = forest.trees[i];
        Hero& hero = *heroes_of_trees[i];
        const glm::vec3 middle = tree.position + glm::vec3(0.0F, 0.5F * heights[i], 0.0F);
        const float size = tree.scale * hero.extent();
        const float distance = std::max(glm::distance(result.viewpoint, middle), 1e-3F * size);
        const std::size_t level =
            level_for(hero.levels, kLines * kHalfCotangent * size / std::max(distance, 1e-30F));
        hero.in_use[level] = true;
        keys_of_trees.emplace_back(hero.species, hero.stage, level);
        kinds.emplace(keys_of_trees.back(), std::uint16_t{0});
    }
    if (!step.take(mesh_heroes(grown, options, project, heroes))) {
        return step.end();
    }

    for (auto& [key, number] : kinds) {
        const auto& [s, stage, level] = key;
        number = static_cast<std::uint16_t>(result.forest.species.size());
        const ForestSpecies& from = forest.species[s];
        ForestSpecies& to = result.forest.species.emplace_back();
        const std::string stage_text = stage_name(from, stage);
        to.name = stage_text.empty() ? fmt::format("{} LOD{}", from.name, level)
                                     : fmt::format("{} {} LOD{}", from.name, stage_text, level);
        to.height = from.height;
        // Copy what TreeExpander needs to choose the instances of trees, without their geometry.
        const InstanceCache& cache = from.stages[stage].cache;
        ForestStage& only = to.stages.emplace_back();
        only.generations = from.stages[stage].generations;
        only.cache.instances = cache.instances;
        for (Instance& instance : only.cache.instances) {
            instance.first_range = 0;
            instance.range_count = 0;
        }
        only.cache.slots = cache.slots;
        only.cache.variants = cache.variants;
        only.cache.exits = cache.exits;
        only.cache.heroes = cache.heroes;
        InstanceMeshes& instance_meshes = result.meshes.emplace_back().emplace_back();
        LargeVector<std::uint32_t> indices;
        for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
            instance_meshes.first_part.push_back(
                static_cast<std::uint32_t>(instance_meshes.mesh.parts.size()));
            const auto found = hero_of.find({s, stage, i});
            if (found == hero_of.end()) {
                continue;
            }
            const Hero& hero = *found->second;
            if (level >= hero.meshes.size() || !hero.in_use[level]) {
                continue;
            }
            const Mesh& mesh = hero.meshes[level];
            if (instance_meshes.mesh.positions.size() + mesh.positions.size() > kMaxVertices) {
                return end_mesh_of_heroes(Stop::Failed, step);
            }
            add_instance(mesh, instance_meshes, indices);
        }
        instance_meshes.first_part.push_back(
            static_cast<std::uint32_t>(instance_meshes.mesh.parts.size()));
        instance_meshes.mesh.indices = TriangleList(std::move(indices));
    }
    for (std::size_t i = 0; i < forest.trees.size(); ++i) {
        Tree tree = forest.trees[i];
        tree.species = kinds.at(keys_of_trees[i]);
        tree.age = 0;
        result.forest.trees.push_back(tree);
    }
    return step.done(std::move(result));
}

} // namespace lsys
