// SPDX-License-Identifier: MIT
// Checks the oracle against independent results: published random numbers, words derived by hand in
// the literature, and counts of other programs.

#include "tests/reference/build.h"
#include "tests/reference/derive.h"
#include "tests/reference/evaluate.h"
#include "tests/reference/generate_expression.h"
#include "tests/reference/philox.h"
#include "tests/reference/print.h"
#include "tests/reference/spelling.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

namespace lsys::reference {

namespace {

using Counts = std::vector<std::size_t>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::nanf("");

float function(const std::string& name, float x) {
    return apply_function(name, {x});
}

ModuleUse module(const std::string& name, std::vector<Expr> arguments) {
    return {name, std::move(arguments)};
}

Production
production(const std::string& label, Pattern predecessor, std::vector<ModuleUse> successor) {
    Production production;
    production.label = label;
    production.predecessor = std::move(predecessor);
    production.successor = std::move(successor);
    return production;
}

Derivation derive_for(const Grammar& grammar, std::uint32_t generations, std::uint64_t seed) {
    Request request;
    request.generations = generations;
    request.seed = seed;
    return derive(grammar, request);
}

std::string spelled(const Expr& expr) {
    std::vector<std::string> tokens;
    spell_expression(expr, nullptr, tokens);
    std::string text;
    for (const std::string& token : tokens) {
        text += token;
    }
    return text;
}

} // namespace

TEST_CASE("Philox4x32-10 gives the published vectors") {
    CHECK(philox4x32_10({0, 0, 0, 0}, {0, 0}) ==
          PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    constexpr std::uint32_t kOnes = 0xffffffff;
    CHECK(philox4x32_10({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}) ==
          PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(
        philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a draw is 24 bits of one word of one block") {
    CHECK(uniform(0, 0, 0, 0) == static_cast<float>(0x6627e8) / 16777216.0F);
    CHECK(uniform(0, 0, 0, 3) == static_cast<float>(0x9b00db) / 16777216.0F);
    // Counter and key have the low words of position and seed first.
    const std::uint64_t position = 0x85a308d3243f6a88;
    const std::uint64_t seed = 0x299f31d0a4093822;
    const std::uint32_t block =
        philox4x32_10({0x243f6a88, 0x85a308d3, 7, 5}, {0xa4093822, 0x299f31d0})[2];
    CHECK(uniform(seed, position, 7, 22) == static_cast<float>(block >> 8U) / 16777216.0F);
}

TEST_CASE("angles that are multiples of 90 degrees are exact") {
    for (const float turn : {0.0F, 360.0F, -360.0F, 3600000.0F}) {
        CHECK(function("sin", turn + 90) == 1);
        CHECK(function("sin", turn + 270) == -1);
        CHECK(function("cos", turn + 180) == -1);
        CHECK(function("cos", turn) == 1);
        CHECK(function("tan", turn + 90) == kInfinity);
        CHECK(function("tan", turn + 270) == -kInfinity);
        for (const char* name : {"sin", "tan"}) {
            CHECK(function(name, turn) == 0);
            CHECK_FALSE(std::signbit(function(name, turn)));
            CHECK(function(name, turn + 180) == 0);
            CHECK_FALSE(std::signbit(function(name, turn + 180)));
        }
        CHECK_FALSE(std::signbit(function("cos", turn + 270)));
    }
    CHECK(function("sin", -90) == -1);
    CHECK(function("tan", -90) == -kInfinity);
    CHECK(function("tan", -270) == kInfinity);
    CHECK(function("sin", 30) == 0.5F);
    CHECK(std::isnan(function("sin", kInfinity)));
    CHECK(function("atan", kInfinity) == 90);
    CHECK(function("asin", -1) == -90);
}

TEST_CASE("rounding, signs and comparisons of special values") {
    CHECK(function("round", 2.5F) == 3);
    CHECK(function("round", -2.5F) == -3);
    CHECK(function("floor", -0.5F) == -1);
    CHECK(std::signbit(function("ceil", -0.5F)));
    CHECK(std::signbit(function("sign", -0.0F)));
    CHECK(apply_function("mod", {-7, 3}) == -1);
    CHECK(std::isnan(apply_function("min", {kNan, 1})));
    CHECK(apply_function("min", {1, kNan}) == 1);
    CHECK(apply_operator("!", {kNan}) == 0);
    CHECK(apply_operator("&&", {kNan, 1}) == 1);
    CHECK(apply_operator("!=", {kNan, kNan}) == 1);
    CHECK(apply_operator("==", {0.0F, -0.0F}) == 1);
    CHECK(std::signbit(apply_operator("-", {0.0F})));
    CHECK(apply_operator("^", {-2, 3}) == -8);
}

TEST_CASE("a range stays below its maximum") {
    CHECK(range_value(1, 3, 0.5F) == 2);
    CHECK(range_value(2, 2, 0.75F) == 2);
    const float last = 1 - 0x1p-24F;
    CHECK(range_value(16777215, 16777216, last) == 16777215);
    CHECK(range_value(1, std::nextafter(1.0F, 2.0F), last) == 1);
    CHECK_THROWS_AS(range_value(2, 1, 0), BadRange);
    CHECK_THROWS_AS(range_value(-3e38F, 3e38F, 0), BadRange);
    CHECK_THROWS_AS(range_value(0, kInfinity, 0), BadRange);
}

TEST_CASE("expressions are spelled with the parentheses that they need") {
    const Expr x = name("x");
    CHECK(spelled(unary("-", binary("^", x, number(2)))) == "-x^2");
    CHECK(spelled(binary("^", unary("-", x), number(2))) == "(-x)^2");
    CHECK(spelled(binary("^", x, unary("-", number(1)))) == "x^-1");
    CHECK(spelled(binary("^", binary("^", x, x), x)) == "(x^x)^x");
    CHECK(spelled(binary("^", x, binary("^", x, x))) == "x^x^x");
    CHECK(spelled(binary("-", x, binary("-", x, x))) == "x-(x-x)");
    CHECK(spelled(binary("<", binary("<", x, x), x)) == "(x<x)<x");
    CHECK(spelled(binary("==", binary("<", x, x), number(1))) == "x<x==1");
    CHECK(spelled(binary("*", binary("||", x, x), number(0.5F))) == "(x||x)*0.5");
    CHECK(spelled(range(number(-1), call("max", {x, number(1e-5F)}))) == "{-1,max(x,1e-05)}");
}

TEST_CASE("a word as text") {
    const Word word = {{"F", {1}},    {"[", {}},      {"+", {30}}, {"A", {2, -0.0F}}, {"]", {}},
                       {"al", {}},    {"br", {}},     {"F", {}},   {"+", {}},         {"F", {}},
                       {";", {0.9F}}, {"F", {1e20F}}, {"F", {}}};
    CHECK(print_word(word, false) == "F(1)[+(30)A(2,-0)]al br F+F`;`(0.9)F(1e+20)F");
    CHECK(print_word({{"F", {}}, {"F", {}}, {"al", {}}}, true) == "FF`al`");
}

TEST_CASE("counts of the benchmark systems") {
    CHECK(counts(letter_system("F", {"F=F+F-F-F+F"}), 6) ==
          Counts{1, 9, 49, 249, 1249, 6249, 31249});
    CHECK(counts(letter_system("X", {"X=F-[[X]+X]+F[+FX]-X", "F=FF"}), 5) ==
          Counts{1, 18, 89, 379, 1551, 6263});

    Grammar ternary;
    const auto width = [](float w) { return module("!", {number(w)}); };
    const auto forward = module("F", {number(2)});
    const auto pitch = module("&", {number(22.5F)});
    const auto bare = [](const char* text) { return module(text, {}); };
    add_axiom(ternary, {width(1.4F), forward, module("/", {number(45)}), bare("A")});
    std::vector<ModuleUse> successor = {width(1.4F), forward};
    for (const float roll : {112.5F, 157.5F, 0.0F}) {
        successor.insert(successor.end(), {bare("["), pitch, forward, bare("A"), bare("]")});
        if (roll > 0) {
            successor.push_back(module("/", {number(roll)}));
        }
    }
    add_production(ternary, production("a", {{"A", {}}}, successor));
    const Expr longer = binary("*", name("l"), number(1.1F));
    const Expr wider = binary("*", name("w"), number(1.4F));
    add_production(ternary, production("f", {{"F", {"l"}}}, {module("F", {longer})}));
    add_production(ternary, production("w", {{"!", {"w"}}}, {module("!", {wider})}));
    CHECK(counts(ternary, 6) == Counts{4, 22, 76, 238, 724, 2182, 6556});
}

TEST_CASE("conditions: the bush of the benchmarks and Crankshaw 2.10") {
    Grammar bush;
    const Expr x = name("x");
    const Expr less = binary("-", x, number(1));
    add_axiom(bush, {module("A", {number(12)})});
    std::vector<ModuleUse> grow = letters("F[+A][-A]A");
    grow[0].arguments = {number(1)};
    grow[2].arguments = grow[6].arguments = {number(30)};
    grow[3].arguments = grow[7].arguments = grow[9].arguments = {less};
    Production p1 = production("p1", {{"A", {"x"}}}, grow);
    p1.condition = binary(">", x, number(0));
    Production p2 = production("p2", {{"A", {"x"}}}, {module("F", {number(1)})});
    p2.condition = binary("<=", x, number(0));
    add_production(bush, p1);
    add_production(bush, p2);
    CHECK(counts(bush, 5) == Counts{1, 10, 37, 118, 361, 1090});
    CHECK(text_after(bush, 1) == "F(1)[+(30)A(11)][-(30)A(11)]A(11)");

    Grammar gap;
    add_axiom(gap, {module("A", {number(2)})});
    p1.condition = binary(">", x, number(2));
    p2.condition = binary("<", x, number(2));
    add_production(gap, p1);
    add_production(gap, p2);
    CHECK(text_after(gap, 3) == "A(2)");
}

TEST_CASE("Anabaena: Crankshaw 2.2") {
    // The cells al, ar, bl and br of the source are named L, A, K and B.
    const Grammar anabaena = letter_system("A", {"A=LB", "L=KA", "B=A", "K=L"});
    CHECK(text_after(anabaena, 1) == "LB");
    CHECK(text_after(anabaena, 2) == "KAA");
    CHECK(text_after(anabaena, 5) == "LLBLLBLBLLBLB");
}

TEST_CASE("contexts skip branches: the example of ABOP section 1.8") {
    // "BC < S > G[H]M" applies to S in this word; [DE] is skipped on the left, I[JK]L on the right.
    const char* kWord = "ABC[DE][SG[HI[JK]L]MNO]";
    CHECK(text_after(letter_system(kWord, {"BC<S>G[H]M=T"}), 1) == "ABC[DE][TG[HI[JK]L]MNO]");
    const auto applies = [&](const char* head) {
        return text_after(letter_system(kWord, {std::string(head) + "=T"}), 1) != kWord;
    };
    CHECK(applies("ABC<S"));
    CHECK_FALSE(applies("AC<S"));
    CHECK_FALSE(applies("E<S"));
    CHECK(applies("S>GMNO"));
    CHECK(applies("S>G[HIL]MN"));
    CHECK(applies("S>G[HI[J]L]M"));
    CHECK(applies("S>G[]M"));
    CHECK(applies("S>G[H[]]") == false); // the module after H is I
    CHECK(applies("S>G[HI[]]"));
    CHECK_FALSE(applies("S>G[I]M"));
    CHECK_FALSE(applies("S>[G]"));
    CHECK_FALSE(applies("S>GH"));
    CHECK_FALSE(applies("S>GMNOX"));
    CHECK(applies("C>[][S]")); // both branches of C
    CHECK(applies("C>[D][S[]G]") == false);
    CHECK_FALSE(applies("C>[S]")); // the next branch is [DE]
    CHECK(applies("A>BC"));
    CHECK(applies("SG<M>NO"));
    CHECK(applies("GHI<K") == false); // J lies between I and K on the path
    CHECK(applies("HIJ<K"));
    CHECK(applies("HI<L"));
}

TEST_CASE("signals in a tree: ABOP figure 1.30") {
    Grammar acropetal = letter_system("B[+A]A[-A]A[+A]A", {"B<A=B"});
    add_ignored(acropetal, {"+", "-"});
    CHECK(text_after(acropetal, 1) == "B[+B]B[-A]A[+A]A");
    CHECK(text_after(acropetal, 2) == "B[+B]B[-B]B[+A]A");
    CHECK(text_after(acropetal, 3) == "B[+B]B[-B]B[+B]B");
    Grammar basipetal = letter_system("A[+A]A[-A]A[+A]B", {"A>B=B"});
    add_ignored(basipetal, {"+", "-"});
    CHECK(text_after(basipetal, 1) == "A[+A]A[-A]B[+A]B");
    CHECK(text_after(basipetal, 2) == "A[+A]B[-A]B[+A]B");
    CHECK(text_after(basipetal, 3) == "B[+A]B[-A]B[+A]B");
    // Without #ignore, `+` and `-` are part of the context.
    CHECK(text_after(letter_system("B[+A]A", {"B<A=B"}), 3) == "B[+A]B");
}

TEST_CASE("a signal runs along a filament: ABOP section 1.8") {
    const Grammar signal = letter_system("baaaaaaaa", {"b<a=b", "b=a"});
    CHECK(text_after(signal, 1) == "abaaaaaaa");
    CHECK(text_after(signal, 4) == "aaaabaaaa");
    CHECK(text_after(signal, 9) == "aaaaaaaaa");
    const Grammar long_one = letter_system("b" + std::string(1000, 'a'), {"b<a=b", "b=a"});
    const std::string word = text_after(long_one, 20);
    CHECK(word.size() == 1001);
    CHECK(word.find('b') == 20);
}

TEST_CASE("brackets that do not balance") {
    const auto rewrite = [](const char* word, const char* production) {
        return text_after(letter_system(word, {production}), 1);
    };
    CHECK(rewrite("A[BC", "A>[B]=X") == "X[BC");  // an open branch reaches to the end
    CHECK(rewrite("A[BC", "A>[B]C=X") == "A[BC"); // so no module follows the branch
    CHECK(rewrite("A[BC", "A>B=X") == "A[BC");
    CHECK(rewrite("A]B", "A>B=X") == "A]B");
    CHECK(rewrite("A]B", "A<B=X") == "A]B");
    CHECK(rewrite("A[B", "A<B=X") == "A[X");
    const Derivation derivation = derive_for(letter_system("AB]", {"B=CC"}), 2, 0);
    REQUIRE(derivation.error);
    CHECK(derivation.error->failure == Failure::UnmatchedBracket);
    CHECK(derivation.error->position == 3);
    CHECK(derivation.words.size() == 3);
}

TEST_CASE("cyclic rewriting: Carey's type 1") {
    Grammar carey = letter_system("///A", {"A=F&[![A]^!A]^F^[!^FA]&!A", "F=FF"});
    add_setting(carey, "rewriting", "cyclic");
    CHECK(counts(carey, 6) == Counts{4, 26, 29, 117, 135, 487, 571});
}

TEST_CASE("leftmost rewriting makes one pass of all rules") {
    Grammar grammar = letter_system("ABABC", {"AB=CA", "C=", "A=B"});
    add_setting(grammar, "rewriting", "leftmost");
    CHECK(text_after(grammar, 1) == "CACA");
    CHECK(text_after(grammar, 2) == "BB"); // no `AB` is left, so each module is rewritten alone
    Grammar pairs = letter_system("AAAAA", {"AA=B", "A<A=C", "A=D"});
    add_setting(pairs, "rewriting", "leftmost");
    CHECK(text_after(pairs, 1) == "BBC"); // the last A has an A to its left in the old word
}

TEST_CASE("sequential rewriting makes a pass of every rule") {
    Grammar grammar = letter_system("ABAB", {"AB=C", "C=AC", "A=AA"});
    add_setting(grammar, "rewriting", "sequential");
    CHECK(text_after(grammar, 1) == "AACAAC"); // CC, ACAC, AACAAC
    // A match uses up its modules; contexts see the word before the pass.
    Grammar pairs = letter_system("AAAAA", {"AA=B", "B>B=C", "B<C=D"});
    add_setting(pairs, "rewriting", "sequential");
    CHECK(text_after(pairs, 1) == "CBA"); // BBA; the first B has a B to the right; no C after a B
    Grammar seen = letter_system("AAAA", {"A<AA=B"});
    add_setting(seen, "rewriting", "cyclic");
    CHECK(text_after(seen, 1) == "ABA"); // the match at position 1 uses up two modules
    Grammar neighbours = letter_system("A+A", {"AA=B", "A>A=C"});
    add_setting(neighbours, "rewriting", "sequential");
    add_ignored(neighbours, {"+"});
    // Ignored modules are not skipped inside a predecessor.
    CHECK(text_after(neighbours, 1) == "C+A");
}

TEST_CASE("a choice is made by the draws of section 6") {
    Grammar grammar;
    add_axiom(grammar, letters("AAAAAAAAAAAAAAAA"));
    Production left = production("l", {{"A", {}}}, letters("L"));
    Production middle = production("m", {{"A", {}}}, letters("M"));
    Production right = production("r", {{"A", {}}}, {module("R", {range(number(1), number(5))})});
    left.probability = number(0.25F);
    middle.probability = number(0.25F);
    right.probability = number(0.5F);
    for (const Production* one : {&left, &middle, &right}) {
        add_production(grammar, *one);
    }
    constexpr std::uint64_t kSeed = 0x123456789abcdef0;
    const Word word = derive_for(grammar, 1, kSeed).words[1];
    for (std::uint64_t position = 0; position < word.size(); ++position) {
        const float u = uniform(kSeed, position, 0, 0);
        CHECK(word[position].name == (u < 0.25F ? "L" : u < 0.5F ? "M" : "R"));
        if (word[position].name == "R") {
            CHECK(word[position].values[0] == 1 + 4 * uniform(kSeed, position, 0, 1));
        }
    }

    add_setting(grammar, "choice", "generation");
    const Word same = derive_for(grammar, 1, kSeed).words[1];
    const float u = uniform(kSeed, ~std::uint64_t{0}, 0, 0);
    for (std::uint64_t position = 0; position < same.size(); ++position) {
        CHECK(same[position].name == (u < 0.25F ? "L" : u < 0.5F ? "M" : "R"));
        if (same[position].name == "R") {
            CHECK(same[position].values[0] == 1 + 4 * uniform(kSeed, position, 0, 0));
        }
    }
}

TEST_CASE("in sequential rewriting a rule has draws of its own") {
    Grammar grammar;
    add_setting(grammar, "rewriting", "sequential");
    add_axiom(grammar, letters("BA"));
    const Expr unit = range(number(0), number(1));
    add_production(grammar, production("a", {{"A", {}}}, {module("X", {unit, range(unit, unit)})}));
    add_production(grammar, production("b", {{"B", {}}}, {module("Y", {unit})}));
    Grammar plain = grammar;
    // The upper bound is drawn before its range is; 1 + {0, 1} keeps it above the lower bound.
    plain.files[0].statements[2].production.successor[0].arguments[1] =
        range(number(0), binary("+", number(1), unit));
    const Word word = derive_for(plain, 1, 9).words[1];
    CHECK(word[0].values[0] == uniform(9, 0, 0, 4096));
    CHECK(word[1].values[0] == uniform(9, 1, 0, 0));
    CHECK(word[1].values[1] == (1 + uniform(9, 1, 0, 1)) * uniform(9, 1, 0, 2));
}

TEST_CASE("constants and the axiom draw before the derivation") {
    constexpr std::uint32_t kStart = 0xFFFFFFFF;
    const Expr unit = range(number(0), number(1));
    Grammar grammar;
    Statement constant;
    constant.kind = StatementKind::Define;
    constant.name = "K";
    constant.expr = binary("+", unit, unit);
    grammar.files.push_back({"main.lsys", false, {constant}});
    add_axiom(grammar, {module("A", {unit, name("K")}), module("A", {unit, name("K")})});
    const Word word = derive_for(grammar, 0, 5).words[0];
    CHECK(word[0].values[0] == uniform(5, 2, kStart, 0));
    CHECK(word[1].values[0] == uniform(5, 3, kStart, 0));
    CHECK(word[0].values[1] == uniform(5, 0, kStart, 0) + uniform(5, 1, kStart, 0));
    CHECK(word[1].values[1] == word[0].values[1]);

    Request request;
    request.seed = 5;
    request.definitions = {{"K", -7.0F}};
    const Word defined = derive(grammar, request).words[0];
    // The ranges of K keep their draw numbers although -D replaces its value.
    CHECK(defined[0].values == std::vector<float>{word[0].values[0], -7.0F});
}

TEST_CASE("the first match decides whether there is a choice") {
    const auto system = [](bool first_is_random) {
        Grammar grammar;
        add_axiom(grammar, letters("AAAAAAAAAAAAAAAAAAAAAAAA"));
        Production one = production("one", {{"A", {}}}, letters("B"));
        Production two = production("two", {{"A", {}}}, letters("C"));
        Production three = production("three", {{"A", {}}}, letters("D"));
        one.probability = number(0.5F);
        three.probability = number(0.5F);
        if (!first_is_random) {
            std::swap(one, two);
        }
        for (const Production* production : {&one, &two, &three}) {
            add_production(grammar, *production);
        }
        return text_after(grammar, 1);
    };
    CHECK(system(false) == std::string(24, 'C'));
    const std::string word = system(true);
    CHECK(word.find('B') != std::string::npos);
    CHECK(word.find('D') != std::string::npos);
    CHECK(word.find('C') == std::string::npos);
}

TEST_CASE("of several values that are not finite, the one at the lowest position is reported") {
    Grammar grammar;
    add_axiom(grammar,
              {module("B", {number(1)}), module("A", {number(1)}), module("A", {number(0)})});
    const Expr x = name("x");
    Production shrink = production("shrink", {{"B", {"x"}}}, {module("B", {x})});
    shrink.condition = binary("/", number(1), binary("-", x, number(0)));
    add_production(grammar, shrink);
    add_production(grammar, production("divide", {{"A", {"x"}}},
                                       {module("A", {binary("-", x, number(1))}),
                                        module("A", {binary("/", number(1), x)})}));
    const Derivation derivation = derive_for(grammar, 3, 0);
    REQUIRE(derivation.error);
    CHECK(derivation.error->failure == Failure::NotFinite);
    CHECK(derivation.error->production == "divide");
    CHECK(derivation.error->position == 2);
    CHECK(derivation.error->generation == 0);
    CHECK(derivation.error->module == Module{"A", {0}});
    CHECK(derivation.words.size() == 1);
}

} // namespace lsys::reference
