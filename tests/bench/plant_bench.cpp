// SPDX-License-Identifier: MIT
// Compares turtles and tubes with hand-written programs for the same words (tests/bench/limits.h),
// in one run on one machine. Values are millions of vertices per second, the best of several runs;
// each run gets fresh memory from the system and frees it after the measurement. `lines` are the
// segments of a skeleton, with two vertices each; `tubes` have eight sides, positions and normals.
// The time of tubes includes skeleton and mesh; one or two threads make the mesh. GLB exports the
// same mesh to a sink that discards the bytes. Asserts nothing.
#include "runtime/derive/derive.h"
#include "runtime/export/export.h"
#include "runtime/meshing/mesh.h"
#include "runtime/turtle/turtle.h"
#include "tests/bench/limits.h"
#include "tests/bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace lsys;
using bench::compile_text;
using bench::fail;
using bench::FreshPages;
using bench::PageSize;
using bench::seconds;

constexpr int kRuns = 7;

/// The min time of several calls of `run`, each of which returns its time in s. Not the median: if
/// a virtual machine has given free memory back to its host, some runs get pages that take twenty
/// times as long.
double least_of(const std::function<double()>& run) {
    double min_time = run();
    for (int i = 1; i < kRuns; ++i) {
        min_time = std::min(min_time, run());
    }
    return min_time;
}

struct Plant {
    const char* name;
    bench::PlainSystem system;
    std::uint32_t generations;
    float angle; // degrees
    std::string grammar;
};

void measure_plant(const Plant& plant) {
    // The hand-written program of limits.h derives the word.
    constexpr std::size_t kRoom = std::size_t{64} << 20;
    const FreshPages a(kRoom, PageSize::Huge);
    const FreshPages b(kRoom, PageSize::Huge);
    const std::size_t count = bench::derive_plain(plant.system, static_cast<int>(plant.generations),
                                                  a.as<std::uint8_t>(), b.as<std::uint8_t>());
    const std::uint8_t* const word =
        plant.generations % 2 == 0 ? a.as<std::uint8_t>() : b.as<std::uint8_t>();
    const auto segments =
        static_cast<std::size_t>(std::count(word, word + count, static_cast<std::uint8_t>('F')));
    const auto limit = [&](auto program, std::size_t floats, PageSize pages) {
        return least_of([&] {
            const FreshPages out(segments * floats * sizeof(float), pages);
            return seconds([&] {
                if (program(word, count, plant.angle, out.as<float>()) == 0) {
                    fail("nothing is drawn");
                }
            });
        });
    };
    const double line_small = limit(bench::turtle_lines, 6, PageSize::Small);
    const double line_huge = limit(bench::turtle_lines, 6, PageSize::Huge);
    const double tube_small = limit(bench::turtle_tubes, 96, PageSize::Small);
    const double tube_huge = limit(bench::turtle_tubes, 96, PageSize::Huge);

    const Bytecode bytecode = compile_text(plant.grammar);
    DeriveOptions options;
    options.generations = plant.generations;
    Derivation derivation(bytecode, options);
    if (derivation.start() || derivation.run_to(plant.generations)) {
        fail("a plant does not derive");
    }
    const auto draw = [&] {
        Turtle turtle(bytecode, {});
        if (turtle.reserve(derivation.word()) || turtle.feed(derivation.word())) {
            fail("a plant cannot be drawn");
        }
        return turtle.take_skeleton();
    };
    const double line = least_of([&] {
        Skeleton drawn;
        return seconds([&] { drawn = draw(); });
    });
    const Skeleton skeleton = draw();
    if (skeleton.segments.size() != segments) {
        fail("the turtles disagree");
    }
    MeshOptions mesh_options;
    mesh_options.texture_coordinates = false;
    mesh_options.tangents = false;
    mesh_options.colours = false;
    mesh_options.sides = 8;
    const auto tubes_by = [&](std::uint32_t threads) {
        mesh_options.threads = threads;
        return least_of([&] {
            Mesh mesh;
            return seconds([&] {
                if (make_mesh(skeleton, {}, mesh_options, mesh)) {
                    fail("a plant has no mesh");
                }
            });
        });
    };
    const double tube = tubes_by(1);
    const double tube_two_threads = tubes_by(2);
    Mesh mesh;
    static_cast<void>(make_mesh(skeleton, {}, mesh_options, mesh));
    const std::size_t vertices = mesh.positions.size();
    std::size_t bytes = 0;
    const double file = least_of([&] {
        bytes = 0;
        return seconds([&] {
            std::string copy;
            if (!export_mesh(mesh, skeleton, ExportFormat::Glb, {}, [&](std::string_view piece) {
                    bytes += piece.size();
                    copy.assign(piece.substr(0, std::min<std::size_t>(piece.size(), 1 << 18)));
                    return true;
                })) {
                fail("a plant cannot be exported");
            }
        });
    });
    const auto rate = [](std::size_t items, double time) {
        return static_cast<double>(items) / time / 1e6;
    };
    fmt::print("{:<10}{:>9}{:>8.0f}{:>8.0f}{:>8.0f}{:>6.2f}{:>11}{:>8.0f}{:>8.0f}{:>8.0f}{:>6.2f}"
               "{:>8.0f}{:>6.2f}{:>8.1f}{:>8.0f}\n",
               plant.name, segments, rate(2 * segments, line_small), rate(2 * segments, line_huge),
               rate(2 * segments, line), line_huge / line, vertices,
               rate(16 * segments, tube_small), rate(16 * segments, tube_huge),
               rate(vertices, line + tube),
               rate(vertices, line + tube) / rate(16 * segments, tube_huge),
               rate(vertices, line + tube_two_threads),
               rate(vertices, line + tube_two_threads) / rate(16 * segments, tube_huge),
               static_cast<double>(mesh.byte_count()) / static_cast<double>(vertices),
               static_cast<double>(bytes) / file / 1e6);
}

} // namespace

int main() {
    fmt::print("Million vertices a second, memory fresh. Limit programs with small and with huge "
               "pages; `part` is of the one with huge pages.\n\n"
               "{:<10}{:>9}{:>22}{:>8}{:>6}{:>11}{:>16}{:>14}{:>14}{:>8}{:>8}\n"
               "{:<10}{:>9}{:>8}{:>8}{:>8}{:>6}{:>11}{:>8}{:>8}{:>8}{:>6}{:>8}{:>6}{:>8}{:>8}\n",
               "", "", "lines: limit", "", "", "tubes of", "limit", "one thread", "two threads",
               "bytes a", "GLB", "", "segments", "small", "huge", "lsc", "part", "vertices",
               "small", "huge", "lsc", "part", "lsc", "part", "vertex", "MB/s");
    measure_plant({"W1/n=9", bench::koch_w1(), 9, 90.0F,
                   "#set names letters; #set angle 90; #n = 9; #w : F; #p : F : * : F+F-F-F+F;"});
    measure_plant({"W2/n=9", bench::weed_w2(), 9, 25.0F,
                   "#set names letters; #set angle 25; #n = 9; #w : X;"
                   "#p : X : * : F-[[X]+X]+F[+FX]-X; #q : F : * : FF;"});
    measure_plant({"W2/n=11", bench::weed_w2(), 11, 25.0F,
                   "#set names letters; #set angle 25; #n = 11; #w : X;"
                   "#p : X : * : F-[[X]+X]+F[+FX]-X; #q : F : * : FF;"});
    return 0;
}
