// SPDX-License-Identifier: MIT
// Measures time and memory of forests, to compare them with Kenwood, Gain & Marais 2014: 1,000,000
// distinct trees in 4.5 s and 350 MB. Places 10^4 to 10^7 trees, expands each tree into its list of
// branches, and writes files of 10,000 trees. Usage: forest_bench [THREADS]. Asserts nothing.
#include "compiler/compile.h"
#include "compiler/instancing/instance.h"
#include "grammar/lsys/parse.h"
#include "runtime/base/random.h"
#include "runtime/export/export_forest.h"
#include "runtime/forest/forest.h"
#include "tests/bench/measure.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <sys/resource.h>
#include <utility>
#include <vector>

namespace {

using namespace lsys;
using bench::fail;
using bench::median;
using bench::seconds;

/// Time limit in s: after a forest that takes longer, larger forests are skipped.
constexpr double kMaxSeconds = 4.0;

struct Kind {
    const char* name;
    std::uint32_t generations;
    const char* grammar;
};

/// Carey's default trees 0 and 2, and a bush of few branches.
constexpr Kind kKinds[] = {
    {"carey 0", 20,
     R"(#set turtle houdini; #set names letters; #set rewriting cyclic; #set weights any;
#set angle 30; #set step 1.2; #set step_scale 0.9; #set width 1.2; #set width_scale 0.7;
#w : ///FFFFFFFA;
#a1 : A : ~ 0.5 : ![&FL!A]//[&FL!A]/////[&FL!A];
#a2 : A : ~ 0.5 : ![&FL!A]//////[&FL!A]/////////[&FL!A];
#f : &F : * : &S/////F;
#s1 : S : ~ 0.6 : FL;
#s2 : S : ~ 0.4 : FFL;
#l : L : * : [^""""""{.-f.+f.+f.--(180)-f.+f.+f.}];)"},
    {"carey 2", 18,
     R"(#set turtle houdini; #set names letters; #set rewriting cyclic; #set weights any;
#set angle 30; #set step 2; #set step_scale 0.9; #set width 1; #set width_scale 0.7;
#w : FFFA;
#a : A : * : !"[BJ]////[BJ]////BJ;
#b1 : B : ~ 0.2 : &FFFA;
#b2 : B : ~ 0.2 : &[!!C]FFFA;
#b3 : B : ~ 0.2 : &F[!!C]FFA;
#b4 : B : ~ 0.2 : &FF[!!C]FA;
#b5 : B : ~ 0.2 : &FFF[!!C]A;
#c1 : C : ~ 0.3 : /&F!FJ;
#c2 : C : ~ 0.3 : \&FJ;
#c3 : C : ~ 0.3 : &FJ;)"},
    {"bush", 5,
     R"(#set names letters; #set angle 25; #w : A;
#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A; #r : A : ~ 0.2 : FF[&A]F;)"},
};

ForestStage stage_of(const Kind& kind) {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileId root = sources.add("bench.lsys", kind.grammar);
    const FileLoader none = [](const std::string&) -> Result<std::string> {
        return Error{"no such file"};
    };
    CompileOptions compile_options;
    compile_options.generations = kind.generations;
    CompileOutcome compiled = compile(parse_lsys(root, {sources, names, diagnostics, none}), names,
                                      sources, compile_options, diagnostics);
    if (!compiled.program) {
        fail("a grammar does not compile");
    }
    std::optional<InstancedSystem> system =
        compile_instanced(std::move(*compiled.program), names, sources, 0.6F, diagnostics);
    if (!system) {
        fail("a grammar cannot be instanced");
    }
    CacheOptions options;
    options.generations = kind.generations;
    options.depends_on_vertical = system->depends_on_vertical;
    ForestStage stage;
    stage.generations = kind.generations;
    CacheOutcome outcome = make_instance_cache(system->bytecode, options);
    if (!outcome.ok()) {
        fail("a cache cannot be made");
    }
    stage.cache = std::move(outcome.cache);
    return stage;
}

/// Sets place, yaw and scale of each tree, with one block of random numbers per tree.
void place(Forest& forest, std::uint32_t count) {
    forest.trees.clear();
    forest.trees.resize(count);
    const double side = 5.0 * std::sqrt(static_cast<double>(count));
    for (std::uint32_t i = 0; i < count; ++i) {
        const PhiloxBlock block = draw_block(forest.key, 1, i, 0);
        Tree tree;
        tree.position = {static_cast<float>(side * static_cast<double>(unit_interval(block[0]))),
                         0.0F,
                         static_cast<float>(side * static_cast<double>(unit_interval(block[1])))};
        tree.yaw = 2.0F * std::numbers::pi_v<float> * unit_interval(block[2]);
        tree.scale = 0.8F + 0.4F * unit_interval(block[3]);
        tree.number = i;
        forest.trees[i] = tree;
    }
}

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void measure(const Kind& kind, std::uint32_t threads) {
    Forest forest;
    forest.key = 42;
    const double cache_seconds = seconds([&] {
        ForestSpecies& species = forest.species.emplace_back();
        species.name = kind.name;
        species.stages.push_back(stage_of(kind));
    });
    const InstanceCache& cache = forest.species[0].stages[0].cache;
    fmt::print("{}: cache of {} instances, {} segments, made in {:.1f} ms\n", kind.name,
               cache.instances.size(), cache.skeleton.segments.size(), cache_seconds * 1e3);
    for (const std::uint32_t count : {10'000U, 100'000U, 1'000'000U, 10'000'000U}) {
        std::vector<double> placing;
        std::vector<double> expanding;
        ForestCounts counts;
        const int rounds = count > 1'000'000U ? 1 : 3;
        for (int round = 0; round < rounds; ++round) {
            placing.push_back(seconds([&] { place(forest, count); }));
            expanding.push_back(seconds([&] { counts = count_forest(forest, threads); }));
        }
        const double spent = median(placing) + median(expanding);
        fmt::print("{:>11} trees {:>8.1f} branches a tree {:>9.1f} ms to place {:>9.1f} ms to "
                   "expand {:>7.1f} ns a branch {:>7.2f} M trees/s {:>8.1f} MB at peak\n",
                   count, static_cast<double>(counts.branches) / count, median(placing) * 1e3,
                   median(expanding) * 1e3,
                   median(expanding) * 1e9 / static_cast<double>(counts.branches),
                   count / spent / 1e6, peak_megabytes());
        std::fflush(stdout);
        if (spent > kMaxSeconds) {
            break;
        }
    }
}

/// Times the export of 10,000 trees to GLB; the bytes are discarded.
void measure_files(const Kind& kind) {
    Forest forest;
    forest.key = 42;
    ForestSpecies& species = forest.species.emplace_back();
    species.name = kind.name;
    species.stages.push_back(stage_of(kind));
    place(forest, 10'000);
    std::vector<std::vector<InstanceMeshes>> meshes(1);
    const double meshing = seconds([&] {
        if (make_instance_meshes(species.stages[0].cache, {}, {}, meshes[0].emplace_back())) {
            fail("no surfaces");
        }
    });
    const ForestScene scene{forest, meshes, nullptr};
    for (const float cell : {0.0F, 100.0F}) {
        std::uint64_t bytes = 0;
        ForestExportInfo info;
        info.cell = cell;
        const double writing = seconds([&] {
            if (!export_forest(scene, ExportFormat::Glb, ForestForm::Instanced, info,
                               [&bytes](std::string_view piece) {
                                   bytes += piece.size();
                                   return true;
                               })) {
                fail("not written");
            }
        });
        const ForestCounts counts = count_forest(forest, 1);
        fmt::print("{}: 10,000 trees as GLB, cells of {} m: {:.0f} ms for surfaces ({:.1f} MB), "
                   "{:.0f} ms to write {:.1f} MB, of which {:.1f} MB for {} branches\n",
                   kind.name, cell, meshing * 1e3,
                   static_cast<double>(meshes[0][0].byte_count()) / 1e6, writing * 1e3,
                   static_cast<double>(bytes) / 1e6,
                   40.0 * static_cast<double>(counts.branches) / 1e6, counts.branches);
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::uint32_t threads = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 2;
    fmt::print("Threads of the expansion: {}.\n", threads);
    for (const Kind& kind : kKinds) {
        measure(kind, threads);
    }
    for (const Kind& kind : kKinds) {
        measure_files(kind);
    }
    return 0;
}
