// SPDX-License-Identifier: MIT
// Words and their text.
#include "runtime/base/random.h"
#include "runtime/derive/word.h"
#include "runtime/derive/word_text.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using test::BytecodeBuilder;
using test::derived;

TEST_CASE("a word has its sizes") {
    Word word(2);
    REQUIRE(word.resize(10, 3));
    word.codes<std::uint16_t>()[9] = 513;
    CHECK(word.code(9) == 513);
    CHECK(word.byte_count() == 32);
    CHECK(word.held_bytes() == 20 + 12 + 2 * kWordSlack);
    CHECK(word.held_bytes_after(20, 1) == 40 + 12 + 2 * kWordSlack);
    CHECK_FALSE(word.resize(std::numeric_limits<std::uint64_t>::max(), 0));
    CHECK(word.module_count() == 0);
    CHECK(word.held_bytes_after(std::numeric_limits<std::uint64_t>::max(), 5) ==
          std::numeric_limits<std::uint64_t>::max());
}

TEST_CASE("codes of a word can be read at their width") {
    for (const std::uint32_t width : {1U, 2U, 4U}) {
        Word word(width);
        REQUIRE(word.resize(3, 0));
        word.visit([](auto codes) { std::fill(codes.begin(), codes.end(), 200); });
        const std::size_t bytes = std::as_const(word).visit([](auto codes) {
            CHECK(codes.size() == 3);
            CHECK(codes[2] == 200);
            return codes.size_bytes();
        });
        CHECK(bytes == 3 * width);
        CHECK(word.code_bytes().size() == bytes);
        CHECK(word.code(1) == 200);
    }
}

TEST_CASE("a word as text") {
    BytecodeBuilder builder;
    SECTION("a space between two identifiers only") {
        builder.axiom("F F(1)F[F]F F_1 + F G(2,3)G");
        CHECK(derived(builder.build(), 0, 0) == "F F(1)F[F]F F_1+F G(2,3)G");
    }
    SECTION("a folded module has the same text") {
        builder.fold = GENERATE(true, false);
        builder.axiom("F(1,2.5)+(-0.1)&(22.5)F(1e-3)F(1e20)F(16777216)");
        CHECK(derived(builder.build(), 0, 0) ==
              "F(1,2.5)+(-0.1)&(22.5)F(0.001)F(1e+20)F(16777216)");
    }
    SECTION("negative zero") {
        builder.axiom("F(-0.0)F(0)");
        CHECK(derived(builder.build(), 0, 0) == "F(-0)F(0)");
    }
    SECTION("symbols of other dialects") {
        builder.axiom(";(0.9)F;F");
        CHECK(derived(builder.build(), 0, 0) == "`;`(0.9)F`;`F");
    }
    SECTION("letters") {
        builder.settings.print_letters = true;
        builder.axiom("F F AB F");
        CHECK(derived(builder.build(), 0, 0) == "FF`AB`F");
    }
    SECTION("names longer than any buffer") {
        const std::string name(100'000, 'x');
        builder.axiom(name + " " + name + "(1)" + name);
        CHECK(derived(builder.build(), 0, 0) == name + " " + name + "(1)" + name);
    }
}

TEST_CASE("a word may be printed in pieces") {
    BytecodeBuilder builder;
    builder.axiom("A A(1)B(2,x0)C");
    builder.global("x0", "{4, 4}");
    const Bytecode bytecode = builder.build();
    WordPrinter printer(bytecode);
    std::string text;
    // The codes are A, folded A(1), B with a stored parameter, C.
    const std::vector<Code> codes(bytecode.template_codes);
    REQUIRE(codes.size() == 4);
    const std::vector<float> parameters{2.0F, 4.0F};
    printer.append({codes.data(), 1}, {}, text);
    printer.append({codes.data() + 1, 1}, {}, text);
    printer.append({codes.data() + 2, 1}, parameters, text);
    printer.append({codes.data() + 3, 1}, {}, text);
    printer.append({codes.data(), 1}, {}, text);
    CHECK(text == "A A(1)B(2,4)C A");
}

TEST_CASE("the text of a long word is the texts of its modules in order") {
    BytecodeBuilder builder;
    builder.settings.print_letters = GENERATE(true, false);
    builder.axiom("F G + [ ] F(1.5) H(1) a_name_that_is_rather_long K L");
    builder.production("p : H(x) : * : H(x)");
    const Bytecode bytecode = builder.build();
    std::vector<Code> codes;
    std::vector<float> parameters;
    for (std::uint64_t i = 0; i < 9001; ++i) {
        codes.push_back(draw_block(1, 0, i, 0)[0] % bytecode.code_count());
        for (std::uint32_t j = 0; j < bytecode.stored_parameters(codes.back()); ++j) {
            parameters.push_back(static_cast<float>(i) * 0.5F);
        }
    }
    std::string whole;
    WordPrinter(bytecode).append(codes, parameters, whole);
    std::string pieces;
    WordPrinter printer(bytecode);
    const float* next = parameters.data();
    for (const Code& code : codes) {
        const std::uint32_t stored = bytecode.stored_parameters(code);
        printer.append({&code, 1}, {next, stored}, pieces);
        next += stored;
    }
    CHECK(whole == pieces);
}

TEST_CASE("a long word of letters has one character per module") {
    BytecodeBuilder builder;
    builder.settings.print_letters = true;
    builder.axiom("A").production("p : A : * : A + B [ A ]").production("q : B : * : - A");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 16;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(options.generations) == std::nullopt);
    const Word& word = derivation.word();
    REQUIRE(word.module_count() > 200'000);
    std::string whole;
    CHECK(WordPrinter(bytecode).print(word, [&whole](std::string_view piece) {
        whole += piece;
        return true;
    }));
    std::string expected;
    for (const std::uint8_t code : word.codes<std::uint8_t>()) {
        expected += bytecode.symbol(bytecode.symbol_of(code)).name;
    }
    CHECK(whole == expected);
}

TEST_CASE("printing stops when the sink returns false") {
    BytecodeBuilder builder;
    builder.settings.print_letters = GENERATE(true, false);
    builder.axiom("A").production("p : A : * : A A");
    const Bytecode bytecode = builder.build();
    DeriveOptions options;
    options.generations = 18; // 262,144 modules
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(18) == std::nullopt);
    int pieces = 0;
    WordPrinter printer(bytecode);
    CHECK_FALSE(printer.print(derivation.word(), [&pieces](std::string_view) {
        ++pieces;
        return pieces < 2;
    }));
    CHECK(pieces == 2);
}
