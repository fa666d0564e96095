// Turtles and tubes beside hand-written programs for the same words (tests/bench/limits.h), in one
// run on one machine: million vertices a second, medians, memory fresh from the system each time.
// `lines` are the segments of a skeleton, two vertices each; `tubes` have eight sides, positions
// and normals. `export` is GLB of the same mesh into memory that is thrown away. Asserts nothing.
#include "runtime/derive.h"
#include "runtime/export.h"
#include "runtime/mesh.h"
#include "runtime/turtle.h"
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
using bench::median;
using bench::PageSize;
using bench::seconds;

constexpr int kRuns = 7;

/// Median of what `run` says, which is seconds of one run.
double median_of(const std::function<double()>& run) {
    std::vector<double> values;
    for (int i = 0; i < kRuns; ++i) {
        values.push_back(run());
    }
    return median(std::move(values));
}

struct Plant {
    const char* name;
    bench::PlainSystem system;
    std::uint32_t generations;
    float angle;
    std::string grammar;
};

void measure_plant(const Plant& plant, std::uint32_t threads) {
    // The word of the limit program.
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
        return median_of([&] {
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
    if (derivation.start() != DeriveStatus::Ok ||
        derivation.run_to(plant.generations) != DeriveStatus::Ok) {
        fail("a plant does not derive");
    }
    const auto draw = [&] {
        Turtle turtle(bytecode, {});
        if (turtle.reserve(derivation.word()) != TurtleStatus::Ok ||
            turtle.feed(derivation.word()) != TurtleStatus::Ok) {
            fail("a plant cannot be drawn");
        }
        return turtle.take_skeleton();
    };
    const double line = median_of([&] { return seconds([&] { static_cast<void>(draw()); }); });
    const Skeleton skeleton = draw();
    if (skeleton.segments.size() != segments) {
        fail("the turtles disagree");
    }
    MeshOptions mesh_options;
    mesh_options.texture_coordinates = false;
    mesh_options.tangents = false;
    mesh_options.colours = false;
    mesh_options.sides = 8;
    mesh_options.threads = threads;
    std::size_t vertices = 0;
    const double tube = median_of([&] {
        return seconds([&] {
            Mesh mesh;
            if (make_mesh(skeleton, {}, mesh_options, mesh) != MeshStatus::Ok) {
                fail("a plant has no mesh");
            }
            vertices = mesh.positions.size();
        });
    });
    Mesh mesh;
    static_cast<void>(make_mesh(skeleton, {}, mesh_options, mesh));
    std::size_t bytes = 0;
    const double file = median_of([&] {
        bytes = 0;
        return seconds([&] {
            std::string copy;
            if (export_mesh(mesh, skeleton, ExportFormat::Glb, {}, [&](std::string_view piece) {
                    bytes += piece.size();
                    copy.assign(piece.substr(0, std::min<std::size_t>(piece.size(), 1 << 18)));
                    return true;
                }) != ExportStatus::Ok) {
                fail("a plant cannot be exported");
            }
        });
    });
    const auto rate = [](std::size_t items, double time) {
        return static_cast<double>(items) / time / 1e6;
    };
    fmt::print("{:<10}{:>9}{:>12.0f}{:>12.0f}{:>12.0f}{:>8.2f}{:>12}{:>12.0f}{:>12.0f}{:>12.0f}"
               "{:>8.2f}{:>12.0f}\n",
               plant.name, segments, rate(2 * segments, line_small), rate(2 * segments, line_huge),
               rate(2 * segments, line), line_huge / line, vertices,
               rate(16 * segments, tube_small), rate(16 * segments, tube_huge),
               rate(vertices, line + tube),
               rate(vertices, line + tube) / rate(16 * segments, tube_huge),
               static_cast<double>(bytes) / file / 1e6);
}

} // namespace

int main(int argc, char** argv) {
    const std::uint32_t threads = argc > 1 ? static_cast<std::uint32_t>(std::atoi(argv[1])) : 1;
    fmt::print("Million vertices a second, memory fresh; in brackets pages. Threads of the mesher: "
               "{}.\n\n{:<10}{:>9}{:>12}{:>12}{:>12}{:>8}{:>12}{:>12}{:>12}{:>12}{:>8}{:>12}\n",
               threads, "", "segments", "line limit", "[huge]", "lsc", "part", "vertices",
               "tube limit", "[huge]", "lsc", "part", "GLB MB/s");
    measure_plant({"W1/n=9", bench::koch_w1(), 9, 90.0F,
                   "#set names letters; #set angle 90; #n = 9; #w : F; #p : F : * : F+F-F-F+F;"},
                  threads);
    measure_plant({"W2/n=9", bench::weed_w2(), 9, 25.0F,
                   "#set names letters; #set angle 25; #n = 9; #w : X;"
                   "#p : X : * : F-[[X]+X]+F[+FX]-X; #q : F : * : FF;"},
                  threads);
    measure_plant({"W2/n=11", bench::weed_w2(), 11, 25.0F,
                   "#set names letters; #set angle 25; #n = 11; #w : X;"
                   "#p : X : * : F-[[X]+X]+F[+FX]-X; #q : F : * : FF;"},
                  threads);
    return 0;
}
