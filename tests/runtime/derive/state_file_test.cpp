// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/state_file.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <string>
#include <utility>

using namespace lsys;
using test::BytecodeBuilder;

namespace {

BytecodeBuilder plant_builder() {
    BytecodeBuilder builder;
    builder.global("c", "{1, 2}").axiom("A(0)");
    builder.production("p : A(x) : x < 4 ~ 0.5 : F(x*c)[+(30)A(x+1)]A(x)");
    builder.production("q : A(x) : * ~ 0.5 : F({0,1})A(x+step())");
    builder.production("r : F(x) : * : F(x*1.1)f");
    return builder;
}

DeriveOptions options_for(std::uint32_t generations) {
    DeriveOptions options;
    options.generations = generations;
    options.seed = 1234;
    return options;
}

std::string saved_after(const Bytecode& bytecode, std::uint32_t age, std::uint32_t generations) {
    Derivation derivation(bytecode, options_for(generations));
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(age) == std::nullopt);
    std::string bytes;
    REQUIRE(write_state({digest(bytecode), 1234, generations, age}, derivation.word(), {},
                        [&bytes](std::string_view piece) {
                            bytes += piece;
                            return true;
                        }));
    return bytes;
}

} // namespace

TEST_CASE("five generations and five more equal ten") {
    BytecodeBuilder builder = plant_builder();
    builder.unused_symbols(GENERATE(0u, 300u, 66'000u));
    const Bytecode bytecode = builder.build();
    const std::string bytes = saved_after(bytecode, 5, 10);
    CHECK(is_state_file(bytes));
    Result<SavedState> state = read_state(bytes, bytecode);
    REQUIRE(state.ok());
    CHECK(state.value().header.age == 5);
    CHECK(state.value().header.seed == 1234);
    CHECK(state.value().header.generations == 10);
    Derivation derivation(bytecode, options_for(10));
    REQUIRE(derivation.resume(std::move(state.value().word), 5) == std::nullopt);
    REQUIRE(derivation.run_to(10) == std::nullopt);
    CHECK(test::text_of(bytecode, derivation.word()) == test::derived(bytecode, 10, 1234));
}

TEST_CASE("an empty word can be saved") {
    BytecodeBuilder builder;
    builder.axiom("A").production("p : A : * : ");
    const Bytecode bytecode = builder.build();
    const std::string bytes = saved_after(bytecode, 1, 1);
    const Result<SavedState> state = read_state(bytes, bytecode);
    REQUIRE(state.ok());
    CHECK(state.value().word.module_count() == 0);
}

TEST_CASE("every mistake in a saved state is reported") {
    const Bytecode bytecode = plant_builder().build();
    const std::string bytes = saved_after(bytecode, 4, 10);
    const auto message = [&bytecode](const std::string& damaged) {
        const Result<SavedState> state = read_state(damaged, bytecode);
        REQUIRE_FALSE(state.ok());
        return state.error().message;
    };
    CHECK(message("") == "not a saved state of lsc");
    CHECK(message("#n = 5; a grammar") == "not a saved state of lsc");
    CHECK(message(bytes.substr(0, 30)).find("header is incomplete") != std::string::npos);
    CHECK(message(bytes.substr(0, bytes.size() - 9)).find("shorter") != std::string::npos);
    CHECK(message(bytes + "x").find("longer") != std::string::npos);
    const auto with_byte = [&bytes](std::size_t at, std::uint32_t value) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(value);
        return changed;
    };
    CHECK(message(with_byte(8, 1)) == "the saved state was made by an older lsc (its format is "
                                      "version 1, this one reads 3): derive it again");
    CHECK(message(with_byte(8, kStateFileVersion + 1)) ==
          "the saved state was made by a newer lsc (its format is version 4, this one reads 3)");
    CHECK(message(with_byte(12, 4)) == "the saved state was made by an older lsc (its bytecode is "
                                       "version 4, this one reads 15): derive it again");
    CHECK(
        message(with_byte(12, kModuleFileVersion + 1)) ==
        "the saved state was made by a newer lsc (its bytecode is version 16, this one reads 15)");

    BytecodeBuilder other = plant_builder();
    other.production("s : f : * : f f");
    const Result<SavedState> foreign = read_state(bytes, other.build());
    REQUIRE_FALSE(foreign.ok());
    CHECK(foreign.error().message.find("another program") != std::string::npos);
}

TEST_CASE("no changed byte and no shortened file is accepted") {
    const Bytecode bytecode = plant_builder().build();
    const std::string bytes = saved_after(bytecode, 3, 10);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x41);
        CHECK_FALSE(read_state(damaged, bytecode).ok());
        CHECK_FALSE(read_state(bytes.substr(0, i), bytecode).ok());
    }
}

TEST_CASE("sizes that would overflow are refused") {
    const Bytecode bytecode = plant_builder().build();
    std::string bytes = saved_after(bytecode, 3, 10);
    for (const std::size_t at : {std::size_t{40}, std::size_t{48}}) {
        for (const std::uint64_t size :
             {~std::uint64_t{0}, std::uint64_t{1} << 62, std::uint64_t{1} << 63}) {
            std::string damaged = bytes;
            std::memcpy(damaged.data() + at, &size, sizeof size);
            CHECK_FALSE(read_state(damaged, bytecode).ok());
        }
    }
}

TEST_CASE("writing ends if the sink fails") {
    const Bytecode bytecode = plant_builder().build();
    const Word word(1);
    int calls = 0;
    CHECK_FALSE(write_state({}, word, {}, [&calls](std::string_view) {
        ++calls;
        return false;
    }));
    CHECK(calls == 1);
}
