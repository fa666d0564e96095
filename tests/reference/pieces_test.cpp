// SPDX-License-Identifier: MIT
// Derives random grammars with all ways of dividing a derivation: threads, chunks of a few modules,
// streaming. The words of the oracle are so small that `lsc` itself never divides them.

#include "runtime/base/random.h"
#include "runtime/derive/derive.h"
#include "tests/reference/compile_case.h"
#include "tests/reference/generate.h"
#include "tests/reference/print.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace lsys::reference {

namespace {

/// A word of `count` modules with random codes. Most codes are `usual`, so that equal codes adjoin.
lsys::Word
random_word(const Bytecode& bytecode, std::uint64_t seed, std::uint64_t count, Code usual) {
    std::vector<Code> codes;
    std::uint64_t parameters = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const PhiloxBlock drawn = draw_block(seed, 0, i, 0);
        const bool is_usual = drawn[1] % 100 < seed % 100;
        codes.push_back(is_usual ? usual : drawn[0] % bytecode.code_count());
        parameters += bytecode.stored_parameters(codes.back());
    }
    lsys::Word word(code_width(bytecode.code_count()));
    REQUIRE(word.keep_origins());
    REQUIRE(word.resize(count, parameters));
    for (std::uint64_t i = 0; i < count; ++i) {
        // Each module has an origin of its own.
        word.origins()[i] = {kNone, static_cast<std::uint32_t>(i)};
        if (word.code_width() == 1) {
            word.codes<std::uint8_t>()[i] = static_cast<std::uint8_t>(codes[i]);
        } else {
            word.codes<std::uint16_t>()[i] = static_cast<std::uint16_t>(codes[i]);
        }
    }
    for (std::uint64_t i = 0; i < parameters; ++i) {
        word.parameters()[i] = static_cast<float>(draw_block(seed, 1, i, 0)[0] % 9) * 0.5F;
    }
    return word;
}

/// The result of rewriting a word once, or its error, as comparable values.
struct Rewritten {
    std::optional<Stop> stop;
    std::uint64_t error_position = 0; // if `stop` is Diagnosed
    std::vector<Code> codes;
    std::vector<float> parameters;
    std::vector<lsys::Origin> origins;

    friend bool operator==(const Rewritten&, const Rewritten&) = default;
};

Rewritten rewritten(const Bytecode& bytecode,
                    lsys::Word word,
                    std::uint64_t seed,
                    std::uint32_t threads,
                    std::uint32_t chunk,
                    bool origins) {
    DeriveOptions options;
    options.origins = origins;
    options.generations = 1;
    options.seed = seed;
    options.threads = threads;
    options.chunk_modules = chunk;
    lsys::Derivation derivation(bytecode, options);
    Rewritten result;
    result.stop = derivation.resume(std::move(word), 0);
    if (!result.stop) {
        result.stop = derivation.step();
    }
    if (result.stop == Stop::Diagnosed) {
        result.error_position = derivation.error().position;
    }
    const lsys::Word& last = derivation.word();
    for (std::uint64_t i = 0; i < last.module_count(); ++i) {
        result.codes.push_back(last.code(i));
    }
    result.parameters.assign(last.parameters().begin(), last.parameters().end());
    result.origins.assign(last.origins().begin(), last.origins().end());
    return result;
}

} // namespace

// Chunks of one module are rewritten code by code, long chunks by vectors of codes.
TEST_CASE("long random words are rewritten to the same word in chunks of any size") {
    std::size_t rewrote = 0;
    for (std::uint64_t seed = 3001; seed <= 3300; ++seed) {
        const Case test_case = generate(seed);
        std::string messages;
        const std::optional<Bytecode> bytecode = compile_case(test_case, messages);
        INFO("seed " << seed << "\n" << messages);
        REQUIRE(bytecode);
        const Code usual = static_cast<Code>(seed * 7 % bytecode->code_count());
        const auto word = [&] { return random_word(*bytecode, seed, 4500 + seed % 77, usual); };
        const Rewritten expected = rewritten(*bytecode, word(), seed, 1, 1, true);
        CHECK(expected.origins.size() == expected.codes.size());
        Rewritten without = expected;
        without.origins.clear();
        const bool is_rewritten = !expected.stop && expected.codes.size() != 4500 + seed % 77;
        rewrote += is_rewritten ? 1 : 0;
        for (const std::uint32_t chunk : {65536U, 1000U, 64U, 65U}) {
            for (const std::uint32_t threads : {1U, 2U}) {
                INFO("chunks of " << chunk << ", " << threads << " threads");
                const bool same =
                    rewritten(*bytecode, word(), seed, threads, chunk, true) == expected;
                CHECK(same);
                const bool same_without =
                    rewritten(*bytecode, word(), seed, threads, chunk, false) == without;
                CHECK(same_without);
            }
        }
    }
    CHECK(rewrote > 100);
}

TEST_CASE("random grammars derive the same word in pieces of any size") {
    for (std::uint64_t seed = 2001; seed <= 2300; ++seed) {
        const Case test_case = generate(seed);
        const Derivation derivation = derive(test_case.grammar, test_case.request);
        std::string messages;
        const std::optional<Bytecode> bytecode = compile_case(test_case, messages);
        INFO("seed " << seed << "\n" << messages);
        REQUIRE(bytecode);
        if (!derivation.error) {
            const std::string word =
                print_word(derivation.words.back(), test_case.grammar.files[0].letters);
            CHECK(test::derived_every_way(*bytecode, derivation.generations, derivation.seed) ==
                  word);
        } else if (derivation.error->failure != Failure::UnmatchedBracket &&
                   derivation.error->failure != Failure::UnmatchedPolygon) {
            const RuntimeError error =
                test::error_every_way(*bytecode, derivation.generations, derivation.seed);
            CHECK(error.position == derivation.error->position);
            CHECK(error.generation == derivation.error->generation);
            CHECK(error.parameters == derivation.error->module.values);
            CHECK(bytecode->productions[static_cast<std::size_t>(error.production)].name ==
                  derivation.error->production);
        }
    }
}

} // namespace lsys::reference
