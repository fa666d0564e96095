// SPDX-License-Identifier: MIT
// Heights of the trees of a forest: measures trees that are assembled from instances, and computes
// the scales that give trees a height in metres (docs/language.md section 7.5). Used by the
// pipeline after the placement. A height depends only on the cache, the key of the forest and the
// tree.
#pragma once

#include "runtime/forest/forest.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/turtle/plant_size.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys {

/// Extents of a cache's instances, from which the heights of its trees are computed.
struct HeightTable {
    std::vector<Bounds> boxes; // box of each instance, in the coordinates of the heroes
    /// Heights in m of whole plants without exits; none for other instances.
    std::vector<std::optional<double>> whole;
    double min_height = 0.0; // m; a lower tree counts as flat
};
/// Measures the instances of a cache.
[[nodiscard]] HeightTable make_height_table(const InstanceCache& cache);

/// Measures trees of one cache at scale 1. Use one for each thread.
class TreeMeasure {
public:
    /// `key`: the forest's key. Precondition: `cache` and `table` outlive the measure.
    TreeMeasure(const InstanceCache& cache, const HeightTable& table, std::uint64_t key)
        : cache_(cache), table_(table), expander_(cache, key) {}

    /// Height in m of tree `number` from its lowest to its highest point; points are the ends of
    /// the axes of segments, places of objects and corners of polygons. 0: the tree is flat;
    /// nullopt: it draws nothing. Reads the points of an instance only if its box reaches beyond
    /// the points read so far.
    [[nodiscard]] std::optional<double> height_of(std::uint32_t number);

private:
    struct Part {
        std::uint32_t instance = 0;
        glm::dvec3 up{};     // the height of a point is dot(point, up) + offset
        double offset = 0.0; // m
        double low = 0.0;    // m, height of the lowest and of the highest point of the box
        double high = 0.0;
    };

    const InstanceCache& cache_;
    const HeightTable& table_;
    TreeExpander expander_;
    std::vector<Part> parts_;
};

/// Scales the skeleton, entries and exits of a cache, with masses and springs as in scale_plant().
void scale_cache(double factor, const StemMaterial& material, InstanceCache& cache);

/// Gives trees their heights: multiplies the scale of every tree of species s by heights[s] /
/// (height of the tree at scale 1), so that a tree is scale * heights[s] metres high. Younger trees
/// use the height of the last stage of their species. Scales stay if heights[s] is 0, and for trees
/// that are flat or draw nothing.
class TreeSizer {
public:
    /// Precondition: `forest` outlives the sizer; its trees are not used. heights[s]: height of
    /// species s, m.
    TreeSizer(std::span<const double> heights, const Forest& forest);

    /// Returns the first species with a flat tree, or nullopt. May be called from several threads.
    [[nodiscard]] std::optional<std::uint16_t> size(std::span<Tree> trees) const;
    /// An upper bound of the factor by which size() multiplies the scale of a tree, computed from
    /// lower bounds of the heights of trees.
    [[nodiscard]] double max_factor(std::uint16_t species) const;
    /// A hash of the heights of the species and of all that the heights of their trees depend on.
    [[nodiscard]] std::uint64_t digest() const;

private:
    std::vector<double> heights_;
    const Forest& forest_;
    std::vector<HeightTable> tables_; // by species, of its last stage; empty if heights_ is 0
};

/// Gives all trees of a forest their heights, like TreeSizer. Returns the first species with a flat
/// tree, or nullopt. 0 threads: as many as the machine has.
[[nodiscard]] std::optional<std::uint16_t>
size_trees(std::span<const double> heights, std::uint32_t threads, Forest& forest);

/// Height in m of the tallest tree, its scale included. Time is linear in the branches.
[[nodiscard]] double tallest_tree(const Forest& forest, std::uint32_t threads);

} // namespace lsys
