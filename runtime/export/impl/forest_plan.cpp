// SPDX-License-Identifier: MIT
#include "runtime/export/impl/forest_plan.h"

#include "grammar/base/contract.h"
#include "runtime/base/workers.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/material_samples.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lsys {

namespace {

constexpr std::uint64_t kPieceTrees = 512;

} // namespace

ForestPlan::ForestPlan(const ForestScene& scene, float cell, std::uint32_t threads)
    : scene_(scene) {
    const Forest& forest = scene.forest;
    LSYS_CHECK(scene.meshes.size() == forest.species.size(), scene.meshes.size());
    std::uint32_t instances = 0;
    for (std::uint32_t s = 0; s < forest.species.size(); ++s) {
        first_stage_.push_back(static_cast<std::uint32_t>(stages_.size()));
        LSYS_CHECK(scene.meshes[s].size() == forest.species[s].stages.size(), s);
        for (std::uint32_t i = 0; i < scene.meshes[s].size(); ++i) {
            const InstanceCache& cache = forest.species[s].stages[i].cache;
            stages_.push_back({s, i, instances, &cache, &scene.meshes[s][i], 0});
            instances += static_cast<std::uint32_t>(cache.instances.size());
        }
    }
    instance_counts_.assign(instances, 0);
    for (const Tree& tree : forest.trees) {
        ++stages_[first_stage_[tree.species] + forest.stage_of(tree)].trees;
    }
    sort_trees(cell);
    split_cells_into_pieces();
    count_pieces(threads);
    find_groups();
}

void ForestPlan::sort_trees(float cell) {
    const LargeVector<Tree>& trees = scene_.forest.trees;
    if (!(cell > 0.0F)) {
        if (!trees.empty()) {
            cells_.emplace_back().tree_count = trees.size();
        }
        return;
    }
    const auto place = [cell](float at) {
        return static_cast<std::int64_t>(
            std::floor(static_cast<double>(at) / static_cast<double>(cell)));
    };
    std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> numbers; // by z and x
    LargeVector<std::uint32_t> cell_of_tree;
    cell_of_tree.resize(trees.size());
    std::vector<std::uint64_t> counts;
    for (std::size_t i = 0; i < trees.size(); ++i) {
        const auto [found, is_new] =
            numbers.emplace(std::pair(place(trees[i].position.z), place(trees[i].position.x)),
                            static_cast<std::uint32_t>(counts.size()));
        if (is_new) {
            counts.push_back(0);
        }
        cell_of_tree[i] = found->second;
        ++counts[found->second];
    }
    std::vector<std::uint64_t> next(counts.size());
    std::uint64_t first = 0;
    for (const auto& [at, number] : numbers) {
        ForestCell& new_cell = cells_.emplace_back();
        new_cell.x = at.second;
        new_cell.z = at.first;
        new_cell.first_tree = first;
        new_cell.tree_count = counts[number];
        next[number] = first;
        first += counts[number];
    }
    tree_of_place_.resize(trees.size());
    for (std::size_t i = 0; i < trees.size(); ++i) {
        tree_of_place_[next[cell_of_tree[i]]++] = static_cast<std::uint32_t>(i);
    }
}

std::vector<TreeExpander> ForestPlan::make_expanders() const {
    std::vector<TreeExpander> expanders;
    expanders.reserve(stages_.size());
    for (const ExportedStage& stage : stages_) {
        expanders.emplace_back(*stage.cache, scene_.forest.key);
    }
    return expanders;
}

void ForestPlan::split_cells_into_pieces() {
    for (ForestCell& cell : cells_) {
        cell.first_piece = pieces_.size();
        for (std::uint64_t done = 0; done < cell.tree_count; done += kPieceTrees) {
            pieces_.push_back(
                {cell.first_tree + done, std::min(kPieceTrees, cell.tree_count - done), {}});
        }
        cell.piece_count = pieces_.size() - cell.first_piece;
    }
}

void ForestPlan::count_pieces(std::uint32_t threads) {
    Workers(threads).for_each(pieces_.size(), [this](std::uint64_t number) {
        ForestPiece& piece = pieces_[number];
        std::vector<TreeExpander> expanders = make_expanders();
        std::vector<std::uint32_t> counts(instance_counts_.size(), 0);
        for (std::uint64_t i = 0; i < piece.tree_count; ++i) {
            const Tree& tree = tree_at(piece.first_tree + i);
            const ExportedStage& stage = stage_of(tree);
            std::uint32_t* const of_stage = counts.data() + stage.first;
            expanders[static_cast<std::size_t>(&stage - stages_.data())].expand_instances(
                tree, [of_stage](std::uint32_t instance) { ++of_stage[instance]; });
        }
        for (const ExportedStage& stage : stages_) {
            for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
                if (counts[stage.first + i] > 0 && stage.meshes->triangle_count_of(i) > 0) {
                    piece.counts_before.emplace_back(stage.first + i, counts[stage.first + i]);
                }
            }
        }
    });
}

void ForestPlan::find_groups() {
    std::map<std::uint32_t, std::uint64_t> counts; // of a cell, by instance
    for (ForestCell& cell : cells_) {
        counts.clear();
        for (ForestPiece& piece : std::span(pieces_).subspan(cell.first_piece, cell.piece_count)) {
            for (auto& [instance, count] : piece.counts_before) {
                std::uint64_t& before = counts[instance];
                before += std::exchange(count, before);
            }
        }
        cell.first_group = groups_.size();
        cell.group_count = counts.size();
        for (const auto& [instance, count] : counts) {
            groups_.push_back({instance, branch_count_ + cell.branches, count});
            cell.branches += count;
            instance_counts_[instance] += count;
            const ExportedStage& stage = stage_of_instance(instance);
            triangle_count_ += stage.meshes->triangle_count_of(instance - stage.first) * count;
        }
        branch_count_ += cell.branches;
    }
    std::erase_if(cells_, [](const ForestCell& cell) { return cell.group_count == 0; });
}

const ExportedStage& ForestPlan::stage_of_instance(std::uint32_t instance) const {
    const auto after = std::upper_bound(
        stages_.begin(), stages_.end(), instance,
        [](std::uint32_t i, const ExportedStage& stage) { return i < stage.first; });
    return *(after - 1);
}

ForestMaterials find_forest_materials(const ForestScene& scene, const ForestPlan& plan) {
    ForestMaterials materials;
    bool textured = true;
    bool tangents = true;
    for (const ExportedStage& stage : plan.stages()) {
        const Mesh& mesh = stage.meshes->mesh;
        std::vector<std::uint32_t>& numbers = materials.of_stages.emplace_back();
        if (stage.trees == 0) {
            continue;
        }
        for (const Material& material : mesh.materials) {
            numbers.push_back(add_material(materials.samples, material));
        }
        textured = textured && is_complete(mesh, mesh.texture_coordinates);
        tangents = tangents && is_complete(mesh, mesh.tangents);
    }
    if (scene.ground != nullptr) {
        for (const Material& material : scene.ground->materials) {
            materials.of_ground.push_back(add_material(materials.samples, material));
        }
    }
    // Makes the names of materials unique: different species may use the same names.
    finish_samples(materials.samples, textured, tangents);
    return materials;
}

InstanceVertices number_vertices(const ExportedStage& stage, const ForestPlan& plan) {
    const Mesh& mesh = stage.meshes->mesh;
    InstanceVertices instance_vertices;
    const LargeVector<std::uint32_t> indices = mesh.indices.expanded();
    instance_vertices.indices.resize(indices.size());
    // For each vertex the last instance that uses it, and the number of the vertex in this
    // instance.
    std::vector<std::uint32_t> last_user(mesh.positions.size(), kNone);
    std::vector<std::uint32_t> numbers(mesh.positions.size());
    for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
        instance_vertices.first.push_back(instance_vertices.vertices.size());
        if (plan.instance_counts()[stage.first + i] == 0) {
            continue;
        }
        for (const MeshPart& part : stage.meshes->parts_of(i)) {
            for (std::uint64_t k = part.first_index; k < part.first_index + part.index_count; ++k) {
                const std::uint32_t vertex = indices[k];
                if (last_user[vertex] != i) {
                    last_user[vertex] = i;
                    numbers[vertex] = static_cast<std::uint32_t>(instance_vertices.vertices.size() -
                                                                 instance_vertices.first[i]);
                    instance_vertices.vertices.push_back(vertex);
                }
                instance_vertices.indices[k] = numbers[vertex];
            }
        }
    }
    instance_vertices.first.push_back(instance_vertices.vertices.size());
    return instance_vertices;
}

} // namespace lsys
