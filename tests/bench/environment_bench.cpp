// SPDX-License-Identifier: MIT
// Measures environments that sense places, markers and meshes. Prints the median of several runs
// for each case, with one thread and with the number of threads in the first argument (2 without an
// argument). The second argument names the only kind of environment to measure. The hash of the
// answers shows whether a change of the algorithm keeps their bits. Asserts nothing about time.
#include "runtime/environment/environment.h"
#include "tests/bench/measure.h"
#include "tests/runtime/environment/solids.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace lsys;

constexpr int kRuns = 9;

/// `count` places in a cube with edges of `edge` metres; all headings point up.
std::vector<SensePlace> places_in_cube(std::size_t count, double edge) {
    std::mt19937 engine(1);
    std::vector<SensePlace> places(count);
    for (SensePlace& place : places) {
        for (double& coordinate : place.position) {
            coordinate = edge * (static_cast<double>(engine()) * 0x1p-32 - 0.5);
        }
        place.heading = {0.0, 1.0, 0.0};
        place.up = {0.0, 0.0, 1.0};
    }
    return places;
}

void stop_at(const std::optional<EnvironmentFailure>& failure) {
    if (failure) {
        bench::fail("an environment has no answer: " + failure->text);
    }
}

using Maker = std::function<std::unique_ptr<Environment>(const EnvironmentContext&)>;

/// Prints the median times of begin() and of the first answer() after it.
void measure(const std::string& name,
             const Maker& maker,
             const std::vector<SensePlace>& places,
             std::uint32_t threads) {
    Workers workers(threads);
    workers.start();
    EnvironmentContext context;
    context.workers = &workers;
    std::vector<double> begins;
    std::vector<double> answers;
    std::vector<float> numbers(places.size() * 4);
    std::vector<std::uint32_t> sizes;
    SensedWord word;
    word.places = places;
    for (int run = 0; run < kRuns; ++run) {
        const std::unique_ptr<Environment> environment = maker(context);
        begins.push_back(bench::seconds([&] { stop_at(environment->begin(1)); }));
        answers.push_back(
            bench::seconds([&] { stop_at(environment->answer(word, numbers, sizes)); }));
    }
    fmt::print("{:<52} {} threads: begin {:8.1f} ms, answer {:8.1f} ms, hash {:016x}\n", name,
               threads, 1e3 * bench::median(begins), 1e3 * bench::median(answers),
               bench::hash(numbers));
    std::fflush(stdout);
}

void measure_space(std::uint32_t threads) {
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Space;
    declared.shape = SpaceShape::Dome;
    declared.size = {10.0F, 10.0F, 10.0F};
    declared.count = 100'000;
    declared.radius = 1.0F;
    declared.kill = 0.1F;
    const EnvironmentFiles files;
    const auto maker = [&](const EnvironmentContext& context) {
        return make_space(declared, files, 0, context);
    };
    std::vector<SensePlace> places = places_in_cube(10'000, 10.0);
    for (SensePlace& place : places) {
        place.position[1] += 5.0;
    }
    measure("space, 100,000 markers, 10,000 buds", maker, places, threads);
    declared.angle = 360.0F;
    measure("space, 100,000 markers, 10,000 buds, angle 360", maker, places, threads);
}

void measure_crowd(std::uint32_t threads) {
    const std::vector<SensePlace> places = places_in_cube(1'000'000, 100.0);
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Crowd;
    const auto maker = [&](const EnvironmentContext& context) {
        return make_crowd(declared, context);
    };
    declared.radius = 1.0F;
    measure("crowd, 1,000,000 places, 4 within the radius", maker, places, threads);
    declared.radius = 2.0F;
    measure("crowd, 1,000,000 places, 34 within the radius", maker, places, threads);
    declared.radius = 1000.0F;
    measure("crowd, 1,000,000 places, all within the radius", maker, places, threads);
}

void measure_solid(std::uint32_t threads) {
    const std::vector<SensePlace> places = places_in_cube(1'000'000, 10.0);
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Solid;
    declared.surfaces.resize(1);
    declared.surfaces[0].path = "sphere.obj";
    EnvironmentFiles files;
    files.meshes.push_back(environments::sphere_mesh({0.0, 0.0, 0.0}, 4.0, 159));
    const auto maker = [&](const EnvironmentContext& context) {
        return make_solid(declared, files, context);
    };
    const std::size_t triangles = files.meshes[0].triangles.size();
    measure(fmt::format("solid, 1,000,000 places, closed, {} triangles", triangles), maker, places,
            threads);
    files.meshes[0].triangles.pop_back();
    measure(fmt::format("solid, 1,000,000 places, open, {} triangles", triangles - 1), maker,
            places, threads);
}

} // namespace

int main(int argument_count, char** arguments) {
    const int threads = argument_count > 1 ? std::atoi(arguments[1]) : 2;
    if (threads < 1) {
        bench::fail("the number of threads is not a positive number");
    }
    const std::string_view only = argument_count > 2 ? arguments[2] : "";
    const auto is_wanted = [&](std::string_view kind) { return only.empty() || only == kind; };
    for (const std::uint32_t count : {1U, static_cast<std::uint32_t>(threads)}) {
        if (is_wanted("space")) {
            measure_space(count);
        }
        if (is_wanted("crowd")) {
            measure_crowd(count);
        }
        if (is_wanted("solid")) {
            measure_solid(count);
        }
    }
    return 0;
}
