// SPDX-License-Identifier: MIT
#include "tests/support/derived.h"

#include "runtime/derive/fold_reached.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"

#include <catch2/catch.hpp>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace lsys::test {

namespace {

constexpr std::array<std::uint32_t, 3> kThreads{1, 2, 3};
constexpr std::array<std::uint32_t, 5> kChunks{1, 2, 7, 64, 1U << 16};

DeriveOptions options_for(std::uint32_t generations,
                          std::uint64_t seed,
                          std::uint32_t threads,
                          std::uint32_t chunk_modules) {
    DeriveOptions options;
    options.generations = generations;
    options.seed = seed;
    options.threads = threads;
    options.chunk_modules = chunk_modules;
    return options;
}

/// The text of the last word; `origins` receives the origins of its modules if `options` request
/// origins.
std::string
derived_with(const Bytecode& bytecode, const DeriveOptions& options, std::vector<Origin>& origins) {
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(options.generations) == std::nullopt);
    REQUIRE(derivation.age() == options.generations);
    const std::span<const Origin> found = derivation.word().origins();
    CHECK(found.size() == (options.origins ? derivation.word().module_count() : 0));
    origins.assign(found.begin(), found.end());
    return text_of(bytecode, derivation.word());
}

std::string
streamed(const Bytecode& bytecode, const DeriveOptions& options, std::vector<Origin>& origins) {
    WordPrinter printer(bytecode);
    std::string text;
    std::uint64_t modules = 0;
    origins.clear();
    const StreamOutcome outcome = derive_streamed(bytecode, options, [&](const StreamChunk& chunk) {
        CHECK(chunk.origins.size() == (options.origins ? chunk.codes.size() : 0));
        printer.append(chunk.codes, chunk.parameters, text);
        origins.insert(origins.end(), chunk.origins.begin(), chunk.origins.end());
        modules += chunk.codes.size();
        return true;
    });
    REQUIRE(outcome.end.stop == std::nullopt);
    CHECK(outcome.modules == modules);
    return text;
}

bool same(const RuntimeError& a, const RuntimeError& b) {
    return a.kind == b.kind && a.production == b.production && a.site == b.site &&
           a.generation == b.generation && a.position == b.position && a.symbol == b.symbol &&
           a.parameters == b.parameters && a.in_condition == b.in_condition;
}

/// Calls `visit` with the program, and with the program whose reachable modules are folded.
template <typename Visit>
void for_each_program(const Bytecode& bytecode,
                      std::uint32_t generations,
                      std::uint64_t seed,
                      const Visit& visit) {
    visit(bytecode);
    if (const std::optional<Bytecode> folded = fold_reached(bytecode, seed, generations)) {
        INFO("folded");
        visit(*folded);
    }
}

} // namespace

std::string text_of(const Bytecode& bytecode, const Word& word) {
    std::uint64_t stored = 0;
    for (std::uint64_t i = 0; i < word.module_count(); ++i) {
        REQUIRE(word.code(i) < bytecode.code_count());
        stored += bytecode.stored_parameters(word.code(i));
    }
    REQUIRE(stored == word.parameter_count());
    std::string text;
    WordPrinter printer(bytecode);
    REQUIRE(printer.print(word, [&text](std::string_view piece) {
        text += piece;
        return true;
    }));
    return text;
}

std::string derived(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed) {
    std::vector<Origin> none;
    return derived_with(bytecode, options_for(generations, seed, 1, 1U << 16), none);
}

std::string
derived_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed) {
    const std::string expected = derived(bytecode, generations, seed);
    DeriveOptions options = options_for(generations, seed, 1, 1U << 16);
    options.origins = true;
    std::vector<Origin> origins;
    CHECK(derived_with(bytecode, options, origins) == expected);
    std::vector<Origin> found;
    const auto derive_in = [&](const Bytecode& program, bool asks) {
        for (const std::uint32_t threads : kThreads) {
            for (const std::uint32_t chunk : kChunks) {
                INFO(threads << " threads, chunks of " << chunk << ", origins: " << asks);
                options = options_for(generations, seed, threads, chunk);
                options.origins = asks;
                CHECK(derived_with(program, options, found) == expected);
                CHECK((!asks || found == origins));
            }
        }
        if (!streaming_obstacle(program)) {
            options = options_for(generations, seed, 1, 64);
            options.origins = asks;
            CHECK(streamed(program, options, found) == expected);
            CHECK((!asks || found == origins));
        }
    };
    for_each_program(bytecode, generations, seed, [&](const Bytecode& program) {
        derive_in(program, false);
        derive_in(program, true);
    });
    return expected;
}

RuntimeError
error_every_way(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed) {
    std::optional<RuntimeError> expected;
    for_each_program(bytecode, generations, seed, [&](const Bytecode& program) {
        for (const std::uint32_t threads : kThreads) {
            for (const std::uint32_t chunk : kChunks) {
                INFO(threads << " threads, chunks of " << chunk);
                Derivation derivation(program, options_for(generations, seed, threads, chunk));
                std::optional<Stop> stop = derivation.start();
                if (!stop) {
                    stop = derivation.run_to(generations);
                }
                REQUIRE(stop == Stop::Diagnosed);
                if (!expected) {
                    expected = derivation.error();
                }
                CHECK(same(derivation.error(), *expected));
            }
        }
    });
    return *expected;
}

} // namespace lsys::test
