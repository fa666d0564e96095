// SPDX-License-Identifier: MIT
#include "runtime/export/impl/forest_slices.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

/// Calls visit(begin, end) for each run of items of an instance. All items of the heroes are
/// numbered together: segments, then polygons, then objects.
template <typename Visit>
void for_each_run(const InstanceCache& cache, const Instance& instance, const Visit& visit) {
    const std::uint64_t segments = cache.skeleton.segments.size();
    const std::uint64_t polygons = segments + cache.skeleton.polygons.size();
    for (std::uint32_t r = 0; r < instance.range_count; ++r) {
        const DrawnRange& range = cache.ranges[instance.first_range + r];
        visit(range.begin.segments, range.end.segments);
        visit(segments + range.begin.polygons, segments + range.end.polygons);
        visit(polygons + range.begin.objects, polygons + range.end.objects);
    }
}

/// For each used instance the innermost used instance that encloses it, or kNone. Instances are
/// numbered in the order in which they begin, so enclosing instances have lower numbers.
std::vector<std::uint32_t> find_parents(const ExportedStage& stage, const ForestPlan& plan) {
    const InstanceCache& cache = *stage.cache;
    const Skeleton& heroes = cache.skeleton;
    std::vector<std::uint32_t> parents(cache.instances.size(), kNone);
    LargeVector<std::uint32_t> owners; // of each item, the innermost instance so far
    owners.assign(heroes.segments.size() + heroes.polygons.size() + heroes.objects.size(), kNone);
    for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
        if (plan.instance_counts()[stage.first + i] == 0) {
            continue;
        }
        bool is_first = true;
        for_each_run(cache, cache.instances[i], [&](std::uint64_t begin, std::uint64_t end) {
            if (begin < end && is_first) {
                parents[i] = owners[begin];
                is_first = false;
            }
            std::fill(owners.begin() + static_cast<std::ptrdiff_t>(begin),
                      owners.begin() + static_cast<std::ptrdiff_t>(end), i);
        });
    }
    return parents;
}

/// Makes a SlicedMesh, material by material and list by list.
class Slicer {
public:
    Slicer(const Mesh& mesh, std::span<const PartList> lists)
        : mesh_(mesh), lists_(lists), indices_(mesh.indices.expanded()), begins_(lists.size()) {
        numbers_.assign(mesh.positions.size(), 0);
        result_.indices.resize(indices_.size());
        result_.slices.resize(mesh.parts.size());
        result_.blocks.resize(mesh.materials.size());
    }

    SlicedMesh slice() {
        for (const PartList& list : lists_) {
            for (std::size_t p = list.first_part; p < list.first_part + list.part_count; ++p) {
                result_.order.push_back(p);
            }
        }
        for (std::uint32_t material = 0; material < mesh_.materials.size(); ++material) {
            SliceBlock& block = result_.blocks[material];
            block.first_vertex = result_.vertices.size();
            for (std::size_t number = 0; number < lists_.size(); ++number) {
                begins_[number] = result_.vertices.size();
                const PartList& list = lists_[number];
                for (std::size_t p = list.first_part; p < list.first_part + list.part_count; ++p) {
                    if (mesh_.parts[p].material == material) {
                        add_part(p, begins_[list.first_nested], block);
                    }
                }
            }
            block.vertex_count = result_.vertices.size() - block.first_vertex;
        }
        return std::move(result_);
    }

private:
    /// Adds the vertices of a part that no nested list has. `begin`: the index in
    /// SlicedMesh::vertices of the first vertex of the nested lists.
    void add_part(std::size_t number, std::uint64_t begin, SliceBlock& block) {
        const MeshPart& part = mesh_.parts[number];
        LargeVector<std::uint32_t>& vertices = result_.vertices;
        for (std::uint64_t k = part.first_index; k < part.first_index + part.index_count; ++k) {
            std::uint64_t& after = numbers_[indices_[k]];
            if (after <= begin) {
                vertices.push_back(indices_[k]);
                after = vertices.size();
            }
            result_.indices[k] = static_cast<std::uint32_t>(after - 1 - begin);
        }
        Slice& slice = result_.slices[number];
        slice.first_vertex = begin - block.first_vertex;
        slice.vertex_count = vertices.size() - begin;
        std::uint64_t& used = slice.is_wide() ? block.wide_indices : block.narrow_indices;
        slice.first_index = used;
        used += part.index_count;
        for (std::uint64_t v = begin; v < vertices.size(); ++v) {
            slice.bounds.add(mesh_.positions[vertices[v]]);
        }
    }

    const Mesh& mesh_;
    std::span<const PartList> lists_;
    LargeVector<std::uint32_t> indices_;
    /// By list: index in SlicedMesh::vertices of its first vertex of the current material.
    std::vector<std::uint64_t> begins_;
    /// By vertex of the mesh: one more than the index of its last copy in SlicedMesh::vertices; 0:
    /// none.
    LargeVector<std::uint64_t> numbers_;
    SlicedMesh result_;
};

} // namespace

std::vector<PartList> nested_lists(const ExportedStage& stage, const ForestPlan& plan) {
    const std::vector<std::uint32_t> parents = find_parents(stage, plan);
    const auto count = static_cast<std::uint32_t>(parents.size());
    const auto is_used = [&](std::uint32_t i) {
        return plan.instance_counts()[stage.first + i] > 0;
    };
    // Children of each instance as linked lists, by ascending number; the last entry is the list of
    // instances without a parent.
    std::vector<std::uint32_t> first_child(count + std::size_t{1}, kNone);
    std::vector<std::uint32_t> next(count, kNone);
    for (std::uint32_t i = count; i-- > 0;) {
        if (is_used(i)) {
            std::uint32_t& first = first_child[parents[i] == kNone ? count : parents[i]];
            next[i] = std::exchange(first, i);
        }
    }
    std::vector<PartList> lists;
    struct Entered {
        std::uint32_t instance;
        std::uint32_t child;      // the next child to enter
        std::size_t first_nested; // number of the next list when `instance` was entered
    };
    std::vector<Entered> path{{count, first_child[count], 0}};
    while (!path.empty()) {
        const Entered at = path.back();
        if (at.child != kNone) {
            path.back().child = next[at.child];
            path.push_back({at.child, first_child[at.child], lists.size()});
            continue;
        }
        path.pop_back();
        if (at.instance < count) {
            const std::size_t first = stage.meshes->first_part[at.instance];
            lists.push_back(
                {first, stage.meshes->first_part[at.instance + 1] - first, at.first_nested});
        }
    }
    return lists;
}

SlicedMesh slice_mesh(const Mesh& mesh, std::span<const PartList> lists) {
    return Slicer(mesh, lists).slice();
}

} // namespace lsys
