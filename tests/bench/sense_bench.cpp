// SPDX-License-Identifier: MIT
// Measures environments of kinds Shadow and Sky, and compares Shadow with a hand-written program for
// the same places (tests/bench/limits.h), in one run on one machine; medians in milliseconds.
// Compares the time of answering `?P` with that of the turtle alone, and measures sweeps.
// Usage: sense_bench [shadow | sky | positions | sweep [TEXT]]: the only kind to measure; TEXT: a
// part of the names of the sweeps to measure. Asserts nothing about time.
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
#include <ctime>
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

/// Compares the time of answering 2^20 `?P` of a word with that of drawing the word.
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

/// A sweep of a word without further rewriting.
struct SweepRow {
    const char* name;
    const char* word;   // the statements that make the word
    const char* sweeps; // productions of `#down` or `#up`
};

/// A chain of 2^20 modules, and a plant that forks 17 times, with one parameter in each F and L.
constexpr const char* kSweptChain = "#w : B; #p : B : step() < 20 : B B; #q : B : * : A(1);";
constexpr const char* kSweptPlant = "#w : B; #p : B : step() < 17 : F(1) [ + B ] [ - B ];"
                                    "#q : B : * : L(1);";
constexpr std::uint32_t kGrown = 21; // generations after which nothing is rewritten

constexpr SweepRow kSweepRows[] = {
    {"chain, sum", kSweptChain, "#down d : A(x) > A(y) : * : A(y+1);"},
    {"chain, sum, up", kSweptChain, "#up d : A(y) < A(x) : * : A(y+1);"},
    {"chain, sums of products", kSweptChain, "#down d : A(x) > A(y) : * : A(0.5*x+0.5*y);"},
    {"chain, condition", kSweptChain,
     "#down d : A(x) > A(y) : y < 9 : A(y+1); #down e : A(x) : * : A(0);"},
    {"chain, if", kSweptChain, "#down d : A(x) > A(y) : * : A(if(y < 9, y+1, x));"},
    {"chain, local values", kSweptChain,
     "#down d : A(x) > A(y) : * : let m = x+y, h = m*0.25 : A(m-h);"},
    {"chain, random range", kSweptChain, "#down d : A(x) > A(y) : * : A(0.5*y+{0.5, 1});"},
    {"chain, random choice", kSweptChain,
     "#down d : A(x) > A(y) : ~ 0.5 : A(y+1); #down e : A(x) > A(y) : ~ 0.5 : A(x);"},
    {"chain, choice by weights", kSweptChain,
     "#set weights any; #down d : A(x) > A(y) : x < 5 ~ y : A(y+1);"
     "#down e : A(x) > A(y) : * ~ x : A(1);"},
    {"chain, all of these", kSweptChain,
     "#down d : A(x) > A(y) : if(x < 9, 1, 0) : let r = {0.5, 1}, m = max(x, y) :"
     " A(if(m < 9, m*0.5+r, r));"},
    {"chain, no context", kSweptChain, "#down d : A(x) : * : A(if(x < 9, x+{0.5, 1}, 1));"},
    {"chain, two modules", kSweptChain, "#down d : A(x) > A(y) A(z) : * : A(0.5*y+0.5*z);"},
    {"chain, two modules, up", kSweptChain, "#up d : A(z) A(y) < A(x) : * : A(0.5*y+0.5*z);"},
    {"plant, sum of branches", kSweptPlant,
     "#ignore : + -; #down d : F(x) > [F(y)][F(z)] : * : F(y+z);"
     "#down e : F(x) > [L(y)][L(z)] : * : F(y+z);"},
    {"plant, long branches", kSweptPlant,
     "#down d : F(x) > [+F(y)][-F(z)] : * : F(y+z);"
     "#down e : F(x) > [+L(y)][-L(z)] : * : F(y+z);"},
    {"plant, grandchildren", kSweptPlant,
     "#ignore : + -; #down d : F(x) > [F(y)[F(z)]][F(w)] : * : F(0.5*y+z+w);"},
    {"plant, up with if and range", kSweptPlant,
     "#ignore : + -; #up d : F(y) < F(x) : * : F(if(y < 9, y+{0.5, 1}, 1));"
     "#up e : F(y) < L(x) : * : L(max(x, y));"},
    {"plant, pipe model", kSweptPlant,
     "#ignore : + -; #down d : F(x) > [F(y)][F(z)] : * : F(sqrt(y*y+z*z));"
     "#down e : F(x) > [L(y)][L(z)] : * : F(sqrt(y*y+z*z));"},
};

/// Median processor time in ms. For work on one thread, as a sweep is: other programs disturb it
/// less than milliseconds().
double processor_milliseconds(const std::function<void()>& work) {
    std::vector<double> times;
    for (int i = 0; i < kRuns; ++i) {
        const std::clock_t start = std::clock();
        work();
        times.push_back(1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return median(times);
}

/// Prints the throughput of sweeps. After kGrown generations nothing is rewritten any more, so each
/// further step only copies the word and sweeps it once.
void measure_sweeps(std::string_view only) {
    fmt::print("\nSweeps, copying of the word included. The hash of the parameters tells whether a "
               "change keeps their bits.\n\n{:<30}{:>10}{:>14}  hash\n",
               "", "modules", "M modules/s");
    for (const SweepRow& row : kSweepRows) {
        if (std::string_view(row.name).find(only) == std::string_view::npos) {
            continue;
        }
        const Bytecode bytecode = bench::compile_text(std::string(row.word) + row.sweeps);
        DeriveOptions options;
        options.generations = kGrown + kRuns;
        options.threads = 2;
        Derivation derivation(bytecode, options);
        if (derivation.start() || derivation.run_to(kGrown)) {
            fail("a plant does not derive");
        }
        const double spent = processor_milliseconds([&] {
            if (derivation.step()) {
                fail("a sweep fails");
            }
        });
        const Word& word = derivation.word();
        const double modules = static_cast<double>(word.module_count());
        fmt::print("{:<30}{:>10}{:>14.0f}  {:016x}\n", row.name, word.module_count(),
                   modules / spent / 1000.0,
                   bench::hash({word.parameters().begin(), word.parameters().end()}));
    }
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
    if (is_wanted("sweep")) {
        measure_sweeps(argument_count > 2 ? arguments[2] : "");
    }
    return 0;
}
