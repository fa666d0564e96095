// SPDX-License-Identifier: MIT
// Systems from the literature behind the language and its dialects: words, counts and probabilities
// that the texts print, or that follow from the texts.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;

std::string sample(const std::string& name, const std::string& extension = "lsys") {
    return LSYS_SOURCE_DIR "/samples/" + name + "/" + name + "." + extension;
}

/// The output of `lsc dump FILE ARGUMENTS`.
std::string dump(const std::string& file, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"dump", "--quiet", file});
    const LscRun run = run_lsc(arguments, "");
    INFO(run.err);
    REQUIRE(run.status == 0);
    return run.out;
}

std::string word_of(const std::string& name, int generations) {
    return dump(sample(name), {"-n", std::to_string(generations)});
}

/// The number of times that a text stands in another.
std::size_t occurrences(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos;
         at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

std::string without(std::string text, std::string_view unwanted) {
    std::erase_if(text, [&](char c) { return unwanted.find(c) != std::string_view::npos; });
    return text;
}

/// One generation by the loop on the slides of L3D: replaces the keys of the rules one after the
/// other, each in the whole word.
std::string replaced(std::string word, const std::map<std::string, std::string>& rules) {
    for (const auto& [key, value] : rules) {
        std::string next;
        for (std::size_t at = 0; at < word.size();) {
            const bool found = word.compare(at, key.size(), key) == 0;
            next += found ? value : word.substr(at, 1);
            at += found ? key.size() : 1;
        }
        word = std::move(next);
    }
    return word;
}

} // namespace

TEST_CASE("Crankshaw 2019, 2.2: the filament of six generations") {
    CHECK(dump(sample("crankshaw-2-2-anabaena"), {"--all"}) == "ar\n"
                                                               "al br\n"
                                                               "bl ar ar\n"
                                                               "al al br al br\n"
                                                               "bl ar bl ar ar bl ar ar\n"
                                                               "al al br al al br al br al al br "
                                                               "al br\n");
}

TEST_CASE("Crankshaw 2019, 2.3: a segment with a bump") {
    CHECK(dump(sample("crankshaw-2-3-koch"), {}) == "F+F-F-F+F\n");
}

TEST_CASE("Crankshaw 2019, figure 2.5: every edge of the gasket is drawn") {
    std::size_t edges = 1;
    for (int n = 0; n <= 5; ++n, edges *= 3) {
        const std::string skeleton = dump(sample("crankshaw-2-5-sierpinski"),
                                          {"-n", std::to_string(n), "--stage", "skeleton"});
        CHECK(occurrences(skeleton, "segment ") == edges);
    }
}

TEST_CASE("Crankshaw 2019, 2.6 and 2.7: lengths are passed on by parameters") {
    CHECK(word_of("crankshaw-2-6-parametric", 1) == "F(5)+(90)F(5)+(90)F(5)+(90)F(5)\n");
    CHECK(occurrences(word_of("crankshaw-2-6-parametric", 4), "F(5)") == 256);
    CHECK(word_of("crankshaw-2-7-objects", 1) == "F(1)F(1)F(1)F(1)S(1)\n");
    // The sphere begins where the last of four segments of length 1 ends.
    CHECK(dump(sample("crankshaw-2-7-objects"), {"--stage", "skeleton"})
              .find("sphere parent 3 order 0 at (0, 4, 0)") != std::string::npos);
}

TEST_CASE("Crankshaw 2019, figure 2.8: eight times more branches in each generation") {
    std::size_t branches = 1;
    for (int n = 0; n <= 5; ++n, branches *= 8) {
        CHECK(occurrences(word_of("crankshaw-2-8-bush", n), "F") == branches);
    }
}

TEST_CASE("Crankshaw 2019, 2.8: widths shrink by 0.707 and lengths grow by 1.456") {
    CHECK(word_of("crankshaw-2-8-widths", 2) ==
          "F(1.456)!(5)[+F(1)!(3.535)[+A(2.4992452)][-A(2.4992452)]]"
          "[-F(1)!(3.535)[+A(2.4992452)][-A(2.4992452)]]\n");
}

TEST_CASE("Crankshaw 2019, figure 2.9: branches get twice as long") {
    // Counts: F(n+1) = 2 F(n) + 3 X(n) and X(n) = 4^n.
    std::size_t segments = 0;
    std::size_t tips = 1;
    for (int n = 0; n <= 5; ++n) {
        const std::string word = word_of("crankshaw-2-9-tree", n);
        CHECK(occurrences(word, "F") == segments);
        CHECK(occurrences(word, "X") == tips);
        segments = 2 * segments + 3 * tips;
        tips *= 4;
    }
}

TEST_CASE("Crankshaw 2019, 2.10: the words of six generations") {
    CHECK(without(dump(sample("crankshaw-2-9-conditions"), {"--all"}), " ") == "A(0)B(0,4)\n"
                                                                               "A(1)B(1,4)\n"
                                                                               "A(2)B(2,4)\n"
                                                                               "CB(3,4)\n"
                                                                               "CB(4,4)\n"
                                                                               "CD\n");
}

TEST_CASE("Crankshaw 2019, 2.11: a flower at the sixth generation and leaves on both sides") {
    CHECK(occurrences(word_of("crankshaw-2-11-flower", 2), "S(0.3)") == 0);
    CHECK(occurrences(word_of("crankshaw-2-11-flower", 6), "S(0.3)") == 1);
    std::size_t left = 0;
    std::size_t right = 0;
    std::istringstream lines(dump(sample("crankshaw-2-11-flower"), {"--stage", "skeleton"}));
    for (std::string line; std::getline(lines, line);) {
        if (line.find(" leaf ") == std::string::npos) {
            continue;
        }
        std::istringstream frame(line.substr(line.find("frame (") + 7));
        double w = 0;
        double x = 0;
        double y = 0;
        double z = 0;
        char comma = ',';
        REQUIRE((frame >> w >> comma >> x >> comma >> y >> comma >> z));
        // The sign of the x coordinate of the leaf's Y axis.
        ++(2.0 * (x * y - w * z) < 0.0 ? left : right);
    }
    CHECK(left > 0);
    CHECK(right > 0);
    CHECK(left + right == 10); // two leaves for each of five pieces
}

TEST_CASE("Crankshaw 2019, 2.12: turns from -20 to 20 degrees") {
    const std::string word = dump(sample("crankshaw-2-12-random"), {"-n", "1", "--seed", "7"});
    const std::string begin = "!(0.2)F(1)[+(25)F(1)][-(25)F(1)]+(";
    REQUIRE(word.starts_with(begin));
    CHECK(word != dump(sample("crankshaw-2-12-random"), {"-n", "1", "--seed", "8"}));
    const double first = std::stod(word.substr(begin.size()));
    CHECK(first >= -20.0);
    CHECK(first < 20.0);
}

TEST_CASE("Crankshaw 2019, 2.13: each production in a third of the plants") {
    std::map<std::string, int> words;
    const int seeds = 300;
    for (int seed = 0; seed < seeds; ++seed) {
        ++words[dump(sample("crankshaw-2-13-stochastic"),
                     {"-n", "1", "--seed", std::to_string(seed)})];
    }
    REQUIRE(words.size() == 3);
    // 4 standard deviations of a binomial distribution: sqrt(300 / 3 * 2 / 3) is 8.2.
    for (const char* const word : {"F(1)[+(25)F(1)]F(1)[-(25)F(1)]F(1)\n", "F(1)[+(25)F(1)]F(1)\n",
                                   "F(1)[-(25)F(1)]F(1)\n"}) {
        CHECK(words[word] > 100 - 33);
        CHECK(words[word] < 100 + 33);
    }
}

TEST_CASE("Crankshaw 2019, 7.1 and 7.2: as printed") {
    CHECK(word_of("crankshaw-7-1", 1) == "!(0.5)F(0.4,30)[-(20)Z]F(0.4,30)[+(20)Z]-(20)Z\n");
    CHECK(word_of("crankshaw-7-2", 1) ==
          "!(1.707)F(0.5)[!(1)/(25.7)+(25.7)X][!(1)-(25.7)X][!(1)^(25.7)X][!(1)&(25.7)X]"
          "!(1)F(0.5)X\n");
    // Segments: F(n+1) = 2 F(n) + 2 tips(n), with 3^n or 5^n tips.
    for (const auto& [name, forks, last] :
         {std::tuple<std::string, std::size_t, int>{"crankshaw-7-1", 3, 6},
          {"crankshaw-7-2", 5, 5}}) {
        std::size_t segments = 0;
        std::size_t tips = 1;
        for (int n = 0; n < last; ++n, tips *= forks) {
            segments = 2 * segments + 2 * tips;
        }
        CHECK(occurrences(word_of(name, last), "F(") == segments);
    }
}

TEST_CASE("Crankshaw 2019, 7.3: as printed, and with its bracket, module and sphere corrected") {
    CHECK(word_of("crankshaw-7-3", 1) ==
          "!(1.9599999)F(2.2)/(45)!(1.4)F(2)[&(22.5)F(2)A S(1)!(1.4)]/(112.5)"
          "[&(22.5)F(2)A S(1)!(1.4)]/(157.5)[&(22.5)F(2)A S(1)!(1.4)]\n");
    const std::string corrected = word_of("crankshaw-7-3", 6);
    const std::string printed = word_of("crankshaw-7-3-as-printed", 6);
    for (const std::string& word : {corrected, printed}) {
        // 1 + 4 (1 + 3 + ... + 243) segments.
        CHECK(occurrences(word, "F(") == 1457);
        CHECK(occurrences(word, "[") == 3 * 364);
    }
    CHECK(occurrences(corrected, "]") == 3 * 364);
    CHECK(occurrences(printed, "]") == 2 * 364);
    CHECK(occurrences(dump(sample("crankshaw-7-3"), {"--stage", "skeleton"}), " sphere ") ==
          3 * 364);
    CHECK(occurrences(dump(sample("crankshaw-7-3-as-printed"), {"--stage", "skeleton"}),
                      " sphere ") == 0);
}

TEST_CASE("Carey 2019, 3.2.2: the four forms of a production and their probabilities") {
    const std::string forms = dump(sample("carey-3-2-2"), {"--stage", "instanced", "--rho", "0.4"});
    for (const char* const form :
         {"~ 0.108 : !@(1,#)[B]$\\\\@(1,#)[B]$\\\\B;", "~ 0.072 : !<(1,#)[B]>\\\\@(1,#)[B]$\\\\B;",
          "~ 0.072 : !@(1,#)[B]$\\\\<(1,#)[B]>\\\\B;",
          "~ 0.048 : !<(1,#)[B]>\\\\<(1,#)[B]>\\\\B;"}) {
        INFO(forms);
        CHECK(occurrences(forms, form) == 1);
    }
}

TEST_CASE("the .sys report, figure 1: the word letter for letter") {
    const std::string printed =
        "F[>F][<F]F[>F[>F][<F]F][<F[>F][<F]F]F[>F][<F]F[>F[>F][<F]F[>F[>F][<F]F][<F[>F][<F]F]F[>F]"
        "[<F]F][<F[>F][<F]F[>F[>F][<F]F][<F[>F][<F]F]F[>F][<F]F]F[>F][<F]F[>F[>F][<F]F][<F[>F][<F]"
        "F]F[>F][<F]F";
    const std::string file = sample("sys-figure-1", "sys");
    CHECK(without(dump(file, {"-n", "3"}), "`\n") == printed);
    CHECK(without(word_of("sys-figure-1", 3), "`\n") == printed);
}

TEST_CASE("Naderi's slides: words of the loop of replacements") {
    std::string sample_word = "fA";
    std::string plant_word = "X";
    for (int n = 0; n < 2; ++n) {
        sample_word = replaced(sample_word, {{"A", "[fA][+fA][-fA]"}});
    }
    for (int n = 0; n < 6; ++n) {
        plant_word = replaced(plant_word, {{"F", "FF"}, {"X", "F-[[X]+X]+F[+FX]-X"}});
    }
    CHECK(plant_word.size() == 25159);
    CHECK(without(dump(sample("naderi-sample", "l"), {}), "`\n") == sample_word);
    CHECK(without(dump(sample("naderi-fractal-plant", "l"), {}), "`\n") == plant_word);
}

TEST_CASE("Naderi's slides: one value for all keys of a generation") {
    // Each L beside a remaining A was replaced in the fifth generation.
    std::map<std::string, int> values;
    for (int seed = 0; seed < 30; ++seed) {
        const std::string word =
            dump(sample("naderi-leaves", "l++"), {"--seed", std::to_string(seed)});
        CHECK(occurrences(word, "L") == 0);
        std::string value;
        for (const char* const each :
             {"[^(60) [*(.3)] +(50)*(.28)]", "[^(60)*(.3)]", "[&(70)*(.3)]"}) {
            if (word.find(std::string("A ") + each) != std::string::npos) {
                CHECK(value.empty());
                value = each;
            }
        }
        CHECK(occurrences(word, "A ") == occurrences(word, "A " + value + "]"));
        ++values[value];
    }
    CHECK(values.size() == 3);
    // The text as printed on the slide, with all brackets and `^{*}` written `^*`, gives a longer
    // word; characters are counted.
    const lsys::tests::ScratchFolder folder;
    lsys::tests::write_text(folder / "printed.l++", R"(5
15
20
fA
A=^f >(30) B\\B\\\\\\B
B=[[^][^]fL \\\\\A L]
L=[[^](60) [^*(.3)] +(50)^*(.28)]
L=[[^](60)^*(.3)]
L=[[&](70)^*(.3)]
@
)");
    CHECK(dump(folder / "printed.l++", {"--count"}) == "26871\n");
    CHECK(dump(folder / "printed.l++", {}).size() == 26871 + 3); // two back quotes and the line end
    CHECK(dump(sample("naderi-leaves", "l++"), {"--count"}) == "22749\n");
    // In each of 64 generations, the tip adds three segments.
    const std::string spiral = dump(sample("naderi-spiral", "l++"), {});
    CHECK(occurrences(spiral, "^(15)") == 64);
    CHECK(occurrences(spiral, "Z") == 1);
}
