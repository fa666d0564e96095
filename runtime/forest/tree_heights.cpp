// SPDX-License-Identifier: MIT
#include "runtime/forest/tree_heights.h"

#include "grammar/base/hash.h"
#include "runtime/base/workers.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/turtle/organs.h"
#include "runtime/turtle/plant_size.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

/// Min height of a tree that is not flat, as a fraction of the largest extent of the instances. The
/// same fraction as in scale_to_height().
constexpr double kMinHeightFraction = 1e-6;
constexpr std::uint64_t kTreesPerPiece = 1024;

/// Calls visit(point) for all points of an instance.
template <typename Visit>
void for_each_point(const InstanceCache& cache, const Instance& instance, const Visit& visit) {
    const Skeleton& skeleton = cache.skeleton;
    for (std::uint32_t r = 0; r < instance.range_count; ++r) {
        const DrawnRange& range = cache.ranges[instance.first_range + r];
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            visit(skeleton.segments[i].base);
            visit(tip(skeleton.segments[i]));
        }
        for (std::uint32_t i = range.begin.objects; i < range.end.objects; ++i) {
            for_each_point_of(skeleton, skeleton.objects[i], visit);
        }
        for (std::uint32_t i = range.begin.polygons; i < range.end.polygons; ++i) {
            const Polygon& polygon = skeleton.polygons[i];
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                visit(skeleton.corners[polygon.first_corner + c]);
            }
        }
    }
}

/// Heights in m of the lowest and of the highest point.
struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
};

void add_points(const InstanceCache& cache,
                std::uint32_t instance,
                const glm::dvec3& up,
                double offset,
                Extent& extent) {
    for_each_point(cache, cache.instances[instance], [&](const glm::vec3& point) {
        const double height = up.x * static_cast<double>(point.x) +
                              up.y * static_cast<double>(point.y) +
                              up.z * static_cast<double>(point.z) + offset;
        extent.low = std::min(extent.low, height);
        extent.high = std::max(extent.high, height);
    });
}

/// The up direction of the world in the coordinates of the heroes, for an instance that is placed
/// by `pose`.
glm::dvec3 up_of(const InstancePose& pose) {
    return glm::conjugate(glm::dquat(pose.rotation)) * glm::dvec3(0.0, 1.0, 0.0);
}

/// A TreeMeasure for the last stage of each species of a forest, for one thread.
class Measures {
public:
    Measures(const Forest& forest, const std::vector<HeightTable>& tables)
        : forest_(forest), tables_(tables), measures_(tables.size()) {}

    [[nodiscard]] std::optional<double> height_of(const Tree& tree) {
        std::optional<TreeMeasure>& measure = measures_[tree.species];
        if (!measure) {
            measure.emplace(forest_.species[tree.species].last_stage().cache, tables_[tree.species],
                            forest_.key);
        }
        return measure->height_of(tree.number);
    }

private:
    const Forest& forest_;
    const std::vector<HeightTable>& tables_;
    std::vector<std::optional<TreeMeasure>> measures_;
};

/// A height along `up`, relative to the entry, that every instance of a slot reaches: the min of
/// rise_of() over its instances. Follows exits through at most `depth` instances.
double
min_rise(const InstanceCache& cache, std::uint32_t slot_number, const glm::dvec3& up, int depth);

/// The height along `up` of the highest point of an instance with all that grows at its exits,
/// relative to its entry; a lower bound of this height if it has exits.
double rise_of(const InstanceCache& cache, std::uint32_t number, const glm::dvec3& up, int depth) {
    const Instance& instance = cache.instances[number];
    const glm::dvec3 hero_up = instance.frame * up;
    Extent extent;
    add_points(cache, number, hero_up, -glm::dot(hero_up, instance.position), extent);
    double rise = std::max(0.0, extent.high);
    for (std::uint32_t e = 0; e < instance.exit_count; ++e) {
        const InstanceExit& exit = cache.exits[instance.first_exit + e];
        const double height = glm::dot(up, glm::dvec3(exit.position));
        const glm::dvec3 exit_up = glm::conjugate(glm::dquat(exit.rotation)) * up;
        rise = std::max(rise, height + min_rise(cache, exit.slot, exit_up, depth - 1));
    }
    return rise;
}

double
min_rise(const InstanceCache& cache, std::uint32_t slot_number, const glm::dvec3& up, int depth) {
    const InstanceSlot& slot = cache.slots[slot_number];
    if (depth == 0 || slot.variant_count == 0) {
        return 0.0;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t v = 0; v < slot.variant_count && least > 0.0; ++v) {
        least = std::min(least, rise_of(cache, cache.variants[slot.first_variant + v], up, depth));
    }
    return least;
}

/// A lower bound of the heights of the trees whose first instance is `root`.
double min_height(const InstanceCache& cache, const HeightTable& table, std::uint32_t root) {
    constexpr int kDepth = 3; // following more exits raises the bound of few trees, at a high cost
    const Bounds& box = table.boxes[root];
    if (box.empty) {
        return 0.0;
    }
    const Instance& instance = cache.instances[root];
    const glm::dvec3 up(0.0, 1.0, 0.0);
    Extent extent;
    const glm::dvec3 hero_up = instance.frame * up;
    add_points(cache, root, hero_up, -glm::dot(hero_up, instance.position), extent);
    return rise_of(cache, root, up, kDepth) - extent.low;
}

/// Adds to the hash `state` the data on which the heights of trees with exits depend.
std::uint64_t
combine_exits(std::uint64_t state, const InstanceCache& cache, const HeightTable& table) {
    if (cache.exits.empty()) {
        return state;
    }
    for (const InstanceSlot& slot : cache.slots) {
        state = combine_numbers(state, slot.first_variant, slot.variant_count);
    }
    for (std::size_t i = 0; i < cache.instances.size(); ++i) {
        const Instance& instance = cache.instances[i];
        const Bounds& box = table.boxes[i];
        state = combine_numbers(state, instance.first_exit, instance.exit_count, box.low.x,
                                box.low.y, box.low.z, box.high.x, box.high.y, box.high.z);
    }
    for (const std::uint32_t variant : cache.variants) {
        state = combine(state, variant);
    }
    for (const InstanceExit& exit : cache.exits) {
        state = combine_numbers(state, exit.slot, exit.position.x, exit.position.y, exit.position.z,
                                exit.rotation.x, exit.rotation.y, exit.rotation.z, exit.rotation.w);
    }
    return state;
}

std::uint64_t pieces_of(const Forest& forest) {
    return (forest.trees.size() + kTreesPerPiece - 1) / kTreesPerPiece;
}

std::span<const Tree> piece_of(const Forest& forest, std::uint64_t piece) {
    const std::uint64_t begin = piece * kTreesPerPiece;
    return std::span<const Tree>(forest.trees)
        .subspan(begin, std::min(kTreesPerPiece, forest.trees.size() - begin));
}

} // namespace

HeightTable make_height_table(const InstanceCache& cache) {
    HeightTable table;
    Bounds all;
    for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
        const Instance& instance = cache.instances[i];
        Bounds& box = table.boxes.emplace_back();
        for_each_point(cache, instance, [&](const glm::vec3& point) { box.add(point); });
        table.whole.emplace_back();
        if (!box.empty) {
            all.add(box.low);
            all.add(box.high);
        }
    }
    const glm::dvec3 size = glm::dvec3(all.high) - glm::dvec3(all.low);
    table.min_height = kMinHeightFraction * std::max({size.x, size.y, size.z});
    for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
        const Instance& instance = cache.instances[i];
        if (instance.slot == 0 && instance.exit_count == 0 && !table.boxes[i].empty) {
            Extent extent;
            const InstancePose pose = pose_of(BranchInstance{}, instance);
            add_points(cache, i, up_of(pose), 0.0, extent);
            table.whole[i] = extent.high - extent.low;
        }
    }
    return table;
}

std::optional<double> TreeMeasure::height_of(std::uint32_t number) {
    Tree tree;
    tree.number = number;
    const auto zero_if_flat = [&](double height) {
        return height > table_.min_height ? height : 0.0;
    };
    if (const std::optional<double> whole = table_.whole[expander_.root_instance(tree)]) {
        return zero_if_flat(*whole);
    }
    parts_.clear();
    expander_.expand(tree, [&](const BranchInstance& branch) {
        const Bounds& box = table_.boxes[branch.instance];
        if (box.empty) {
            return;
        }
        const InstancePose pose = pose_of(branch, cache_.instances[branch.instance]);
        Part part;
        part.instance = branch.instance;
        part.up = up_of(pose);
        part.offset = static_cast<double>(pose.translation.y);
        part.low = part.offset;
        part.high = part.offset;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = part.up[axis] * static_cast<double>(box.low[axis]);
            const double b = part.up[axis] * static_cast<double>(box.high[axis]);
            part.low += std::min(a, b);
            part.high += std::max(a, b);
        }
        parts_.push_back(part);
    });
    if (parts_.empty()) {
        return std::nullopt;
    }
    Extent extent;
    const auto add = [&](const Part& part) {
        add_points(cache_, part.instance, part.up, part.offset, extent);
    };
    // Starts with the parts that have the highest and the lowest box, so that the points of few
    // other parts have to be read.
    add(*std::max_element(parts_.begin(), parts_.end(),
                          [](const Part& a, const Part& b) { return a.high < b.high; }));
    add(*std::min_element(parts_.begin(), parts_.end(),
                          [](const Part& a, const Part& b) { return a.low < b.low; }));
    for (const Part& part : parts_) {
        if (part.high > extent.high || part.low < extent.low) {
            add(part);
        }
    }
    return zero_if_flat(extent.high - extent.low);
}

void scale_cache(double factor, const StemMaterial& material, InstanceCache& cache) {
    scale_plant(factor, material, cache.skeleton);
    for (Instance& instance : cache.instances) {
        instance.position *= factor;
    }
    for (InstanceExit& exit : cache.exits) {
        exit.position = glm::vec3(glm::dvec3(exit.position) * factor);
    }
}

TreeSizer::TreeSizer(std::span<const double> heights, const Forest& forest)
    : heights_(heights.begin(), heights.end()), forest_(forest), tables_(heights.size()) {
    for (std::size_t s = 0; s < tables_.size(); ++s) {
        if (heights[s] != 0.0) {
            tables_[s] = make_height_table(forest.species[s].last_stage().cache);
        }
    }
}

std::optional<std::uint16_t> TreeSizer::size(std::span<Tree> trees) const {
    std::optional<std::uint16_t> flat;
    Measures measures(forest_, tables_);
    for (Tree& tree : trees) {
        if (heights_[tree.species] == 0.0) {
            continue;
        }
        const std::optional<double> height = measures.height_of(tree);
        if (!height) {
            continue;
        }
        if (*height == 0.0) {
            flat = std::min(flat.value_or(tree.species), tree.species);
            continue;
        }
        tree.scale =
            static_cast<float>(static_cast<double>(tree.scale) * heights_[tree.species] / *height);
    }
    return flat;
}

double TreeSizer::max_factor(std::uint16_t species) const {
    if (heights_[species] == 0.0) {
        return 1.0;
    }
    const InstanceCache& cache = forest_.species[species].last_stage().cache;
    const HeightTable& table = tables_[species];
    double factor = 1.0; // trees that draw nothing keep their scale
    const InstanceSlot& whole = cache.slots[0];
    for (std::uint32_t v = 0; v < whole.variant_count; ++v) {
        const std::uint32_t root = cache.variants[whole.first_variant + v];
        const double height =
            table.whole[root] ? *table.whole[root] : min_height(cache, table, root);
        if (height > table.min_height) {
            factor = std::max(factor, heights_[species] / height);
        }
    }
    return factor;
}

std::uint64_t TreeSizer::digest() const {
    std::uint64_t state = combine_numbers(0, forest_.key, heights_.size());
    for (std::size_t s = 0; s < heights_.size(); ++s) {
        state = combine_numbers(state, heights_[s], tables_[s].min_height, tables_[s].whole.size());
        for (const std::optional<double>& height : tables_[s].whole) {
            state = combine_numbers(state, height.value_or(-1.0));
        }
        if (!tables_[s].whole.empty()) {
            state = combine_exits(state, forest_.species[s].last_stage().cache, tables_[s]);
        }
    }
    return finish(state);
}

std::optional<std::uint16_t>
size_trees(std::span<const double> heights, std::uint32_t threads, Forest& forest) {
    const TreeSizer sizer(heights, forest);
    std::vector<std::optional<std::uint16_t>> flat(pieces_of(forest)); // species, by piece
    Workers workers(threads);
    workers.for_each(flat.size(), [&](std::uint64_t piece) {
        const std::uint64_t begin = piece * kTreesPerPiece;
        flat[piece] =
            sizer.size(std::span(forest.trees)
                           .subspan(begin, std::min<std::uint64_t>(kTreesPerPiece,
                                                                   forest.trees.size() - begin)));
    });
    std::optional<std::uint16_t> first;
    for (const std::optional<std::uint16_t>& each : flat) {
        if (each && (!first || *each < *first)) {
            first = each;
        }
    }
    return first;
}

double tallest_tree(const Forest& forest, std::uint32_t threads) {
    // Tables of all stages, because a young tree has the height of its own stage.
    std::vector<std::vector<HeightTable>> tables;
    for (const ForestSpecies& species : forest.species) {
        std::vector<HeightTable>& stages = tables.emplace_back();
        for (const ForestStage& stage : species.stages) {
            stages.push_back(make_height_table(stage.cache));
        }
    }
    std::vector<double> tallest(pieces_of(forest), 0.0);
    Workers workers(threads);
    workers.for_each(tallest.size(), [&](std::uint64_t piece) {
        const InstanceCache* last = nullptr;
        std::optional<TreeMeasure> measure;
        for (const Tree& tree : piece_of(forest, piece)) {
            const InstanceCache& cache = forest.cache_of(tree);
            if (&cache != last) {
                measure.emplace(cache, tables[tree.species][forest.stage_of(tree)], forest.key);
                last = &cache;
            }
            tallest[piece] =
                std::max(tallest[piece], static_cast<double>(tree.scale) *
                                             measure->height_of(tree.number).value_or(0.0));
        }
    });
    return tallest.empty() ? 0.0 : *std::max_element(tallest.begin(), tallest.end());
}

} // namespace lsys
