// SPDX-License-Identifier: MIT
#include "viewer/scene/forest_model.h"

#include "grammar/base/hash.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace lsys::view {

namespace {

/// By level: min radius of twigs, as a fraction of the tree's height.
constexpr std::array<float, kTreeLevels> kMinTwigRadius = {0.0F, 0.0F, 0.0008F, 0.0016F};
/// By level: number of leaves of which one is shown.
constexpr std::array<std::uint32_t, kTreeLevels> kLeavesPerShownLeaf = {1, 1, 2, 4};
/// Max number of impostors of all forms together; if there are more forms, each has one impostor.
constexpr std::size_t kMaxTotalImpostors = 16;
/// Min number of leaves of an instance for thinning; if there are fewer, all are shown.
constexpr std::size_t kMinThinnedLeaves = 24;

/// Max number of impostors of each form, if there are `forms` forms.
std::size_t max_impostors_of(std::size_t forms) {
    return std::clamp<std::size_t>(kMaxTotalImpostors / std::max<std::size_t>(forms, 1), 1,
                                   kMaxImpostors);
}

bool is_leaf(const PlacedObject& object) {
    return object.kind == TurtleOperation::Leaf || object.kind == TurtleOperation::MeshFile ||
           object.kind == TurtleOperation::Flower;
}

/// Whether a leaf is shown. The leaves of a coarser level are a subset of those of a finer level.
bool is_shown(std::size_t leaf, std::uint32_t leaves_per_shown_leaf) {
    const std::uint64_t mixed = golden_multiple(std::uint64_t{leaf} + 1);
    return (mixed >> 40 & (leaves_per_shown_leaf - 1)) == 0;
}

Sphere sphere_around(const Bounds& bounds) {
    if (bounds.empty) {
        return {};
    }
    return {0.5F * (bounds.low + bounds.high), 0.5F * glm::distance(bounds.low, bounds.high)};
}

/// The smallest sphere that encloses both spheres.
Sphere joined(const Sphere& a, const Sphere& b) {
    const float distance = glm::distance(a.centre, b.centre);
    if (distance + b.radius <= a.radius) {
        return a;
    }
    if (distance + a.radius <= b.radius) {
        return b;
    }
    const float radius = 0.5F * (distance + a.radius + b.radius);
    return {a.centre + (b.centre - a.centre) * ((radius - a.radius) / distance),
            radius * 1.0001F}; // larger, to cover rounding errors
}

/// Finds the first tree whose first instance is the whole plant `instance`.
bool find_impostor(const InstanceCache& cache,
                   std::uint64_t key,
                   std::uint32_t instance,
                   Tree& tree) {
    constexpr std::uint32_t kMaxTries = 4096;
    TreeExpander expander(cache, key);
    for (tree.number = 0; tree.number < kMaxTries; ++tree.number) {
        if (expander.root_instance(tree) == instance) {
            return true;
        }
    }
    return false;
}

void find_impostors(TreeForm& form, std::uint64_t key, std::size_t max_count) {
    const InstanceCache& cache = *form.cache;
    const InstanceSlot& whole = cache.slots[0];
    form.impostor_of.assign(cache.instances.size(), 0);
    for (std::uint32_t v = 0; v < whole.variant_count; ++v) {
        const std::uint32_t instance = cache.variants[whole.first_variant + v];
        Tree tree;
        if (form.impostor_trees.size() < max_count && find_impostor(cache, key, instance, tree)) {
            form.impostor_of[instance] = static_cast<std::uint32_t>(form.impostor_trees.size());
            form.impostor_trees.push_back(tree);
        } else {
            form.impostor_of[instance] = static_cast<std::uint32_t>(v % max_count);
        }
    }
    for (std::uint32_t& impostor : form.impostor_of) {
        impostor = std::min(impostor, static_cast<std::uint32_t>(form.impostor_trees.size()) - 1);
    }
}

/// Computes the bounding cylinder of form.impostor_trees and the mean number of their branches.
/// `meshes`: meshes of the branches.
void measure_impostors(TreeForm& form, std::uint64_t key, const InstanceMeshes& meshes) {
    const LargeVector<std::uint32_t> indices = meshes.mesh.indices.expanded();
    const LargeVector<glm::vec3>& positions = meshes.mesh.positions;
    TreeExpander expander(*form.cache, key);
    const auto count = static_cast<double>(form.impostor_trees.size());
    float radius2 = 0.0F;
    for (const Tree& tree : form.impostor_trees) {
        expander.expand(tree, [&](const BranchInstance& branch) {
            form.branches += 1.0 / count;
            const InstancePose pose = pose_of(branch, form.cache->instances[branch.instance]);
            const glm::mat3 turn = pose.scale * glm::mat3_cast(pose.rotation);
            for (const MeshPart& part : meshes.parts_of(branch.instance)) {
                for (std::uint64_t i = 0; i < part.index_count; ++i) {
                    const glm::vec3 at =
                        turn * positions[indices[part.first_index + i]] + pose.translation;
                    radius2 = std::max(radius2, at.x * at.x + at.z * at.z);
                    form.low = std::min(form.low, at.y);
                    form.high = std::max(form.high, at.y);
                }
            }
        });
    }
    form.radius = std::sqrt(radius2);
}

/// By instance: bounding box of its triangles at all levels, in the frame of its entry.
std::vector<Bounds> bounds_of_levels(const InstanceCache& cache, const TreeMeshes& levels) {
    std::vector<Bounds> all(cache.instances.size());
    for (const InstanceMeshes& level : levels) {
        const std::vector<Bounds> bounds = bounds_of(cache, level);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!bounds[i].empty) {
                all[i].add(bounds[i].low);
                all[i].add(bounds[i].high);
            }
        }
    }
    return all;
}

/// By instance: bounding sphere of its box in `bounds`. A box is in the frame of the instance's
/// entry, a sphere in the frame of the heroes.
std::vector<Sphere> spheres_in_heroes(const InstanceCache& cache,
                                      const std::vector<Bounds>& bounds) {
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (bounds[i].empty) {
            spheres.push_back({{}, -1.0F});
            continue;
        }
        const Instance& instance = cache.instances[i];
        const Sphere sphere = sphere_around(bounds[i]);
        spheres.push_back({glm::vec3(instance.position) + glm::quat(instance.frame) * sphere.centre,
                           sphere.radius});
    }
    return spheres;
}

std::optional<Stop> make_form(const InstanceCache& cache,
                              std::uint64_t key,
                              const std::vector<UserMesh>& user_meshes,
                              const MeshOptions& options,
                              std::size_t max_impostors,
                              TreeForm& form) {
    form.cache = &cache;
    const auto meshes = std::make_shared<TreeMeshes>();
    TreeMeshes& levels = *meshes;
    form.meshes = meshes;
    MeshOptions level_options = options;
    level_options.tangents = false;
    level_options.colours = false;
    std::optional<Stop> stop = make_instance_meshes(cache, user_meshes, level_options, levels[0]);
    if (stop) {
        return stop;
    }
    find_impostors(form, key, max_impostors);
    measure_impostors(form, key, levels[0]);
    for (std::uint32_t level = 1; level < kTreeLevels; ++level) {
        level_options.level = options.level + level;
        stop = make_instance_meshes(coarsened(cache, level, form.height()), user_meshes,
                                    level_options, levels[level]);
        if (stop) {
            return stop;
        }
    }
    for (std::uint32_t level = 0; level < kTreeLevels; ++level) {
        form.mesh_triangles[level].resize(cache.instances.size());
        for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
            form.mesh_triangles[level][i] =
                static_cast<std::uint32_t>(levels[level].triangle_count_of(i));
        }
    }
    const std::vector<Bounds> bounds = bounds_of_levels(cache, levels);
    form.sphere = bounding_spheres(cache, bounds)[0];
    form.mesh_spheres = spheres_in_heroes(cache, bounds);
    TreeExpander expander(cache, key);
    const auto count = static_cast<double>(form.impostor_trees.size());
    for (const Tree& tree : form.impostor_trees) {
        expander.expand(tree, [&](const BranchInstance& branch) {
            for (std::uint32_t level = 0; level < kTreeLevels; ++level) {
                form.triangles[level] += form.mesh_triangles[level][branch.instance] / count;
            }
        });
    }
    return std::nullopt;
}

} // namespace

std::uint64_t ForestModel::mesh_bytes() const {
    std::uint64_t bytes = 0;
    for (const TreeForm& form : forms) {
        for (std::size_t l = 0; form.meshes != nullptr && l < kTreeLevels; ++l) {
            bytes += (*form.meshes)[l].byte_count();
        }
    }
    return bytes;
}

std::vector<Bounds> bounds_of(const InstanceCache& cache, const InstanceMeshes& meshes) {
    const LargeVector<std::uint32_t> indices = meshes.mesh.indices.expanded();
    std::vector<Bounds> bounds(cache.instances.size());
    for (std::uint32_t i = 0; i < bounds.size(); ++i) {
        const Instance& instance = cache.instances[i];
        const glm::quat inverse = glm::conjugate(glm::quat(instance.frame));
        for (const MeshPart& part : meshes.parts_of(i)) {
            for (std::uint64_t k = 0; k < part.index_count; ++k) {
                const glm::vec3& at = meshes.mesh.positions[indices[part.first_index + k]];
                bounds[i].add(inverse * (at - glm::vec3(instance.position)));
            }
        }
    }
    return bounds;
}

std::vector<Sphere> bounding_spheres(const InstanceCache& cache,
                                     const std::vector<Bounds>& bounds) {
    std::vector<Sphere> spheres(cache.slots.size());
    std::vector<bool> known(cache.slots.size());
    // Depth first: slots at the exits of an instance are handled before the slot of the instance.
    std::vector<std::uint32_t> pending{0};
    std::vector<bool> begun(cache.slots.size());
    while (!pending.empty()) {
        const std::uint32_t index = pending.back();
        const InstanceSlot& slot = cache.slots[index];
        if (known[index]) {
            pending.pop_back();
            continue;
        }
        const bool again = begun[index];
        begun[index] = true;
        bool waits = false;
        for (std::uint32_t v = 0; v < slot.variant_count && !again; ++v) {
            const Instance& instance = cache.instances[cache.variants[slot.first_variant + v]];
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                const std::uint32_t next = cache.exits[instance.first_exit + e].slot;
                if (!known[next] && !begun[next]) {
                    pending.push_back(next);
                    waits = true;
                }
            }
        }
        if (waits) {
            continue;
        }
        Sphere all;
        for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
            const std::uint32_t i = cache.variants[slot.first_variant + v];
            const Instance& instance = cache.instances[i];
            Sphere sphere = sphere_around(bounds[i]);
            for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
                const InstanceExit& exit = cache.exits[instance.first_exit + e];
                const Sphere& further = spheres[exit.slot];
                sphere = joined(sphere,
                                {exit.position + exit.rotation * further.centre, further.radius});
            }
            all = v == 0 ? sphere : joined(all, sphere);
        }
        spheres[index] = all;
        known[index] = true;
        pending.pop_back();
    }
    return spheres;
}

InstanceCache coarsened(const InstanceCache& cache, std::uint32_t level, float height) {
    InstanceCache coarse = cache;
    Skeleton& skeleton = coarse.skeleton;
    const float thinnest = kMinTwigRadius[level] * height;
    for (Segment& segment : skeleton.segments) {
        if (std::max(segment.base_radius, segment.tip_radius) < thinnest) {
            segment.base_radius = 0.0F;
            segment.tip_radius = 0.0F;
        }
    }
    const std::uint32_t leaves_per_shown_leaf = kLeavesPerShownLeaf[level];
    const float larger = std::sqrt(static_cast<float>(leaves_per_shown_leaf));
    const std::size_t heroes = std::max(cache.heroes, 1U);
    if (skeleton.objects.size() >= kMinThinnedLeaves * heroes) {
        for (std::size_t i = 0; i < skeleton.objects.size(); ++i) {
            PlacedObject& object = skeleton.objects[i];
            if (is_leaf(object)) {
                object.size *= is_shown(i, leaves_per_shown_leaf) ? larger : 0.0F;
            }
        }
    }
    if (skeleton.polygons.size() >= kMinThinnedLeaves * heroes) {
        for (std::size_t i = 0; i < skeleton.polygons.size(); ++i) {
            const Polygon& polygon = skeleton.polygons[i];
            const float factor = is_shown(i, leaves_per_shown_leaf) ? larger : 0.0F;
            const glm::vec3 stem = skeleton.corners[polygon.first_corner];
            for (std::uint32_t c = 1; c < polygon.corner_count; ++c) {
                glm::vec3& corner = skeleton.corners[polygon.first_corner + c];
                corner = stem + factor * (corner - stem);
            }
        }
    }
    return coarse;
}

std::optional<Stop> make_forest_model(const Forest& forest,
                                      const Terrain& terrain,
                                      const std::vector<std::vector<UserMesh>>& user_meshes,
                                      const MeshOptions& options,
                                      ForestModel& model,
                                      const KnownModel& known) {
    model = {};
    model.forest = &forest;
    model.terrain = &terrain;
    std::size_t forms = 0;
    for (const ForestSpecies& species : forest.species) {
        forms += species.stages.size();
    }
    const std::size_t max_impostors = max_impostors_of(forms);
    const bool can_reuse = known.model != nullptr && known.key == forest.key &&
                           known.options == options &&
                           max_impostors == max_impostors_of(known.model->forms.size());
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        model.first_form.push_back(static_cast<std::uint32_t>(model.forms.size()));
        if (can_reuse && known.species[s]) {
            const std::uint32_t first = known.model->first_form[*known.species[s]];
            for (std::uint32_t i = 0; i < forest.species[s].stages.size(); ++i) {
                TreeForm& form = model.forms.emplace_back(known.model->forms[first + i]);
                form.cache = &forest.species[s].stages[i].cache;
            }
            continue;
        }
        for (const ForestStage& stage : forest.species[s].stages) {
            if (const std::optional<Stop> stop =
                    make_form(stage.cache, forest.key, user_meshes[s], options, max_impostors,
                              model.forms.emplace_back())) {
                return stop;
            }
        }
    }
    return std::nullopt;
}

} // namespace lsys::view
