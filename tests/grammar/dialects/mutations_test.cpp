// SPDX-License-Identifier: MIT
// Texts of dialects with one typing mistake give few errors, each at a place within the file.
#include "grammar/dialects/dialect.h"
#include "grammar/rendering/render_diagnostic.h"

#include <catch2/catch.hpp>

#include <array>
#include <random>
#include <string>
#include <string_view>

using namespace lsys;

namespace {

struct Text {
    Dialect dialect;
    std::string_view text;
};

constexpr std::array kTexts{
    Text{Dialect::Abop, "/* a tree */\n"
                        "#define r 0.8\n"
                        "n = 5, \u03B4 = 25.7\u00B0\n"
                        "#ignore: + -\n"
                        "\u03C9 : A(1)\n"
                        "p1 : A(x) : x > 0.5 and x < 3 \u2192 F(x)[+A(x*r)]\n"
                        "    [-$B(x + random(1, 2))] // twigs\n"
                        "p2 : F < B(x) > A(y) : y >= 1 -> !(x)F(x)~l\n"
                        "p3 : F(x) -0.4-> F(x)F_l\n"
                        "p4 : F(x) -0.6-> F(x)F\n"
                        "A(x) : x <= 0.5 -> *\n"},
    Text{Dialect::Lparser, "# a tree\n"
                           "6      # depth\n"
                           "20\n"
                           "15\n"
                           "c(8)A\n"
                           "A='(.9)F[+(40)A]>(90)[-B]~(5)A\n"
                           "B=!(.8)Z{-f+f+f-|-f+f+f}:;\"?\n"
                           "@\n"},
    Text{Dialect::Lpy, "from math import *\n"
                       "RATIO = 0.7\n"
                       "module Apex(x), Bud\n"
                       "Axiom: _(0.2)Apex(1)Bud\n"
                       "derivation length: 3\n"
                       "production:\n"
                       "Apex(x) :\n"
                       "    if x > 0.5:\n"
                       "        produce F(x)[+(30)Apex(x*RATIO)]Bud\n"
                       "    else:\n"
                       "        produce *\n"
                       "Apex(y) < Bud --> uBud\n"
                       "homomorphism:\n"
                       "Bud --> ;(3)~l(0.3)\n"
                       "endlsystem\n"},
};

/// Inserts, removes, repeats or replaces some characters, or cuts the text.
std::string mutated(std::string text, std::mt19937& random) {
    constexpr std::array<std::string_view, 20> kInserted{
        "(", ")", "[",  "]", ":",      "->", "<", "=", ",", "{",
        "}", "x", "\n", "#", "\u00E9", "/*", "-", "*", "1", std::string_view("\0", 1)};
    const std::size_t at = random() % text.size();
    switch (random() % 5) {
    case 0:
        text.insert(at, kInserted[random() % kInserted.size()]);
        break;
    case 1:
        text.erase(at, 1 + random() % 3);
        break;
    case 2:
        text.resize(at);
        break;
    case 3:
        text.insert(at, text.substr(at, 1 + random() % 20));
        break;
    default:
        text[at] = static_cast<char>(' ' + random() % 95);
    }
    return text;
}

} // namespace

TEST_CASE("one mistake in a text of a dialect gives few errors") {
    constexpr int kRounds = 400;
    constexpr std::uint64_t kMaxErrors = 3;
    const FileLoader load = [](const std::string&) -> Result<std::string> {
        return Error{"no such file"};
    };
    std::mt19937 random(5);
    for (const Text& each : kTexts) {
        std::uint64_t wrong = 0;
        for (int round = 0; round < kRounds; ++round) {
            const std::string text =
                round == 0 ? std::string(each.text) : mutated(std::string(each.text), random);
            SourceMap sources;
            Names names;
            Diagnostics diagnostics;
            const FileId file = sources.add("mutated", text);
            static_cast<void>(
                parse_dialect(file, each.dialect, {sources, names, diagnostics, load, false, ""}));
            diagnostics.sort_by_place();
            std::string messages;
            render_all(diagnostics, sources, {}, messages);
            INFO(row_of(each.dialect).name << "\n" << text << messages);
            const std::uint64_t errors = diagnostics.count(Severity::Error);
            CHECK(errors <= (round == 0 ? 0 : kMaxErrors));
            wrong += errors != 0 ? 1U : 0U;
        }
        CHECK(wrong > kRounds / 4);
    }
}
