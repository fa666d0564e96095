// SPDX-License-Identifier: MIT
// Growth between generations: whole generations equal the ordinary plants, and motion between them
// is continuous.
#include "runtime/pipeline/plant_growth.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace lsys;

namespace {

Project growth_project(std::uint32_t threads) {
    Project project;
    project.threads = threads;
    project.host.read_file = [](const std::string& path,
                                const ReadLimit& /*limit*/) -> Result<std::string> {
        std::ifstream file(path, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        return file ? Result<std::string>(text.str()) : Error{"no such file or directory"};
    };
    project.host.read_referenced_file = project.host.read_file;
    project.host.file_exists = [](const std::string& path) { return std::ifstream(path).good(); };
    return project;
}

struct GrownSample {
    Project project;
    Grammar grammar;
    std::optional<PlantGrowth> growth;

    explicit GrownSample(const std::string& text, std::uint32_t generations, std::uint32_t threads)
        : project(growth_project(threads)) {
        Project reads = project;
        reads.host.read_file = [text](const std::string&, const ReadLimit&) {
            return Result<std::string>(text);
        };
        Outcome<Grammar> loaded = load_grammar("plant.lsys", {}, reads);
        REQUIRE(loaded);
        grammar = std::move(loaded.value());
        PlantOptions options;
        options.generations = generations;
        Outcome<PlantGrowth> begun = PlantGrowth::begin(options, grammar, project);
        REQUIRE(begun);
        growth.emplace(std::move(begun.value()));
    }

    Skeleton at(std::uint32_t generation, double part) {
        Skeleton skeleton;
        REQUIRE(growth->pose({generation, part}, project, skeleton));
        return skeleton;
    }
};

std::string sample_text(const std::string& name) {
    const std::string path =
        std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + name + ".lsys";
    const Result<std::string> text = growth_project(1).host.read_file(path, {});
    REQUIRE(text);
    return text.value();
}

Plant ordinary_plant(const std::string& text, std::uint32_t generations) {
    Project project = growth_project(1);
    project.host.read_file = [text](const std::string&, const ReadLimit&) {
        return Result<std::string>(text);
    };
    Outcome<Grammar> grammar = load_grammar("plant.lsys", {}, project);
    REQUIRE(grammar);
    PlantOptions options;
    options.generations = generations;
    Outcome<Plant> plant = grow_plant(options, grammar.value(), project);
    REQUIRE(plant);
    return std::move(plant.value());
}

std::string lines_of(const Skeleton& skeleton) {
    std::string text;
    for (std::uint64_t line = 0; line < line_count(skeleton); ++line) {
        append_line(skeleton, line, nullptr, text);
        text += '\n';
    }
    return text;
}

Mesh mesh_of(const Plant& plant, const Skeleton& skeleton) {
    Outcome<Mesh> mesh = mesh_plant(plant, skeleton, {}, growth_project(1));
    REQUIRE(mesh);
    return std::move(mesh.value());
}

bool is_same_mesh(const Mesh& a, const Mesh& b) {
    return a.indices == b.indices && a.positions.size() == b.positions.size() &&
           (a.positions.empty() || std::memcmp(a.positions.data(), b.positions.data(),
                                               a.positions.size() * sizeof(a.positions[0])) == 0);
}

/// The largest distance between corresponding ends of segments, objects and corners of two
/// skeletons with the same parts.
float longest_move(const Skeleton& a, const Skeleton& b) {
    REQUIRE(a.segments.size() == b.segments.size());
    REQUIRE(a.objects.size() == b.objects.size());
    REQUIRE(a.corners.size() == b.corners.size());
    float far = 0.0F;
    for (std::size_t i = 0; i < a.segments.size(); ++i) {
        far = std::max(far, glm::distance(a.segments[i].base, b.segments[i].base));
        far = std::max(far, glm::distance(tip(a.segments[i]), tip(b.segments[i])));
    }
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        far = std::max(far, glm::distance(a.objects[i].position, b.objects[i].position));
    }
    for (std::size_t i = 0; i < a.corners.size(); ++i) {
        far = std::max(far, glm::distance(a.corners[i], b.corners[i]));
    }
    return far;
}

struct GrowthSample {
    const char* name;
    std::uint32_t generations;
};

const std::vector<GrowthSample> kGrowthSamples = {
    {"abop-1-24a", 3},    {"abop-1-24b", 3},  {"abop-1-24c", 3}, {"abop-1-24d", 4},
    {"abop-1-24e", 4},    {"abop-1-24f", 4},  {"abop-2-8a", 4},  {"abop-2-6-monopodial", 6},
    {"crankshaw-7-3", 4}, {"sys-figure-1", 3}};

} // namespace

TEST_CASE("frames of a growth begin at the axiom and end at the last generation") {
    const auto is = [](const GrowthMoment& moment, std::uint32_t generation, double part) {
        return moment.generation == generation && moment.fraction == part;
    };
    CHECK(is(moment_of_frame(0, 1, 7), 7, 0.0));
    CHECK(is(moment_of_frame(0, 9, 4), 0, 0.0));
    CHECK(is(moment_of_frame(1, 9, 4), 0, 0.5));
    CHECK(is(moment_of_frame(2, 9, 4), 1, 0.0));
    CHECK(is(moment_of_frame(8, 9, 4), 4, 0.0));
    CHECK(is(moment_of_frame(3, 4, 10), 10, 0.0));
    CHECK(is(moment_of_frame(1, 4, 10), 3, 1.0 / 3.0));
    CHECK(is(moment_of_frame(5, 9, 0), 0, 0.0));
}

TEST_CASE("a whole generation of growth equals the ordinary plant") {
    const GrowthSample sample = GENERATE(from_range(kGrowthSamples));
    INFO(sample.name);
    const std::string text = sample_text(sample.name);
    GrownSample grown(text, sample.generations, 1);
    for (std::uint32_t generation = 0; generation <= sample.generations; ++generation) {
        INFO("generation " << generation);
        const Plant plant = ordinary_plant(text, generation);
        const Skeleton skeleton = grown.at(generation, 0.0);
        CHECK(lines_of(skeleton) == lines_of(plant.skeleton));
        CHECK(is_same_mesh(mesh_of(plant, skeleton), mesh_of(plant, plant.skeleton)));
        // Going back from a later moment gives the same plant.
        if (generation < sample.generations) {
            static_cast<void>(grown.at(generation, 0.5));
            CHECK(lines_of(grown.at(generation, 0.0)) == lines_of(plant.skeleton));
        }
    }
    // Going back to the axiom works too.
    CHECK(lines_of(grown.at(0, 0.0)) == lines_of(ordinary_plant(text, 0).skeleton));
}

TEST_CASE("growth has no jump after a generation and before the next") {
    const GrowthSample sample = GENERATE(from_range(kGrowthSamples));
    INFO(sample.name);
    GrownSample grown(sample_text(sample.name), sample.generations, 1);
    constexpr double kSoon = 1e-7;
    for (std::uint32_t generation = 0; generation < sample.generations; ++generation) {
        INFO("generation " << generation);
        const Skeleton before = grown.at(generation, 0.0);
        const Skeleton soon = grown.at(generation, kSoon);
        const SkeletonStats stats = measure(before);
        const SkeletonStats soon_stats = measure(soon);
        CHECK(soon_stats.length == Approx(stats.length).epsilon(1e-4).margin(1e-4));
        CHECK(soon_stats.volume == Approx(stats.volume).epsilon(1e-4).margin(1e-6));
        if (!before.segments.empty()) {
            const float size = 1e-4F * (1.0F + glm::length(stats.bounds.high - stats.bounds.low));
            CHECK(glm::distance(stats.bounds.low, soon_stats.bounds.low) < size);
            CHECK(glm::distance(stats.bounds.high, soon_stats.bounds.high) < size);
        }
        // Segments of the next generation precede segments that vanish.
        const Skeleton late = grown.at(generation, 1.0 - kSoon);
        const Skeleton after = grown.at(generation + 1, 0.0);
        REQUIRE(late.segments.size() >= after.segments.size());
        const Bounds bounds = measure(after).bounds;
        const float near = 1e-4F * (1.0F + glm::length(bounds.high - bounds.low));
        for (std::size_t i = 0; i < late.segments.size(); ++i) {
            if (i >= after.segments.size()) {
                REQUIRE(late.segments[i].length < 1e-4F);
            } else if (glm::distance(tip(late.segments[i]), tip(after.segments[i])) > near ||
                       std::abs(late.segments[i].base_radius - after.segments[i].base_radius) >
                           near) {
                FAIL("segment " << i << " jumps");
            }
        }
    }
}

TEST_CASE("twice as many frames of a growth move half as far") {
    const GrowthSample sample = GENERATE(from_range(kGrowthSamples));
    INFO(sample.name);
    GrownSample grown(sample_text(sample.name), sample.generations, 1);
    const std::uint32_t generation = sample.generations - 1;
    const auto longest_way = [&](std::uint32_t frames) {
        float far = 0.0F;
        Skeleton last = grown.at(generation, 0.01);
        for (std::uint32_t i = 1; i <= frames; ++i) {
            const Skeleton next = grown.at(generation, 0.01 + 0.98 * static_cast<double>(i) /
                                                                  static_cast<double>(frames));
            far = std::max(far, longest_move(last, next));
            last = next;
        }
        return far;
    };
    const float way_16 = longest_way(16);
    const float way_32 = longest_way(32);
    const float way_64 = longest_way(64);
    REQUIRE(way_16 > 0.0F);
    CHECK(way_32 < 0.6F * way_16);
    CHECK(way_64 < 0.6F * way_32);
}

TEST_CASE("joints of a plant between generations are closed") {
    GrownSample grown(sample_text("abop-2-8a"), 4, 1);
    const Skeleton between = grown.at(3, 0.37);
    for (const Segment& segment : between.segments) {
        if (segment.linked) {
            REQUIRE(glm::distance(segment.base, tip(between.segments[segment.parent])) < 1e-2F);
        }
    }
}

TEST_CASE("segments between generations are pieces of old ones or grow from length 0") {
    // F has length 1; the two segments of the stem that replaces it have lengths 1 and 3. At the
    // start, both lie on the old F and divide its length 1 : 3.
    GrownSample split("#set width 0.1; #w : F(1); #p : F(l) : * : F(l) [ +(90) F(2) ] F(3*l);", 1,
                      1);
    const Skeleton half = split.at(0, 0.5);
    REQUIRE(half.segments.size() == 3);
    CHECK(half.segments[0].length == Approx(0.5 * 0.25 + 0.5 * 1.0));
    CHECK(half.segments[1].length == Approx(0.5 * 2.0)); // easing is 0.5 at 0.5
    CHECK(half.segments[2].length == Approx(0.5 * 0.75 + 0.5 * 3.0));
    CHECK(half.segments[1].base_radius == Approx(0.5F * split.at(1, 0.0).segments[1].base_radius));
    const Skeleton quarter = split.at(0, 0.25);
    CHECK(quarter.segments[1].length == Approx(2.0 * 0.15625)); // easing is 3 t^2 - 2 t^3

    // A segment that replaces another turns and stretches; segments after it move with it.
    GrownSample turn(
        "#set width 0.1; #w : A F(1); #p : A : * : +(90) F(2); #q : F(l) : * : F(2*l);", 1, 1);
    const Skeleton turned = turn.at(0, 0.5);
    REQUIRE(turned.segments.size() == 2);
    CHECK(turned.segments[1].length == Approx(1.5));
    CHECK(glm::length(turned.segments[1].base) == Approx(1.0));

    // Segments that the next generation does not draw shrink.
    GrownSample shrinking("#set width 0.1; #w : F(1) F(2); #p : F(l) : l > 1 : A;", 1, 1);
    const Skeleton going = shrinking.at(0, 0.5);
    REQUIRE(going.segments.size() == 2);
    CHECK(going.segments[0].length == Approx(1.0));
    CHECK(going.segments[1].length == Approx(1.0));
    CHECK(going.segments[1].parent == 0);
    CHECK(shrinking.at(1, 0.0).segments.size() == 1);
}

TEST_CASE("a growth is the same for any number of threads") {
    const std::string text = sample_text("abop-2-8a");
    GrownSample one(text, 5, 1);
    GrownSample many(text, 5, 4);
    for (const double part : {0.0, 0.3, 0.9}) {
        CHECK(lines_of(one.at(4, part)) == lines_of(many.at(4, part)));
    }
}

TEST_CASE("growth ends at the limits of a plant") {
    Project project = growth_project(1);
    project.host.read_file = [](const std::string&, const ReadLimit&) {
        return Result<std::string>(std::string("#n = 9; #w : F; #p : F : * : F F F;"));
    };
    Outcome<Grammar> grammar = load_grammar("plant.lsys", {}, project);
    REQUIRE(grammar);
    project.limits.max_modules = 100;
    CHECK(PlantGrowth::begin({}, grammar.value(), project).stop() == Stop::Limit);
}
