// SPDX-License-Identifier: MIT
// Compares trees from instance caches with plants derived and drawn without instancing.
#include "runtime/derive/word_text.h"
#include "tests/support/forest.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <vector>

using namespace lsys;
using test::count_unmatched;
using test::heroes;
using test::plain_plant;
using test::plant;
using test::Planted;
using test::segments_of;
using test::tree_of;
using test::TreeSegment;

namespace {

std::string sample(const std::string& name) {
    for (const tests::Sample& each : tests::all_samples()) {
        if (each.file.stem() == name) {
            return tests::read_text(each.file);
        }
    }
    FAIL("no sample " << name);
    return {};
}

/// Hash of the segments of a tree: equal trees have equal hashes.
std::uint64_t hash_of(const std::vector<TreeSegment>& segments) {
    std::uint64_t hash = 0xCBF29CE484222325;
    for (const TreeSegment& segment : segments) {
        for (const double part : {segment.base.x, segment.base.y, segment.base.z, segment.tip.x,
                                  segment.tip.y, segment.tip.z}) {
            const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(part));
            hash = (hash ^ bits) * 0x100000001B3;
        }
    }
    return hash;
}

const std::string kBush = "#set names letters; #w : A;"
                          "#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A;"
                          "#r : A : ~ 0.2 : FF[&A]F;";

} // namespace

TEST_CASE("without exchanged branches, every tree is a hero, bit for bit") {
    const Planted planted = plant(kBush, 6, 0.0F, heroes(5, 40));
    CHECK(planted.cache.exits.empty());
    std::set<std::uint32_t> seen;
    for (std::uint32_t number = 0; number < 60; ++number) {
        TreeExpander expander(planted.cache, 7);
        expander.expand(tree_of(number), [&](const BranchInstance& at) {
            const Instance& instance = planted.cache.instances[at.instance];
            seen.insert(instance.hero);
            REQUIRE(instance.range_count == 1);
            const DrawnRange& range = planted.cache.ranges[instance.first_range];
            const Skeleton hero = plain_plant(kBush, 6, 40 + instance.hero);
            REQUIRE(instance.size.segments == hero.segments.size());
            for (std::uint32_t i = 0; i < hero.segments.size(); ++i) {
                const Segment& a = planted.cache.skeleton.segments[range.begin.segments + i];
                const Segment& b = hero.segments[i];
                CHECK(a.base == b.base);
                CHECK(a.frame == b.frame);
                CHECK(a.length == b.length);
                CHECK(a.base_radius == b.base_radius);
            }
        });
    }
    CHECK(seen.size() == 5);
}

TEST_CASE("without chance, every tree is the plant without instancing") {
    const std::string grammar = GENERATE(
        as<std::string>{},
        // Keys that depend on turtle state: widths and steps become smaller with each branch.
        "#set turtle houdini; #set names letters; #w : A; #p : A : * : !\"F[&A][//&A]////[^A]F;",
        // Keys that depend on parameters.
        "#w : A(1, 0.3); #p : A(l, w) : * : !(w) F(l) [&(30) A(l*0.8, w*0.7)] /(137)"
        "[&(50) A(l*0.6, w*0.5)] A(l*0.9, w*0.8);",
        // A branch that continues to grow.
        "#set names letters; #w : A; #p : A : * : F[+B]A; #q : B : * : F[-B]FB; #r : F : * : FF;",
        // #interpret that draws branches.
        "#set names letters; #w : A; #p : A : * : I[+A][-A]IA; #q : I : * : II;"
        "#interpret i : I : * : F[&J]; #interpret j : A : * : {.F+F+F.}; #interpret k : J : * : "
        "FF;",
        // #decompose that writes branches.
        "#w : A(0); #p : A(t) : * : F [+ B(t)] A(t + 0.5); #b : B(t) : * : B(t + 0.4) F;"
        "#decompose d : A(t) : t > 1 : M(t) [& B(t - 1)] A(t - 1); #decompose m : M(t) : * : F(t);",
        // Cuts by %, in a branch and around it.
        "#set names letters; #w : A; #p : A : * : F[+A][-BA]/A; #b : B : * : C; #c : C : * : F%;",
        // Predecessors of several modules.
        "#set names letters; #set rewriting leftmost; #w : AB;"
        "#p : AB : * : F[+AB]/AB[&ABA]; #q : A : * : F[-AB]; #r : B : * : F;",
        // Dependence on the vertical, by #interpret.
        "#set names letters; #w : A; #p : A : * : F[&A][//&A]D; #interpret d : D : * : $F;",
        // Dependence on the vertical.
        "#set names letters; #set tropism 0 -1 0 0.2; #w : A; #p : A : * : F[&A][//&A]$F;");
    const float rho = GENERATE(0.3F, 0.6F, 1.0F);
    const Planted planted = plant(grammar, 5, rho, heroes(3));
    const std::vector<TreeSegment> plain = segments_of(plain_plant(grammar, 5, 0));
    for (std::uint32_t number = 0; number < 10; ++number) {
        const std::vector<TreeSegment> tree = segments_of(planted.cache, tree_of(number), 1);
        INFO(grammar << " rho " << rho << " tree " << number);
        CHECK(tree.size() == plain.size());
        CHECK(count_unmatched(tree, plain, 1e-4) == 0);
        CHECK(count_unmatched(plain, tree, 1e-4) == 0);
    }
}

TEST_CASE("without exchanged branches, #interpret uses the random numbers of the hero") {
    const std::string grammar =
        "#set names letters; #w : A; #p : A : ~ 0.5 : F[+A]A; #q : A : ~ 0.5 : I[-A]A;"
        "#interpret i : I : * : F({1, 3})[+({10, 80})F]; #interpret f : F : * : F({0.5, 1});";
    const Planted planted = plant(grammar, 5, 0.0F, heroes(4, 9));
    for (std::uint32_t number = 0; number < 20; ++number) {
        const std::vector<TreeSegment> tree = segments_of(planted.cache, tree_of(number), 1);
        std::uint32_t hero = 0;
        TreeExpander expander(planted.cache, 1);
        expander.expand(tree_of(number), [&](const BranchInstance& at) {
            hero = planted.cache.instances[at.instance].hero;
        });
        const std::vector<TreeSegment> plain = segments_of(plain_plant(grammar, 5, 9 + hero));
        CHECK(tree.size() == plain.size());
        CHECK(count_unmatched(tree, plain, 1e-4) == 0);
    }
}

TEST_CASE("Carey's twisted tree is the same with and without instancing") {
    const std::string grammar = sample("carey-type-1");
    const Planted planted = plant(grammar, 6, 0.6F, heroes(10));
    const std::vector<TreeSegment> plain = segments_of(plain_plant(grammar, 6, 0));
    CHECK(plain.size() == 168);
    for (std::uint32_t number = 0; number < 50; ++number) {
        const std::vector<TreeSegment> tree = segments_of(planted.cache, tree_of(number), 1);
        CHECK(tree.size() == 168);
        CHECK(count_unmatched(tree, plain, 1e-4) == 0);
    }
}

TEST_CASE("the instanced system and the plain one derive the same word") {
    const Planted planted = plant(kBush, 6, 0.5F, heroes(1));
    const test::Compiled plain = test::compile_text(kBush);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto names = [&](const Bytecode& bytecode) {
            DeriveOptions options;
            options.generations = 6;
            options.seed = seed;
            Derivation derivation(bytecode, options);
            REQUIRE(derivation.start() == std::nullopt);
            REQUIRE(derivation.run_to(6) == std::nullopt);
            std::string text;
            for (std::uint64_t i = 0; i < derivation.word().module_count(); ++i) {
                text += bytecode.symbol(bytecode.symbol_of(derivation.word().code(i))).name;
            }
            return text;
        };
        CHECK(names(planted.system.bytecode) == names(*plain.outcome.bytecode));
    }
}

TEST_CASE("a tree depends on nothing but its number") {
    const Planted planted = plant(kBush, 7, 0.7F, heroes(4));
    const auto hash = [&](std::uint32_t number, std::uint64_t key) {
        return hash_of(segments_of(planted.cache, tree_of(number), key));
    };
    std::vector<std::uint64_t> forward;
    for (std::uint32_t number = 0; number < 100; ++number) {
        forward.push_back(hash(number, 5));
    }
    for (std::uint32_t number = 100; number-- > 0;) {
        CHECK(hash(number, 5) == forward[number]);
    }
    CHECK(hash(3, 6) != forward[3]);
}

namespace {

/// Measures of a tree: count of segments, height, crown radius, and count of segments by order.
std::vector<double> measures_of(const std::vector<TreeSegment>& segments) {
    constexpr std::size_t kOrders = 5;
    std::vector<double> measures(3 + kOrders, 0.0);
    measures[0] = static_cast<double>(segments.size());
    for (const TreeSegment& segment : segments) {
        measures[1] = std::max(measures[1], segment.tip.y);
        measures[2] = std::max(measures[2], std::hypot(segment.tip.x, segment.tip.z));
        measures[3 + std::min<std::size_t>(segment.order, kOrders - 1)] += 1.0;
    }
    // Round to mm: a tree assembled from branches differs from the plain one by rounding errors, so
    // that equal heights would differ.
    measures[1] = std::round(measures[1] * 1e3);
    measures[2] = std::round(measures[2] * 1e3);
    return measures;
}

/// samples[i] holds the values of measure i, one per tree.
using Samples = std::vector<std::vector<double>>;

void add(Samples& samples, const std::vector<TreeSegment>& segments) {
    const std::vector<double> measures = measures_of(segments);
    samples.resize(measures.size());
    for (std::size_t i = 0; i < measures.size(); ++i) {
        samples[i].push_back(measures[i]);
    }
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

double squared_standard_error(const std::vector<double>& values) {
    const double middle = mean(values);
    double sum = 0.0;
    for (const double value : values) {
        sum += (value - middle) * (value - middle);
    }
    const auto n = static_cast<double>(values.size());
    return sum / (n - 1.0) / n;
}

/// The largest difference between two empirical distribution functions.
double kolmogorov_smirnov(std::vector<double> a, std::vector<double> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const auto part = [](const std::vector<double>& values, double at) {
        return static_cast<double>(std::upper_bound(values.begin(), values.end(), at) -
                                   values.begin()) /
               static_cast<double>(values.size());
    };
    double max_difference = 0.0;
    for (const std::vector<double>* values : {&a, &b}) {
        for (const double at : *values) {
            max_difference = std::max(max_difference, std::abs(part(a, at) - part(b, at)));
        }
    }
    return max_difference;
}

} // namespace

TEST_CASE("trees of independent caches have the means of plain plants") {
    constexpr std::uint32_t kTrees = 200;
    const std::string grammar = kBush;
    Samples trees;
    Samples plants;
    for (std::uint32_t i = 0; i < kTrees; ++i) {
        const Planted planted = plant(grammar, 7, 0.6F, heroes(10, 1'000 + 10 * i));
        add(trees, segments_of(planted.cache, tree_of(i), i));
        add(plants, segments_of(plain_plant(grammar, 7, 100'000 + i)));
    }
    for (std::size_t m = 0; m < trees.size(); ++m) {
        const double error =
            std::sqrt(squared_standard_error(trees[m]) + squared_standard_error(plants[m]));
        INFO("measure " << m << ": " << mean(trees[m]) << " and " << mean(plants[m]));
        CHECK(std::abs(mean(trees[m]) - mean(plants[m])) <= 3.0 * error);
    }
}

TEST_CASE("trees of five hundred heroes have the distributions of plain plants") {
    constexpr std::uint32_t kTrees = 500;
    const Planted planted = plant(kBush, 7, 0.6F, heroes(500));
    Samples trees;
    Samples plants;
    for (std::uint32_t i = 0; i < kTrees; ++i) {
        add(trees, segments_of(planted.cache, tree_of(i), 3));
        add(plants, segments_of(plain_plant(kBush, 7, 100'000 + i)));
    }
    // Critical value of the two-sample test at 1 %, for samples of equal size (Smirnov 1948).
    const double bound = 1.628 * std::sqrt(2.0 / kTrees);
    for (std::size_t m = 0; m < trees.size(); ++m) {
        INFO("measure " << m);
        CHECK(kolmogorov_smirnov(trees[m], plants[m]) <= bound);
    }
}

TEST_CASE("ten heroes of Carey's trees give ten thousand different trees") {
    const auto [name, generations] =
        GENERATE(table<std::string, std::uint32_t>({{"carey-type-0", 20}, {"carey-type-2", 18}}));
    const Planted planted = plant(sample(name), generations, 0.6F, heroes(10));
    std::set<std::uint64_t> different;
    for (std::uint32_t number = 0; number < 10'000; ++number) {
        different.insert(hash_of(segments_of(planted.cache, tree_of(number), 1)));
    }
    INFO(name);
    CHECK(different.size() >= 9'900);
}

TEST_CASE("a production with forty branches can be instanced") {
    std::string successor = "F";
    for (int i = 0; i < 40; ++i) {
        successor += "[+B]/";
    }
    const std::string grammar = "#set names letters; #w : A; #p : A : * : " + successor +
                                "; #q : B : ~ 0.5 : FB;"
                                "#r : B : ~ 0.5 : F[-B];";
    const Planted planted = plant(grammar, 4, 0.5F, heroes(10));
    CHECK(planted.system.kind_count == 2); // [+B] and [-B]
    CHECK(segments_of(planted.cache, tree_of(1), 1).size() >= 41);
}

TEST_CASE("branches that cannot replace each other have different keys") {
    // Branches with the same text and age but different lengths.
    const std::string grammar =
        "#w : B(1) B(2); #p : B(x) : * : [A(x)] F(x); "
        "#q : A(x) : ~ 0.5 : F(x) A(x); #r : A(x) : ~ 0.5 : F(x) F(x) A(x);";
    const Planted planted = plant(grammar, 3, 0.5F, heroes(20));
    for (const InstanceSlot& slot : planted.cache.slots) {
        std::set<float> lengths;
        for (std::uint32_t v = 0; v < slot.variant_count; ++v) {
            const Instance& instance =
                planted.cache.instances[planted.cache.variants[slot.first_variant + v]];
            const DrawnRange& range = planted.cache.ranges[instance.first_range];
            lengths.insert(planted.cache.skeleton.segments[range.begin.segments].length);
        }
        if (slot.id != 0) {
            CHECK(lengths.size() == 1);
        }
    }
    CHECK(planted.cache.slots.size() == 3);
}

TEST_CASE("a maximum per key and a tolerance limit the size of the cache") {
    const std::string grammar = "#set names letters; #w : A; "
                                "#p : A : ~ 0.5 : !({0.9,1.1})F[+B]A; #q : A : ~ 0.5 : F[-B]A; "
                                "#r : B : ~ 0.5 : FB; #s : B : ~ 0.5 : F;";
    CacheOptions options = heroes(20);
    const Planted all = plant(grammar, 6, 0.4F, options);
    options.tolerance = 0.5F;
    const Planted near = plant(grammar, 6, 0.4F, options);
    CHECK(near.cache.slots.size() < all.cache.slots.size() / 2);
    options.cap = 2;
    const Planted capped = plant(grammar, 6, 0.4F, options);
    for (std::size_t i = 1; i < capped.cache.slots.size(); ++i) {
        const InstanceSlot& slot = capped.cache.slots[i];
        CHECK(slot.variant_count >= 1);
        CHECK(slot.variant_count <= 2);
        CHECK(slot.misses <= 1);
    }
    CHECK(segments_of(capped.cache, tree_of(5), 1).size() >= 1);
}

TEST_CASE("branches of different colours have different keys") {
    const std::string grammar = "#w : '(2) B '(3) B; #p : B : * : [A] F; "
                                "#q : A : ~ 0.5 : F A; #r : A : ~ 0.5 : F F A;";
    CHECK(plant(grammar, 3, 0.5F, heroes(20)).cache.slots.size() == 3);
}

TEST_CASE("if the first value of a key is 0, the tolerance is absolute") {
    const auto slots_of = [](const std::string& axiom) {
        CacheOptions options = heroes(20);
        options.tolerance = 0.5F;
        const std::string rules = "#p : B(x) : * : [A(x)] F; #q : A(x) : ~ 0.5 : F(9 + x) A(x); "
                                  "#r : A(x) : ~ 0.5 : F F(9 + x) A(x);";
        return plant("#w : " + axiom + "; " + rules, 3, 0.5F, options).cache.slots.size();
    };
    CHECK(slots_of("B(0)") == 2);
    CHECK(slots_of("B(0) B(5) B(50)") == 4);
    CHECK(slots_of("B(0) B(0.1) B(-0.1)") == 2);
}

TEST_CASE("a hero over the limit on modules ends the cache") {
    const Planted planted =
        plant("#w : A; #p : A : ~ 0.5 : [F A] A; #q : A : ~ 0.5 : F A;", 3, 0.5F, heroes(1));
    CacheOptions options = heroes(1);
    options.generations = 3;
    options.limits.max_modules = 3;
    const CacheOutcome outcome = make_instance_cache(planted.system.bytecode, options);
    CHECK_FALSE(outcome.ok());
    CHECK(outcome.derivation_end.stop == Stop::Limit);
}
