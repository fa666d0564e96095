// SPDX-License-Identifier: MIT
// A forest as one mesh: every branch instance gets vertices of its own.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/formats.h"
#include "runtime/meshing/looks.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lsys {

namespace {

/// First the counts of the vertices and indices of a piece of the trees; later the positions in the
/// mesh of the next vertex and of the next index of each material.
struct PieceCounts {
    std::uint64_t vertices = 0;
    std::vector<std::uint64_t> indices; // by material of the scene
};

/// Makes the mesh of all triangles of a forest.
class Baker {
public:
    Baker(const ForestScene& scene, std::uint32_t threads)
        : scene_(scene), threads_(threads), plan_(scene, 0.0F, threads),
          materials_(find_forest_materials(scene, plan_)) {
        for (const ExportedStage& stage : plan_.stages()) {
            instance_vertices_.push_back(number_vertices(stage, plan_));
            const Mesh& from = stage.meshes->mesh;
            if (stage.trees > 0) {
                drop_missing_arrays(from);
            }
        }
        if (scene.ground != nullptr) {
            drop_missing_arrays(*scene.ground);
        }
        for (std::uint32_t s = 0; s < scene.meshes.size(); ++s) {
            first_stage_.push_back(stage_count_);
            stage_count_ += scene.meshes[s].size();
        }
    }

    Outcome<Mesh> bake(std::uint64_t max_bytes) {
        const auto limit = [max_bytes]() -> Outcome<Mesh> {
            return {Stop::Limit,
                    messages_of(plant_limit_diagnostic("the baked forest", max_bytes))};
        };
        if (plan_.triangle_count() > max_bytes / (3 * sizeof(std::uint32_t))) {
            return limit(); // before the slow counting of pieces
        }
        count_pieces();
        std::uint64_t vertices = ground_vertices();
        for (PieceCounts& counts : piece_counts_) {
            vertices += std::exchange(counts.vertices, vertices);
        }
        std::uint64_t indices = 0;
        for (std::uint32_t m = 0; m < materials_.samples.materials.size(); ++m) {
            const std::uint64_t first = indices;
            next_ground_index_.push_back(indices);
            indices += ground_indices(m);
            for (PieceCounts& counts : piece_counts_) {
                indices += std::exchange(counts.indices[m], indices);
            }
            if (indices > first) {
                mesh_.parts.push_back(
                    {static_cast<std::uint32_t>(mesh_.materials.size()), first, indices - first});
                mesh_.materials.push_back(materials_.samples.materials[m]);
            }
        }
        if (vertices > std::numeric_limits<std::uint32_t>::max()) {
            return {Stop::Failed,
                    messages_of("the baked forest has more than 4,294,967,295 vertices; without "
                                "--bake, branches are instances")};
        }
        const std::uint64_t vertex_bytes =
            2 * sizeof(glm::vec3) + (textured_ ? sizeof(glm::vec2) : 0) +
            (tangents_ ? sizeof(glm::vec4) : 0) + (colours_ ? sizeof(ItemColour) : 0);
        if (vertices * vertex_bytes + indices * sizeof(std::uint32_t) > max_bytes) {
            return limit();
        }
        mesh_.positions.resize(vertices);
        mesh_.normals.resize(vertices);
        mesh_.texture_coordinates.resize(textured_ ? vertices : 0);
        mesh_.tangents.resize(tangents_ ? vertices : 0);
        mesh_.colours.resize(colours_ ? vertices : 0);
        indices_.resize(indices);
        put_ground();
        put_trees();
        mesh_.indices = std::move(indices_);
        return {std::move(mesh_), {}};
    }

private:
    /// Clears the flags of optional arrays that `mesh` lacks.
    void drop_missing_arrays(const Mesh& mesh) {
        textured_ = textured_ && is_complete(mesh, mesh.texture_coordinates);
        tangents_ = tangents_ && is_complete(mesh, mesh.tangents);
        colours_ = colours_ && is_complete(mesh, mesh.colours);
    }
    [[nodiscard]] std::uint64_t ground_vertices() const {
        return scene_.ground == nullptr ? 0 : scene_.ground->positions.size();
    }
    [[nodiscard]] std::uint64_t ground_indices(std::uint32_t material) const {
        std::uint64_t count = 0;
        for (std::size_t p = 0; scene_.ground != nullptr && p < scene_.ground->parts.size(); ++p) {
            const MeshPart& part = scene_.ground->parts[p];
            count += materials_.of_ground[part.material] == material ? part.index_count : 0;
        }
        return count;
    }

    /// Calls visit(index of the stage in ForestPlan::stages(), branch) for each branch of `trees`.
    template <typename Visit>
    void for_each_branch(std::span<const Tree> trees, const Visit& visit) const {
        std::vector<TreeExpander> expanders;
        expanders.reserve(stage_count_);
        for (const ExportedStage& stage : plan_.stages()) {
            expanders.emplace_back(*stage.cache, scene_.forest.key);
        }
        for (const Tree& tree : trees) {
            const std::size_t k = first_stage_[tree.species] + scene_.forest.stage_of(tree);
            expanders[k].expand(tree, [&](const BranchInstance& branch) { visit(k, branch); });
        }
    }

    void count_pieces() {
        piece_counts_.resize(piece_count(scene_.forest));
        for (PieceCounts& counts : piece_counts_) {
            counts.indices.resize(materials_.samples.materials.size());
        }
        for_each_piece(
            scene_.forest, threads_, [&](std::uint64_t piece, std::span<const Tree> trees) {
                PieceCounts& counts = piece_counts_[piece];
                for_each_branch(trees, [&](std::size_t k, const BranchInstance& branch) {
                    counts.vertices += instance_vertices_[k].of(branch.instance).size();
                    const ExportedStage& stage = plan_.stages()[k];
                    for (const MeshPart& part : stage.meshes->parts_of(branch.instance)) {
                        counts.indices[materials_.of_stages[k][part.material]] += part.index_count;
                    }
                });
            });
    }

    void put_ground() {
        if (scene_.ground == nullptr) {
            return;
        }
        const Mesh& ground = *scene_.ground;
        std::copy(ground.positions.begin(), ground.positions.end(), mesh_.positions.begin());
        std::copy(ground.normals.begin(), ground.normals.end(), mesh_.normals.begin());
        copy(textured_, ground.texture_coordinates, mesh_.texture_coordinates);
        copy(tangents_, ground.tangents, mesh_.tangents);
        copy(colours_, ground.colours, mesh_.colours);
        for (const MeshPart& part : ground.parts) {
            std::uint64_t& at = next_ground_index_[materials_.of_ground[part.material]];
            ground.indices.read(part.first_index,
                                std::span(indices_).subspan(at, part.index_count));
            at += part.index_count;
        }
    }
    template <typename Items>
    static void copy(bool wanted, const Items& from, Items& to) {
        if (wanted) {
            std::copy(from.begin(), from.end(), to.begin());
        }
    }

    void put_trees() {
        for_each_piece(scene_.forest, threads_,
                       [&](std::uint64_t piece, std::span<const Tree> trees) {
                           PieceCounts& counts = piece_counts_[piece];
                           for_each_branch(trees, [&](std::size_t k, const BranchInstance& branch) {
                               put_branch(k, branch, counts);
                           });
                       });
    }

    void put_branch(std::size_t k, const BranchInstance& branch, PieceCounts& counts) {
        const ExportedStage& stage = plan_.stages()[k];
        const Mesh& from = stage.meshes->mesh;
        const InstancePose pose = pose_of(branch, stage.cache->instances[branch.instance]);
        const glm::mat3 turn = glm::mat3_cast(pose.rotation);
        const glm::mat3 turn_and_scale = pose.scale * turn;
        std::uint64_t at = counts.vertices;
        for (const std::uint32_t vertex : instance_vertices_[k].of(branch.instance)) {
            mesh_.positions[at] = pose.translation + turn_and_scale * from.positions[vertex];
            mesh_.normals[at] = turn * from.normals[vertex];
            if (textured_) {
                mesh_.texture_coordinates[at] = from.texture_coordinates[vertex];
            }
            if (tangents_) {
                const glm::vec4& tangent = from.tangents[vertex];
                mesh_.tangents[at] = glm::vec4(turn * glm::vec3(tangent), tangent.w);
            }
            if (colours_) {
                mesh_.colours[at] = without_look(from.looks.get(), from.colours[vertex]);
            }
            ++at;
        }
        const auto base = static_cast<std::uint32_t>(counts.vertices);
        for (const MeshPart& part : stage.meshes->parts_of(branch.instance)) {
            std::uint64_t& to = counts.indices[materials_.of_stages[k][part.material]];
            for (std::uint64_t i = 0; i < part.index_count; ++i) {
                indices_[to++] = base + instance_vertices_[k].indices[part.first_index + i];
            }
        }
        counts.vertices = at;
    }

    const ForestScene& scene_;
    std::uint32_t threads_;
    Mesh mesh_;
    ForestPlan plan_;
    ForestMaterials materials_;
    std::vector<InstanceVertices> instance_vertices_; // by stage
    std::vector<std::size_t> first_stage_;            // by species: index in plan_.stages()
    std::size_t stage_count_ = 0;
    std::vector<PieceCounts> piece_counts_;
    LargeVector<std::uint32_t> indices_;           // moved into mesh_ when complete
    std::vector<std::uint64_t> next_ground_index_; // by material
    // Whether the mesh gets the optional array, because all surfaces have it.
    bool textured_ = true;
    bool tangents_ = true;
    bool colours_ = true;
};

} // namespace

Outcome<Mesh>
bake_forest(const ForestScene& scene, std::uint64_t max_bytes, std::uint32_t threads) {
    return run_within_memory("the baked forest",
                             [&] { return Baker(scene, threads).bake(max_bytes); });
}

} // namespace lsys
