// SPDX-License-Identifier: MIT
// Measures environments of kinds Shadow and Sky, and compares Shadow with a hand-written program for
// the same cloud (tests/bench/limits.h), in one run on one machine. Values are medians in
// milliseconds. Compares the answers to `?P` with the turtle alone. The argument, shadow, sky or
// positions, leaves out the others. Asserts nothing about time.
#include "runtime/base/workers.h"
#include "runtime/derive/derive.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/word_sense.h"
#include "runtime/turtle/turtle.h"
#include "tests/bench/limits.h"
#include "tests/bench/measure.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace lsys;
using bench::fail;
using bench::median;
using bench::seconds;

constexpr int kRuns = 7;

double milliseconds(const std::function<void()>& work) {
    std::vector<double> times;
    for (int i = 0; i < kRuns; ++i) {
        times.push_back(1000.0 * seconds(work));
    }
    return median(times);
}

/// Points that are spread evenly over a ball.
std::vector<SensePlace> ball(std::size_t count, double radius) {
    std::mt19937_64 engine(1);
    const auto coordinate = [&] {
        return radius * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0);
    };
    std::vector<SensePlace> places;
    while (places.size() < count) {
        const Vector3 at{coordinate(), coordinate(), coordinate()};
        if (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] < radius * radius) {
            places.push_back({at, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
        }
    }
    return places;
}

double ask(const std::function<std::unique_ptr<Environment>(const EnvironmentContext&)>& make,
           const SensedWord& word,
           std::vector<float>& answers,
           std::uint32_t threads) {
    Workers workers(threads);
    workers.start();
    EnvironmentContext context;
    context.workers = &workers;
    const std::unique_ptr<Environment> environment = make(context);
    std::vector<std::uint32_t> sizes;
    return milliseconds([&] {
        if (environment->answer(word, answers, sizes)) {
            fail("an environment does not answer");
        }
    });
}

void measure_shadow(const char* name, const std::vector<SensePlace>& places, float cell) {
    BytecodeEnvironment declared;
    declared.cell = cell;
    SensedWord word;
    word.places = places;
    std::vector<float> answers(4 * places.size());
    const auto make = [&](const EnvironmentContext& context) {
        return make_shadow(declared, context);
    };
    std::vector<double> positions;
    for (const SensePlace& place : places) {
        positions.insert(positions.end(), place.position.begin(), place.position.end());
    }
    std::vector<float> limit_answers(places.size());
    double limit = 0.0;
    if (bench::shadow_limit(positions, static_cast<double>(cell), limit_answers)) {
        limit = milliseconds([&] {
            static_cast<void>(
                bench::shadow_limit(positions, static_cast<double>(cell), limit_answers));
        });
    }
    const double one = ask(make, word, answers, 1);
    const double two = ask(make, word, answers, 2);
    for (std::size_t i = 0; limit > 0.0 && i < places.size(); ++i) {
        if (std::abs(answers[4 * i] - limit_answers[i]) > 1e-5F) {
            fail("the limit program answers otherwise");
        }
    }
    fmt::print("{:<26}{:>10}{:>12.1f}{:>12.1f}{:>12.1f}  {:016x}\n", name, places.size(), limit,
               one, two, bench::hash(answers));
}

void measure_sky(const char* name, std::size_t count, float cell) {
    BytecodeEnvironment declared;
    declared.kind = EnvironmentKind::Sky;
    declared.cell = cell;
    const std::vector<SensePlace> places = ball(count, 10.0);
    std::vector<SensedOrgan> organs;
    for (const SensePlace& place : places) {
        organs.push_back({place.position, 0.002});
    }
    SensedWord word;
    word.places = places;
    word.organs = organs;
    std::vector<float> answers(count);
    const auto make = [&](const EnvironmentContext& context) {
        return make_sky(declared, context);
    };
    const double one = ask(make, word, answers, 1);
    const double two = ask(make, word, answers, 2);
    fmt::print("{:<26}{:>10}{:>12}{:>12.1f}{:>12.1f}  {:016x}\n", name, count, "", one, two,
               bench::hash(answers));
}

/// Compares the answers to 2^20 `?P` of a word with drawing the same word.
void measure_positions() {
    const Bytecode bytecode =
        bench::compile_text("#w : A;\n"
                            "#p : A : step() < 20 : A A;\n"
                            "#q : A : step() >= 20 : F(1) +(3) ?P(0, 0, 0);\n");
    SenseOptions sense_options;
    sense_options.threads = 2;
    EnvironmentSense sense(bytecode, sense_options);
    DeriveOptions options;
    options.generations = 21;
    options.senses = &sense;
    Derivation derivation(bytecode, options);
    if (derivation.start() || derivation.run_to(options.generations)) {
        fail("a plant does not derive");
    }
    Word word = derivation.take_word();
    DerivationEnd end;
    const double answered = milliseconds([&] {
        if (sense.sense(word, options.generations, end)) {
            fail("positions are not answered");
        }
    });
    Skeleton drawn;
    const double turtle_alone = milliseconds([&] {
        Turtle turtle(bytecode, {});
        if (turtle.reserve(word) || turtle.feed(word)) {
            fail("a plant cannot be drawn");
        }
        drawn = turtle.take_skeleton();
    });
    fmt::print("\n{} segments and as many ?P: answers {:.1f} ms, the turtle alone {:.1f} ms, "
               "ratio {:.2f}\n",
               drawn.segments.size(), answered, turtle_alone, answered / turtle_alone);
}

} // namespace

int main(int argument_count, char** arguments) {
    const std::string_view only = argument_count > 1 ? arguments[1] : "";
    const auto is_wanted = [&](std::string_view kind) { return only.empty() || only == kind; };
    fmt::print("Environments, ms. The limit program gives the exposure of shadow alone, by one "
               "thread, if all voxels fit into memory. The hash of the answers tells whether a "
               "change keeps their "
               "bits.\n\n{:<26}{:>10}{:>12}{:>12}{:>12}  hash\n",
               "", "places", "limit", "one thread", "two threads");
    if (is_wanted("shadow")) {
        measure_shadow("shadow, 20 m, cell 0.5", ball(1'000'000, 10.0), 0.5F);
        measure_shadow("shadow, 20 m, cell 0.1", ball(1'000'000, 10.0), 0.1F);
        measure_shadow("shadow, 20 m, cell 0.03", ball(1'000'000, 10.0), 0.03F);
        measure_shadow("shadow, 1 km, cell 0.001", ball(1'000'000, 500.0), 0.001F);
    }
    if (is_wanted("sky")) {
        measure_sky("sky, 20 m, cell 0.5", 100'000, 0.5F);
        measure_sky("sky, 20 m, cell 0.05", 10'000, 0.05F);
    }
    if (is_wanted("positions")) {
        measure_positions();
    }
    return 0;
}
