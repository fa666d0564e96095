// SPDX-License-Identifier: MIT
#include "tests/support/forest.h"

#include "runtime/derive/derive.h"
#include "runtime/turtle/turtle.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <unordered_map>
#include <utility>

namespace lsys::test {

namespace {

TreeSegment at(const BranchInstance& where,
               const Instance& instance,
               const Segment& segment,
               std::uint32_t order) {
    const auto moved = [&](const glm::vec3& point) {
        const glm::dvec3 local =
            glm::conjugate(instance.frame) * (glm::dvec3(point) - instance.position);
        return glm::dvec3(where.position) +
               static_cast<double>(where.scale) * (glm::dquat(where.rotation) * local);
    };
    return {moved(segment.base), moved(tip(segment)), where.scale * segment.base_radius,
            where.scale * segment.tip_radius, order};
}

} // namespace

CacheOptions heroes(std::uint32_t count, std::uint64_t seed) {
    CacheOptions options;
    options.heroes = count;
    options.seed = seed;
    return options;
}

Tree tree_of(std::uint32_t number) {
    Tree tree;
    tree.number = number;
    return tree;
}

Planted
plant(const std::string& grammar, std::uint32_t generations, float rho, CacheOptions options) {
    CompileOptions compile;
    compile.generations = generations;
    Compiled compiled = compile_files({{"main.lsys", grammar}}, compile);
    REQUIRE(compiled.outcome.program.has_value());
    std::optional<InstancedSystem> system =
        compile_instanced(std::move(*compiled.outcome.program), compiled.names, compiled.sources,
                          rho, compiled.diagnostics);
    REQUIRE(system.has_value());
    Planted planted;
    planted.system = std::move(*system);
    options.generations = generations;
    options.depends_on_vertical = planted.system.depends_on_vertical;
    CacheOutcome outcome = make_instance_cache(planted.system.bytecode, options);
    REQUIRE(outcome.ok());
    planted.cache = std::move(outcome.cache);
    return planted;
}

Skeleton plain_plant(const std::string& grammar, std::uint32_t generations, std::uint64_t seed) {
    CompileOptions compile;
    compile.generations = generations;
    const Compiled compiled = compile_files({{"main.lsys", grammar}}, compile);
    REQUIRE(compiled.outcome.bytecode.has_value());
    DeriveOptions options;
    options.generations = generations;
    options.seed = seed;
    Derivation derivation(*compiled.outcome.bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(generations) == std::nullopt);
    TurtleOptions drawing;
    drawing.seed = seed;
    drawing.generations = generations;
    Turtle turtle(*compiled.outcome.bytecode, drawing);
    REQUIRE(turtle.feed(derivation.word()) == std::nullopt);
    REQUIRE(turtle.finish() == std::nullopt);
    return turtle.take_skeleton();
}

std::vector<TreeSegment>
segments_of(const InstanceCache& cache, const Tree& tree, std::uint64_t key) {
    std::vector<TreeSegment> segments;
    TreeExpander expander(cache, key);
    expander.expand(tree, [&](const BranchInstance& where) {
        const Instance& instance = cache.instances[where.instance];
        for (std::uint32_t r = 0; r < instance.range_count; ++r) {
            const DrawnRange& range = cache.ranges[instance.first_range + r];
            for (std::uint32_t i = range.begin.segments; i < range.end.segments; ++i) {
                const Segment& segment = cache.skeleton.segments[i];
                segments.push_back(
                    at(where, instance, segment, where.order + segment.order - instance.order));
            }
        }
    });
    return segments;
}

std::vector<TreeSegment> segments_of(const Skeleton& skeleton) {
    std::vector<TreeSegment> segments;
    for (const Segment& segment : skeleton.segments) {
        segments.push_back(at({}, {}, segment, segment.order));
    }
    return segments;
}

std::size_t count_unmatched(const std::vector<TreeSegment>& a,
                            const std::vector<TreeSegment>& b,
                            double distance) {
    const double cell = 4.0 * distance;
    const auto key = [cell](const glm::dvec3& p, int x, int y, int z) {
        const auto cell_index = [cell](double v, int d) {
            return static_cast<std::int64_t>(std::floor(v / cell)) + d;
        };
        return static_cast<std::uint64_t>(cell_index(p.x, x) * 73856093) ^
               static_cast<std::uint64_t>(cell_index(p.y, y) * 19349663) ^
               static_cast<std::uint64_t>(cell_index(p.z, z) * 83492791);
    };
    std::unordered_multimap<std::uint64_t, const TreeSegment*> cells;
    for (const TreeSegment& segment : b) {
        cells.emplace(key(segment.base, 0, 0, 0), &segment);
    }
    const auto has = [&](const TreeSegment& segment) {
        for (int n = 0; n < 27; ++n) {
            const auto [begin, end] =
                cells.equal_range(key(segment.base, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            for (auto other = begin; other != end; ++other) {
                if (glm::distance(other->second->base, segment.base) <= distance &&
                    glm::distance(other->second->tip, segment.tip) <= distance &&
                    std::abs(other->second->base_radius - segment.base_radius) <=
                        1e-3F * segment.base_radius) {
                    return true;
                }
            }
        }
        return false;
    };
    std::size_t strangers = 0;
    for (const TreeSegment& segment : a) {
        strangers += has(segment) ? 0U : 1U;
    }
    return strangers;
}

} // namespace lsys::test
