// SPDX-License-Identifier: MIT
// Origins of modules and of the parts drawn for them. tests/reference checks origins for every
// feature.
#include "runtime/derive/derive.h"
#include "runtime/derive/origin.h"
#include "runtime/derive/stream.h"
#include "runtime/derive/word_text.h"
#include "runtime/turtle/turtle.h"
#include "tests/support/bytecode_builder.h"
#include "tests/support/derived.h"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using test::BytecodeBuilder;

namespace {

using Lines = std::vector<std::string>;

DeriveOptions with_origins(std::uint32_t generations) {
    DeriveOptions options;
    options.generations = generations;
    options.origins = true;
    return options;
}

/// A line "F(1) from p, generation 2" for each module of a word.
Lines traced(const Bytecode& bytecode, const Word& word) {
    REQUIRE(word.origins().size() == word.module_count());
    WordPrinter modules(bytecode);
    OriginPrinter origins(bytecode);
    Lines lines;
    std::size_t parameter = 0;
    for (std::uint64_t i = 0; i < word.module_count(); ++i) {
        const Code code = word.code(i);
        const std::uint32_t stored = bytecode.stored_parameters(code);
        std::string& line = lines.emplace_back();
        modules.begin();
        modules.append({&code, 1}, word.parameters().subspan(parameter, stored), line);
        parameter += stored;
        line += ' ';
        origins.append(word.origins()[i], line);
    }
    return lines;
}

Lines traced(const Bytecode& bytecode, std::uint32_t generations) {
    static_cast<void>(test::derived_every_way(bytecode, generations, 0));
    Derivation derivation(bytecode, with_origins(generations));
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(generations) == std::nullopt);
    return traced(bytecode, derivation.word());
}

void draw_with(Bytecode& bytecode, const std::string& name, TurtleOperation operation) {
    for (BytecodeSymbol& symbol : bytecode.symbols) {
        symbol.turtle = symbol.name == name ? operation : symbol.turtle;
    }
}

/// A plant with segments, objects, polygons, cuts and #interpret.
Bytecode plant() {
    Bytecode bytecode = BytecodeBuilder()
                            .axiom("F L A")
                            .production("p : A : * : F [ + F(2) L ] { . f . + f . } F % F A")
                            .production("q : L : * : L F")
                            .build();
    using enum TurtleOperation;
    const std::pair<const char*, TurtleOperation> known[] = {
        {"F", Forward},      {"f", Move},       {"+", YawRight},      {"[", Save}, {"]", Restore},
        {"{", PolygonBegin}, {"}", PolygonEnd}, {".", PolygonVertex}, {"L", Leaf}, {"%", Cut},
    };
    for (const auto& [name, operation] : known) {
        draw_with(bytecode, name, operation);
    }
    return bytecode;
}

} // namespace

TEST_CASE("modules of the axiom are of generation 0") {
    const Bytecode bytecode = BytecodeBuilder().axiom("F(1)[+A]").build();
    CHECK(traced(bytecode, 0) ==
          Lines{"F(1) from the axiom, generation 0", "[ from the axiom, generation 0",
                "+ from the axiom, generation 0", "A from the axiom, generation 0",
                "] from the axiom, generation 0"});
    CHECK(traced(bytecode, 3) == traced(bytecode, 0));
}

TEST_CASE("copied modules keep their origin, and rewritten modules get a new one") {
    const Bytecode bytecode = BytecodeBuilder()
                                  .axiom("A B(1)")
                                  .production("p : A : * : F A")
                                  .production("q : B(x) : * : B(x)")
                                  .build();
    CHECK(traced(bytecode, 2) == Lines{"F from p, generation 1", "F from p, generation 2",
                                       "A from p, generation 2", "B(1) from q, generation 2"});
}

TEST_CASE("empty successors leave no origins") {
    const Bytecode bytecode = BytecodeBuilder()
                                  .axiom("F A B A")
                                  .production("p : B : * : F(3)")
                                  .production("e : A : * : ")
                                  .build();
    CHECK(traced(bytecode, 1) ==
          Lines{"F from the axiom, generation 0", "F(3) from p, generation 1"});
}

TEST_CASE("a module of random parameters comes from the production that drew them") {
    const Bytecode bytecode = BytecodeBuilder()
                                  .axiom("A(1)")
                                  .production("p : A(x) : x > 0 ~ 0.5 : F({0, 1}) A(x)")
                                  .production("q : A(x) : * ~ 0.5 : A({1, 2}) F")
                                  .build();
    const std::uint32_t generations = 30;
    std::size_t from[2]{};
    for (const std::string& line : traced(bytecode, generations)) {
        ++from[line.find(" from p,") != std::string::npos ? 0 : 1];
    }
    CHECK(from[0] > 5);
    CHECK(from[1] > 5);
}

TEST_CASE("several modules rewritten together give one origin for each module of the successor") {
    BytecodeBuilder builder;
    builder.settings.rewriting = RewritingMode::Sequential;
    builder.axiom("A B A B C").production("p : A B : * : D E F").production("q : E : * : A");
    CHECK(traced(builder.build(), 1) == Lines{"D from p, generation 1", "A from q, generation 1",
                                              "F from p, generation 1", "D from p, generation 1",
                                              "A from q, generation 1", "F from p, generation 1",
                                              "C from the axiom, generation 0"});
}

TEST_CASE("the origins of a word given at the start are kept or unknown") {
    const Bytecode bytecode = BytecodeBuilder().axiom("A").production("p : A : * : F A").build();
    Derivation first(bytecode, with_origins(4));
    REQUIRE(first.start() == std::nullopt);
    REQUIRE(first.run_to(2) == std::nullopt);
    const auto last = [&](Word word, bool asks) {
        DeriveOptions options = with_origins(4);
        options.origins = asks;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.resume(std::move(word), 2) == std::nullopt);
        REQUIRE(derivation.run_to(4) == std::nullopt);
        return derivation.take_word();
    };
    const Word fully_known = last(first.take_word(), true);
    CHECK(traced(bytecode, fully_known) == Lines{"F from p, generation 1", "F from p, generation 2",
                                                 "F from p, generation 3", "F from p, generation 4",
                                                 "A from p, generation 4"});

    DeriveOptions plain;
    plain.generations = 4;
    Derivation second(bytecode, plain);
    REQUIRE(second.start() == std::nullopt);
    REQUIRE(second.run_to(2) == std::nullopt);
    CHECK(second.word().origins().empty());
    const Word partly_known = last(second.take_word(), true);
    CHECK(traced(bytecode, partly_known) ==
          Lines{"F origin unknown, in the saved state of generation 2",
                "F origin unknown, in the saved state of generation 2", "F from p, generation 3",
                "F from p, generation 4", "A from p, generation 4"});

    REQUIRE(first.start() == std::nullopt);
    REQUIRE(first.run_to(2) == std::nullopt);
    CHECK(last(first.take_word(), false).origins().empty());
}

TEST_CASE("origins count towards the limit on memory") {
    const Bytecode bytecode =
        BytecodeBuilder().axiom("F").production("p : F : * : F+F-F-F+F").build();
    DeriveOptions options = with_origins(8);
    // 781,249 modules take one byte each, or nine bytes with origins.
    options.limits.max_bytes = 4'000'000;
    options.threads = 1;
    for (const bool asks : {false, true}) {
        options.origins = asks;
        Derivation derivation(bytecode, options);
        REQUIRE(derivation.start() == std::nullopt);
        CHECK(derivation.run_to(8) == (asks ? std::optional(Stop::Limit) : std::nullopt));
        CHECK(derivation.age() == (asks ? 7U : 8U));
        CHECK(derivation.word().origins().size() == (asks ? derivation.word().module_count() : 0));
    }
}

TEST_CASE("drawn parts have the origin of their module") {
    const Bytecode bytecode = plant();
    Derivation derivation(bytecode, with_origins(2));
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(2) == std::nullopt);
    Turtle turtle(bytecode, {});
    const bool reserves = GENERATE(false, true);
    if (reserves) {
        REQUIRE(turtle.reserve(derivation.word()) == std::nullopt);
    }
    REQUIRE(turtle.feed(derivation.word()) == std::nullopt);
    REQUIRE(turtle.finish() == std::nullopt);
    const Skeleton stored = turtle.take_skeleton();
    REQUIRE(stored.segment_origins.size() == stored.segments.size());
    REQUIRE(stored.object_origins.size() == stored.objects.size());
    REQUIRE(stored.polygon_origins.size() == stored.polygons.size());

    OriginPrinter printer(bytecode);
    const auto texts = [&](const LargeVector<Origin>& origins) {
        Lines lines;
        for (const Origin& origin : origins) {
            printer.append(origin, lines.emplace_back());
        }
        return lines;
    };
    // The % cuts off the `F A` after it, so L writes the only drawn modules of generation 2.
    CHECK(texts(stored.segment_origins) == Lines{"from the axiom, generation 0",
                                                 "from q, generation 2", "from q, generation 1",
                                                 "from p, generation 1", "from p, generation 1",
                                                 "from q, generation 2", "from p, generation 1"});
    CHECK(texts(stored.object_origins) == Lines{"from q, generation 2", "from q, generation 2"});
    CHECK(texts(stored.polygon_origins) == Lines{"from p, generation 1"});
    const std::uint32_t opens = stored.polygon_origins[0].place;
    CHECK(bytecode.symbol(bytecode.symbol_of(bytecode.template_codes[opens])).name == "{");
    CHECK(bytecode.template_codes[stored.segment_origins[4].place] !=
          bytecode.template_codes[stored.segment_origins[3].place]); // one is F(2), the other F

    Turtle pieces(bytecode, {});
    const StreamOutcome outcome =
        derive_streamed(bytecode, with_origins(2), [&](const StreamChunk& chunk) {
            return !pieces.feed(chunk.codes, chunk.parameters, chunk.origins);
        });
    REQUIRE(outcome.end.stop == std::nullopt);
    const Skeleton streamed = pieces.take_skeleton();
    CHECK(streamed.segment_origins == stored.segment_origins);
    CHECK(streamed.object_origins == stored.object_origins);
    CHECK(streamed.polygon_origins == stored.polygon_origins);
}

TEST_CASE("a skeleton without origins needs no memory for them") {
    const Bytecode bytecode = plant();
    DeriveOptions options;
    Derivation derivation(bytecode, options);
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(2) == std::nullopt);
    Turtle turtle(bytecode, {});
    REQUIRE(turtle.feed(derivation.word()) == std::nullopt);
    CHECK_FALSE(turtle.skeleton().segments.empty());
    CHECK(turtle.skeleton().segment_origins.empty());
    CHECK(turtle.skeleton().object_origins.empty());
    CHECK(turtle.skeleton().polygon_origins.empty());
}

TEST_CASE("origins of a skeleton count towards its limit") {
    const Bytecode bytecode =
        BytecodeBuilder().axiom("F").production("p : F : * : F F F F").build();
    Bytecode drawn = bytecode;
    draw_with(drawn, "F", TurtleOperation::Forward);
    Derivation derivation(drawn, with_origins(7));
    REQUIRE(derivation.start() == std::nullopt);
    REQUIRE(derivation.run_to(7) == std::nullopt);
    TurtleOptions options;
    options.max_bytes = 16'384 * (sizeof(Segment) + sizeof(Origin));
    Turtle enough(drawn, options);
    CHECK(enough.reserve(derivation.word()) == std::nullopt);
    CHECK(enough.feed(derivation.word()) == std::nullopt);
    --options.max_bytes;
    Turtle short_of_one(drawn, options);
    CHECK(short_of_one.reserve(derivation.word()) == Stop::Limit);
}
