// SPDX-License-Identifier: MIT
// How a derivation asks its environments, with an environment that counts.
#include "runtime/derive/derive.h"
#include "runtime/derive/state_file.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/trace.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace lsys {
namespace {

using test::BytecodeBuilder;

/// Answers each sense module with the number of sense modules answered so far; state() saves it.
class CountingSense : public WordSense {
public:
    explicit CountingSense(const Bytecode& bytecode) : bytecode_(bytecode) {}

    std::optional<Stop> begin(std::uint64_t seed,
                              std::uint32_t generations,
                              std::span<const float> /*globals*/,
                              DerivationEnd& /*end*/) override {
        ++begun;
        count_ = static_cast<int>(seed) * 1000;
        last_generations = generations;
        return std::nullopt;
    }
    std::optional<Stop> sense(Word& word, std::uint32_t age, DerivationEnd& end) override {
        ages.push_back(age);
        if (age == fails_at) {
            end.error.kind = RuntimeErrorKind::SenseFailed;
            end.error.text = "no answer";
            return Stop::Diagnosed;
        }
        std::uint64_t parameter = 0;
        for (std::uint64_t i = 0; i < word.module_count(); ++i) {
            const Code code = word.code(i);
            if (bytecode_.symbol(bytecode_.symbol_of(code)).senses()) {
                word.parameters()[parameter] = static_cast<float>(++count_);
            }
            parameter += bytecode_.stored_parameters(code);
        }
        return std::nullopt;
    }
    [[nodiscard]] std::string state() const override { return std::to_string(count_); }
    [[nodiscard]] bool restore(std::string_view state) override {
        const auto [end, error] =
            std::from_chars(state.data(), state.data() + state.size(), count_);
        return error == std::errc() && end == state.data() + state.size();
    }

    std::vector<std::uint32_t> ages; // of the words that were sensed
    int begun = 0;                   // number of calls of begin()
    std::uint32_t last_generations = 0;
    std::uint32_t fails_at = ~std::uint32_t{0}; // age

private:
    const Bytecode& bytecode_;
    int count_ = 0; // number of sense modules answered, from 1000 times the seed on
};

Bytecode sensing_plant() {
    BytecodeBuilder builder;
    builder.sense("P").axiom("B");
    builder.production("p : B : * : P(0) A(0) [ B ] C");
    builder.production("q : A(x) : step() == 3 : A(x) P(9)");
    builder.production("r : P(x) > A(y) : x > 3 : P(x) D");
    builder.production(Stage::Up, "u : P(x) < A(y) : * : A(x+y)");
    return builder.build();
}

DeriveOptions options_for(WordSense& senses, std::uint32_t generations) {
    DeriveOptions options;
    options.generations = generations;
    options.senses = &senses;
    return options;
}

std::string word_after(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t seed) {
    CountingSense senses(bytecode);
    DeriveOptions options = options_for(senses, generations);
    options.seed = seed;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    REQUIRE(!derivation.run_to(generations));
    return test::text_of(bytecode, derivation.word());
}

} // namespace

TEST_CASE("each complete word with a sense module is sensed once, before it is swept") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    Derivation derivation(bytecode, options_for(senses, 2));
    REQUIRE(!derivation.start());
    CHECK(senses.begun == 1);
    CHECK(senses.last_generations == 2);
    CHECK(senses.ages.empty()); // the axiom holds no sense module
    REQUIRE(!derivation.step());
    CHECK(test::text_of(bytecode, derivation.word()) == "P(1)A(1)[B]C");
    REQUIRE(!derivation.step());
    CHECK(senses.ages == std::vector<std::uint32_t>{1, 2});
    CHECK(test::text_of(bytecode, derivation.word()) == "P(2)A(3)[P(3)A(3)[B]C]C");
    CHECK(word_after(bytecode, 2, 5) == "P(5002)D A(5001)[P(5003)A(5003)[B]C]C");
}

TEST_CASE("an axiom with a sense module is sensed") {
    BytecodeBuilder builder;
    builder.sense("P").axiom("P(4)P");
    const Bytecode bytecode = builder.build();
    CountingSense senses(bytecode);
    Derivation derivation(bytecode, options_for(senses, 1));
    SECTION("and its answers are part of generation 0") {
        REQUIRE(!derivation.start());
        CHECK(test::text_of(bytecode, derivation.word()).substr(0, 4) == "P(1)");
        CHECK(senses.ages == std::vector<std::uint32_t>{0});
        REQUIRE(!derivation.step());
        CHECK(test::text_of(bytecode, derivation.word()).substr(0, 4) == "P(3)");
    }
    SECTION("or the start fails") {
        senses.fails_at = 0;
        CHECK(derivation.start() == Stop::Diagnosed);
        CHECK(derivation.error().kind == RuntimeErrorKind::SenseFailed);
    }
}

TEST_CASE("a word that cannot be sensed leaves the last word as it was") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    senses.fails_at = 3;
    Derivation derivation(bytecode, options_for(senses, 5));
    REQUIRE(!derivation.start());
    REQUIRE(!derivation.run_to(2));
    const std::string before = test::text_of(bytecode, derivation.word());
    CHECK(derivation.run_to(5) == Stop::Diagnosed);
    CHECK(derivation.error().text == "no answer");
    CHECK(derivation.age() == 2);
    CHECK(test::text_of(bytecode, derivation.word()) == before);
}

TEST_CASE("a sensing derivation can be saved at any generation and gives the same words") {
    const Bytecode bytecode = sensing_plant();
    constexpr std::uint32_t kGenerations = 6;
    const std::string expected = word_after(bytecode, kGenerations, 0);
    for (std::uint32_t age = 0; age <= kGenerations; ++age) {
        CountingSense first(bytecode);
        Derivation begun(bytecode, options_for(first, kGenerations));
        REQUIRE(!begun.start());
        REQUIRE(!begun.run_to(age));
        std::string bytes;
        REQUIRE(write_state({digest(bytecode), 0, kGenerations, age}, begun.word(),
                            begun.sense_state(), [&bytes](std::string_view piece) {
                                bytes += piece;
                                return true;
                            }));
        Result<SavedState> state = read_state(bytes, bytecode);
        REQUIRE(state.ok());
        CountingSense second(bytecode);
        Derivation continued(bytecode, options_for(second, kGenerations));
        REQUIRE(!continued.resume(std::move(state.value().word), age, state.value().sense_state));
        CHECK(second.begun == 1);
        CHECK(second.ages.empty()); // the saved word is sensed already
        REQUIRE(!continued.run_to(kGenerations));
        CHECK(test::text_of(bytecode, continued.word()) == expected);
        // No changed byte and no shortened file is accepted.
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            std::string damaged = bytes;
            damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
            CHECK_FALSE(read_state(damaged, bytecode).ok());
            CHECK_FALSE(read_state(bytes.substr(0, i), bytecode).ok());
        }
    }
}

TEST_CASE("a saved state with environments of another program is refused") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    Derivation derivation(bytecode, options_for(senses, 5));
    Word word(code_width(bytecode.code_count()));
    REQUIRE(word.resize(0, 0));
    CHECK(derivation.resume(std::move(word), 1, "x") == Stop::Diagnosed);
    CHECK(derivation.error().kind == RuntimeErrorKind::SenseFailed);
    CHECK(derivation.error().environment == kNone);

    // A program without sense modules has no environments to restore.
    BytecodeBuilder builder;
    const Bytecode plain = builder.axiom("A").build();
    std::string bytes;
    Word axiom(code_width(plain.code_count()));
    REQUIRE(axiom.resize(0, 0));
    REQUIRE(write_state({digest(plain), 0, 1, 0}, axiom, "x", [&bytes](std::string_view piece) {
        bytes += piece;
        return true;
    }));
    CHECK_FALSE(read_state(bytes, plain).ok());
}

TEST_CASE("passes report the word before and after sensing, with the origins of its modules") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    DeriveOptions options = options_for(senses, 3);
    options.origins = true;
    std::vector<DerivationPass::Kind> kinds;
    std::string asked;
    std::string answered;
    options.on_pass = [&](const DerivationPass& pass) {
        if (pass.out == nullptr) {
            kinds.push_back(pass.kind);
        } else if (pass.kind == DerivationPass::Kind::Sense) {
            asked = test::text_of(bytecode, *pass.in);
            answered = test::text_of(bytecode, *pass.out);
            for (std::uint32_t i = 0; i < pass.out->module_count(); ++i) {
                CHECK(pass.out->origins()[i].place == i);
            }
        }
    };
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    REQUIRE(!derivation.step());
    using Kind = DerivationPass::Kind;
    CHECK(kinds == std::vector<Kind>{Kind::Rewrite, Kind::Sense, Kind::Up});
    CHECK(asked == "P(0)A(0)[B]C");
    CHECK(answered == "P(1)A(0)[B]C");
}

TEST_CASE("modules keep their origins when they are sensed and swept") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    DeriveOptions options = options_for(senses, 2);
    options.origins = true;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    REQUIRE(!derivation.run_to(2));
    // P(0) and A(0) of `p`, written in generation 1 and copied in generation 2.
    const std::uint32_t first = bytecode.productions[0].successor.codes.first;
    CHECK(derivation.word().origins()[0] == Origin{first, 1});
    CHECK(derivation.word().origins()[1] == Origin{first + 1, 1});
}

TEST_CASE("a cancelled derivation does not ask") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    std::atomic<bool> cancelled = false;
    DeriveOptions options = options_for(senses, 4);
    options.cancelled = &cancelled;
    Derivation derivation(bytecode, options);
    REQUIRE(!derivation.start());
    REQUIRE(!derivation.step());
    cancelled = true;
    CHECK(derivation.step() == Stop::Cancelled);
    CHECK(senses.ages.size() == 1);
    CHECK(derivation.age() == 1);
}

TEST_CASE("a trace shows what a sense module asked and what was answered") {
    const Bytecode bytecode = sensing_plant();
    CountingSense senses(bytecode);
    DeriveOptions options = options_for(senses, 2);
    Derivation begun(bytecode, options);
    REQUIRE(!begun.start());
    REQUIRE(!begun.step());
    const std::string state = begun.sense_state();
    Word word(begun.word().code_width());
    REQUIRE(word.resize(begun.word().module_count(), begun.word().parameter_count()));
    std::copy_n(begun.word().code_bytes().data(), word.code_bytes().size(),
                word.code_bytes().data());
    std::copy_n(begun.word().parameters().data(), word.parameters().size(),
                word.parameters().data());

    StepTracer tracer(bytecode, {0, 2.0F, {}, {}});
    tracer.begin({0, 1}, begun.word(), 1, DerivationPass::Kind::Rewrite);
    options.origins = true;
    options.on_pass = [&](const DerivationPass& pass) { tracer.on_pass(pass); };
    Derivation stepping(bytecode, options);
    REQUIRE(!stepping.resume(std::move(word), 1, state));
    REQUIRE(!stepping.step());
    tracer.finish();
    CHECK(tracer.agrees());
    const auto sensed =
        std::find_if(tracer.traces().begin(), tracer.traces().end(), [](const ModuleTrace& trace) {
            return trace.kind == DerivationPass::Kind::Sense;
        });
    REQUIRE(sensed != tracer.traces().end());
    CHECK(sensed->fate == Fate::Sensed);
    CHECK(module_text(bytecode, sensed->module) == "P(1)");
    CHECK(module_text(bytecode, sensed->written.front()) == "P(2)");
    const auto swept =
        std::find_if(tracer.traces().begin(), tracer.traces().end(), [](const ModuleTrace& trace) {
            return trace.kind == DerivationPass::Kind::Up;
        });
    REQUIRE(swept != tracer.traces().end());
    CHECK(module_text(bytecode, swept->module) == "A(1)");
    CHECK(module_text(bytecode, swept->written.front()) == "A(3)");
    REQUIRE(swept->attempts.front().left.visited.size() == 1);
    CHECK(module_text(bytecode, swept->attempts.front().left.visited[0].module) == "P(2)");
}

TEST_CASE("a system that senses is not streamed, for a reason") {
    CHECK(streaming_obstacle(sensing_plant()) == "`P` senses, which needs the whole word");
}

} // namespace lsys
