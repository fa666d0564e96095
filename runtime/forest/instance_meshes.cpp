// SPDX-License-Identifier: MIT
#include "runtime/forest/instance_meshes.h"

#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/base/workers.h"
#include "runtime/forest/instance_skeleton.h"
#include "runtime/forest/tree_bounds.h"
#include "runtime/meshing/mesh_items.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace lsys {

namespace {

/// Max number of an item, triangle or part in 32 bits.
constexpr std::uint64_t kMaxNumber = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::uint64_t kInstancesPerPiece = 256;

/// The heroes' skeleton with its forks marked and its items numbered.
Skeleton numbered_heroes(const InstanceCache& cache) {
    Skeleton skeleton = cache.skeleton;
    for (const std::uint32_t segment : forked_segments(cache)) {
        skeleton.segments[segment].forked = true;
    }
    number_items(skeleton);
    return skeleton;
}

/// Cuts the boxes of the heroes where an instance begins, so that no box belongs to two instances.
void cut_instances(const InstanceCache& cache, Skeleton& skeleton) {
    for (const Instance& instance : cache.instances) {
        const std::span<const DrawnRange> ranges =
            std::span(cache.ranges).subspan(instance.first_range, instance.range_count);
        const auto contains = [&](std::uint32_t segment) {
            const auto after = std::upper_bound(
                ranges.begin(), ranges.end(), segment,
                [](std::uint32_t each, const DrawnRange& r) { return each < r.begin.segments; });
            return after != ranges.begin() && segment < std::prev(after)->end.segments;
        };
        for (const DrawnRange& range : ranges) {
            for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
                Segment& segment = skeleton.segments[i];
                if (!segment.linked || (segment.parent >= range.begin.segments &&
                                        segment.parent < range.end.segments)) {
                    continue;
                }
                if (segment.parent == kNoSegment || !contains(segment.parent)) {
                    segment.linked = false;
                    segment.cut = true;
                    if (segment.parent != kNoSegment) {
                        skeleton.segments[segment.parent].forked = true;
                    }
                }
            }
        }
    }
}

/// The triangles made from each segment, object and polygon, in the order of the mesh.
struct ItemTriangles {
    LargeVector<std::uint32_t> first; // by item: its first triangle; last entry: count of triangles
    LargeVector<std::uint32_t> triangles;
};

ItemTriangles find_item_triangles(const Mesh& mesh,
                                  std::span<const std::uint32_t> indices,
                                  std::uint64_t item_count) {
    const std::uint64_t count = indices.size() / 3;
    const auto owner = [&](std::uint64_t triangle) {
        const std::uint32_t item = mesh.segments[indices[3 * triangle]][0];
        LSYS_CHECK(item < item_count, item, item_count);
        return item;
    };
    ItemTriangles result;
    result.first.assign(item_count + 1, 0);
    result.triangles.resize(count);
    for (std::uint64_t t = 0; t < count; ++t) {
        ++result.first[owner(t)];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& first : result.first) {
        sum += std::exchange(first, sum);
    }
    for (std::uint64_t t = 0; t < count; ++t) {
        result.triangles[result.first[owner(t)]++] = static_cast<std::uint32_t>(t);
    }
    for (std::uint64_t i = item_count; i > 0; --i) { // shift the ends back to starts
        result.first[i] = result.first[i - 1];
    }
    result.first[0] = 0;
    return result;
}

/// Counts and writes the triangle lists of instances.
class ListWriter {
public:
    ListWriter(const InstanceCache& cache, const Mesh& mesh)
        : cache_(cache), mesh_(mesh), indices_(mesh.indices.expanded()),
          segment_count_(cache.skeleton.segments.size()),
          polygon_count_(cache.skeleton.polygons.size()),
          item_triangles_(find_item_triangles(
              mesh, indices_, segment_count_ + polygon_count_ + cache.skeleton.objects.size())) {}

    /// Adds the number of indices that the instance has in each part of the mesh to `counts`.
    void count(const Instance& instance, std::span<std::uint64_t> counts) const {
        visit(instance, [&](std::size_t part, std::uint32_t) { counts[part] += 3; });
    }
    /// Writes the instance's indices; `at`: position of the next index of each part.
    void write(const Instance& instance,
               std::span<std::uint64_t> at,
               LargeVector<std::uint32_t>& indices) const {
        visit(instance, [&](std::size_t part, std::uint32_t triangle) {
            const auto from =
                indices_.begin() + static_cast<std::ptrdiff_t>(std::uint64_t{3} * triangle);
            std::copy(from, from + 3, indices.begin() + static_cast<std::ptrdiff_t>(at[part]));
            at[part] += 3;
        });
    }

private:
    template <typename Visit>
    void visit(const Instance& instance, const Visit& visit) const {
        for (std::uint32_t r = 0; r < instance.range_count; ++r) {
            const DrawnRange& range = cache_.ranges[instance.first_range + r];
            visit_run(range.begin.segments, range.end.segments, visit);
            visit_run(segment_count_ + range.begin.polygons, segment_count_ + range.end.polygons,
                      visit);
            visit_run(segment_count_ + polygon_count_ + range.begin.objects,
                      segment_count_ + polygon_count_ + range.end.objects, visit);
        }
    }
    template <typename Visit>
    void visit_run(std::uint64_t begin, std::uint64_t end, const Visit& visit) const {
        std::size_t part = 0;
        for (std::uint64_t item = begin; item < end; ++item) {
            for (std::uint32_t i = item_triangles_.first[item]; i < item_triangles_.first[item + 1];
                 ++i) {
                const std::uint64_t index = std::uint64_t{3} * item_triangles_.triangles[i];
                part = index < mesh_.parts[part].first_index ? 0 : part;
                while (index >= mesh_.parts[part].first_index + mesh_.parts[part].index_count) {
                    ++part;
                }
                visit(part, item_triangles_.triangles[i]);
            }
        }
    }

    const InstanceCache& cache_;
    const Mesh& mesh_;
    LargeVector<std::uint32_t> indices_; // plain indices of the mesh
    std::uint64_t segment_count_;        // of the heroes
    std::uint64_t polygon_count_;
    ItemTriangles item_triangles_;
};

/// Replaces the indices of the heroes' mesh by the lists of indices of all instances.
std::optional<Stop>
list_instances(const InstanceCache& cache, const MeshOptions& options, InstanceMeshes& meshes) {
    Mesh& mesh = meshes.mesh;
    if (mesh.indices.size() / 3 > kMaxNumber) {
        return Stop::Failed;
    }
    const ListWriter lists(cache, mesh);
    mesh.segments = {};
    const std::vector<bool> reached = reached_slots(cache);
    const std::size_t hero_part_count = mesh.parts.size();
    Workers workers(options.threads);
    const auto for_each_reached = [&](const auto& visit) {
        const std::uint64_t pieces =
            (cache.instances.size() + kInstancesPerPiece - 1) / kInstancesPerPiece;
        workers.for_each(pieces, [&](std::uint64_t piece) {
            const std::uint64_t end =
                std::min<std::uint64_t>((piece + 1) * kInstancesPerPiece, cache.instances.size());
            for (std::uint64_t i = piece * kInstancesPerPiece; i < end; ++i) {
                if (reached[cache.instances[i].slot]) {
                    visit(i, cache.instances[i]);
                }
            }
        });
    };
    // By instance and part: first the count of indices, later the position of the next index in
    // `listed`.
    LargeVector<std::uint64_t> index_offsets;
    index_offsets.assign(cache.instances.size() * hero_part_count, 0);
    const auto offsets_of = [&](std::uint64_t instance) {
        return std::span(index_offsets).subspan(instance * hero_part_count, hero_part_count);
    };
    for_each_reached(
        [&](std::uint64_t i, const Instance& instance) { lists.count(instance, offsets_of(i)); });

    std::vector<MeshPart> parts;
    std::uint64_t indices = 0;
    for (std::uint64_t i = 0; i < cache.instances.size(); ++i) {
        meshes.first_part.push_back(static_cast<std::uint32_t>(parts.size()));
        const std::span<std::uint64_t> of_instance = offsets_of(i);
        for (std::size_t part = 0; part < hero_part_count; ++part) {
            if (of_instance[part] > 0) {
                parts.push_back({mesh.parts[part].material, indices, of_instance[part]});
            }
            indices += std::exchange(of_instance[part], indices);
        }
    }
    meshes.first_part.push_back(static_cast<std::uint32_t>(parts.size()));
    if (parts.size() > kMaxNumber) {
        return Stop::Failed;
    }
    const std::uint64_t vertex_bytes = mesh.byte_count() - mesh.indices.byte_count();
    if (indices > options.max_bytes / sizeof(std::uint32_t) ||
        vertex_bytes + indices * sizeof(std::uint32_t) > options.max_bytes) {
        return Stop::Limit;
    }
    LargeVector<std::uint32_t> listed;
    listed.resize(indices);
    for_each_reached([&](std::uint64_t i, const Instance& instance) {
        lists.write(instance, offsets_of(i), listed);
    });
    mesh.indices = std::move(listed);
    mesh.parts = std::move(parts);
    return std::nullopt;
}

std::optional<Stop> build(const InstanceCache& cache,
                          const std::vector<UserMesh>& user_meshes,
                          MeshOptions options,
                          InstanceMeshes& meshes) {
    const Skeleton& heroes = cache.skeleton;
    if (std::uint64_t{heroes.segments.size()} + heroes.objects.size() + heroes.polygons.size() >
        kMaxNumber) {
        return Stop::Failed;
    }
    options.segments = true;
    Skeleton skeleton = numbered_heroes(cache);
    if (resolved(options, skeleton).method == MeshMethod::Boxes) {
        cut_instances(cache, skeleton);
    }
    const std::optional<Stop> stop = make_mesh(skeleton, user_meshes, options, meshes.mesh);
    return stop ? stop : list_instances(cache, options, meshes);
}

} // namespace

std::optional<Stop> make_instance_meshes(const InstanceCache& cache,
                                         const std::vector<UserMesh>& user_meshes,
                                         const MeshOptions& options,
                                         InstanceMeshes& meshes) {
    meshes = {};
    const std::optional<Stop> stop =
        catch_out_of_memory([&] { return build(cache, user_meshes, options, meshes); },
                            [] { return Stop::OutOfMemory; });
    if (stop) {
        meshes = {};
    }
    return stop;
}

InstancePose pose_of(const BranchInstance& branch, const Instance& instance) {
    const glm::dquat rotation =
        glm::normalize(glm::dquat(branch.rotation) * glm::conjugate(instance.frame));
    InstancePose pose;
    pose.rotation = glm::quat(rotation);
    pose.translation = glm::vec3(glm::dvec3(branch.position) - static_cast<double>(branch.scale) *
                                                                   (rotation * instance.position));
    pose.scale = branch.scale;
    return pose;
}

} // namespace lsys
