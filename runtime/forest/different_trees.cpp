// SPDX-License-Identifier: MIT
#include "runtime/forest/different_trees.h"

#include "runtime/turtle/organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

namespace lsys {

namespace {

/// Moments of the points that an instance draws, in the coordinates of its entry. Points and their
/// weights: both ends of a segment with half its length, the place of an object with its size, each
/// corner of a polygon with 1. The sum over the instances of a tree does not depend on the division
/// of the tree into instances.
struct Moments {
    std::uint64_t items = 0; // segments, objects and corners
    double total_weight = 0.0;
    glm::dvec3 first{0.0};          // sum over the points of weight times point
    std::array<double, 6> second{}; // as `first`, of the products xx, yy, zz, xy, yz, zx
    double thickness = 0.0;         // sum over the segments of length times radius

    void add(const glm::dvec3& at, double weight) {
        total_weight += weight;
        first += weight * at;
        const std::array<double, 6> squares{at.x * at.x, at.y * at.y, at.z * at.z,
                                            at.x * at.y, at.y * at.z, at.z * at.x};
        for (std::size_t i = 0; i < squares.size(); ++i) {
            second[i] += weight * squares[i];
        }
    }
};

Moments moments_of(const InstanceCache& cache, const Instance& instance) {
    Moments moments;
    const glm::dquat back = glm::conjugate(instance.frame);
    for (std::uint32_t r = 0; r < instance.range_count; ++r) {
        const DrawnRange& range = cache.ranges[instance.first_range + r];
        for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
            const Segment& segment = cache.skeleton.segments[i];
            const auto length = static_cast<double>(segment.length);
            ++moments.items;
            for (const glm::vec3& end : {segment.base, tip(segment)}) {
                moments.add(back * (glm::dvec3(end) - instance.position), 0.5 * length);
            }
            moments.thickness += length * static_cast<double>(segment.base_radius);
        }
        for (std::uint32_t i = range.begin.objects; i < range.end.objects; ++i) {
            const PlacedObject& object = cache.skeleton.objects[i];
            for_each_point_of(cache.skeleton, object, [&](const glm::vec3& point) {
                ++moments.items;
                moments.add(back * (glm::dvec3(point) - instance.position),
                            static_cast<double>(std::abs(object.size)));
            });
        }
        for (std::uint32_t i = range.begin.polygons; i < range.end.polygons; ++i) {
            const Polygon& polygon = cache.skeleton.polygons[i];
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                const glm::vec3& corner = cache.skeleton.corners[polygon.first_corner + c];
                ++moments.items;
                moments.add(back * (glm::dvec3(corner) - instance.position), 1.0);
            }
        }
    }
    return moments;
}

/// Adds to `tree` the moments `own` of the instance of `branch`, placed as `branch` states.
/// Precondition: the scale of `branch` is 1.
void add(Moments& tree, const Moments& own, const BranchInstance& branch) {
    const glm::dmat3 turn = glm::mat3_cast(glm::normalize(glm::dquat(branch.rotation)));
    const glm::dvec3 at(branch.position);
    const std::array<double, 6>& s = own.second;
    const glm::dmat3 second = turn *
                              glm::dmat3(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]) *
                              glm::transpose(turn);
    const glm::dvec3 first = turn * own.first;
    tree.items += own.items;
    tree.total_weight += own.total_weight;
    tree.thickness += own.thickness;
    tree.first += first + own.total_weight * at;
    constexpr std::array<std::array<int, 2>, 6> kAxes{
        {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t i = 0; i < kAxes.size(); ++i) {
        const auto [a, b] = kAxes[i];
        tree.second[i] +=
            second[b][a] + first[a] * at[b] + at[a] * first[b] + own.total_weight * at[a] * at[b];
    }
}

/// Whether both have the same number of items, and all moments agree to one part in a million.
bool alike(const Moments& a, const Moments& b) {
    constexpr double kPart = 1e-6;
    const auto near = [](double x, double y, double size) {
        return std::abs(x - y) <= kPart * size;
    };
    if (a.items != b.items || !near(a.total_weight, b.total_weight, a.total_weight) ||
        !near(a.thickness, b.thickness, a.thickness)) {
        return false;
    }
    const double square = a.second[0] + a.second[1] + a.second[2];
    const double size = std::sqrt(square * a.total_weight);
    for (int i = 0; i < 3; ++i) {
        if (!near(a.first[i], b.first[i], size)) {
            return false;
        }
    }
    for (std::size_t i = 0; i < a.second.size(); ++i) {
        if (!near(a.second[i], b.second[i], square)) {
            return false;
        }
    }
    return true;
}

struct TreeShape {
    std::uint32_t species = 0;
    Moments moments;
};

std::uint64_t count_different(std::vector<TreeShape>& shapes) {
    const auto before = [](const TreeShape& a, const TreeShape& b) {
        return std::tuple(a.species, a.moments.items, a.moments.second[0]) <
               std::tuple(b.species, b.moments.items, b.moments.second[0]);
    };
    std::sort(shapes.begin(), shapes.end(), before);
    std::uint64_t count = 0;
    std::vector<std::size_t> near; // indices of shapes that may equal shape i or a later one
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const TreeShape& shape = shapes[i];
        const auto& s = shape.moments.second;
        const double tolerance = 2e-6 * (s[0] + s[1] + s[2]);
        std::erase_if(near, [&](std::size_t other) {
            return shapes[other].species != shape.species ||
                   shapes[other].moments.items != shape.moments.items ||
                   shapes[other].moments.second[0] < s[0] - tolerance;
        });
        const bool known = std::any_of(near.begin(), near.end(), [&](std::size_t other) {
            return alike(shapes[other].moments, shape.moments);
        });
        if (!known) {
            near.push_back(i);
            ++count;
        }
    }
    return count;
}

/// Moments of the instances of each cache.
using MomentsOfCaches = std::map<const InstanceCache*, std::vector<Moments>>;

std::vector<Moments> moments_of(const InstanceCache& cache) {
    std::vector<Moments> moments;
    for (const Instance& instance : cache.instances) {
        moments.push_back(moments_of(cache, instance));
    }
    return moments;
}

TreeShape shape_of(const Forest& forest, const MomentsOfCaches& of_caches, const Tree& tree) {
    const InstanceCache& cache = forest.cache_of(tree);
    const std::vector<Moments>& moments = of_caches.at(&cache);
    TreeShape shape;
    shape.species = tree.species;
    Tree alone;
    alone.number = tree.number;
    TreeExpander expander(cache, forest.key);
    expander.expand(alone, [&](const BranchInstance& branch) {
        add(shape.moments, moments[branch.instance], branch);
    });
    return shape;
}

} // namespace

std::uint64_t count_different_trees(const Forest& forest, std::uint32_t threads) {
    MomentsOfCaches of_caches;
    for (const ForestSpecies& species : forest.species) {
        for (const ForestStage& stage : species.stages) {
            of_caches.emplace(&stage.cache, moments_of(stage.cache));
        }
    }
    std::vector<TreeShape> shapes(forest.trees.size());
    for_each_piece(forest, threads, [&](std::uint64_t, std::span<const Tree> trees) {
        for (const Tree& tree : trees) {
            shapes[static_cast<std::size_t>(&tree - forest.trees.data())] =
                shape_of(forest, of_caches, tree);
        }
    });
    return count_different(shapes);
}

std::uint64_t count_different_trees(const Forest& forest, std::span<const Tree> trees) {
    MomentsOfCaches of_caches; // only caches of `trees`, since a forest may have many species
    std::vector<TreeShape> shapes;
    for (const Tree& tree : trees) {
        const InstanceCache& cache = forest.cache_of(tree);
        if (of_caches.count(&cache) == 0) {
            of_caches.emplace(&cache, moments_of(cache));
        }
        shapes.push_back(shape_of(forest, of_caches, tree));
    }
    return count_different(shapes);
}

} // namespace lsys
