// SPDX-License-Identifier: MIT
// Grammars of other dialects: words have the lengths that the programs of the dialects give, and
// the output of `lsc import` derives equal words.
#include "grammar/dialects/dialect.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

const fs::path kCases = fs::path(LSYS_SOURCE_DIR) / "tests/ui";

/// A file of L3D's repository and the lengths of its words by generation.
struct Lengths {
    std::string file;
    bool chosen_by_chance = false;
    std::vector<std::uint64_t> lengths;
};

const std::vector<Lengths> kL3dLengths{
    {"koch.l", false, {1, 9, 49, 249, 1249, 6249, 31249}},
    {"fractal_plant.l", false, {1, 19, 94, 400, 1636, 6604}},
    {"seaweed.l", false, {1, 20, 172, 1388, 11116}},
    {"seaweed.l3d", false, {1, 29, 253, 2045, 16381}},
    {"nasty.l", false, {1, 11, 52, 3453, 6854}},
    {"simple.l3d", false, {1, 27, 183, 1119}},
    {"birds-nest.l3d", false, {1, 127, 3153, 76159}},
    {"birds-nest2.l3d", false, {1, 29, 253, 2045, 16381}},
    {"tree.l3d", false, {2, 46, 178, 574, 1762, 5326, 16018, 48094, 144322}},
    {"tree2.l3d", false, {1, 131, 647, 2447, 8351, 27071}},
    {"tree3.l3d", false, {1, 29, 113, 365, 1121, 3389}},
    {"tree4.l3d", false, {7, 23, 71, 215, 647, 1943, 5831}},
    {"tree5.l3d", false, {2, 29, 80, 179, 374, 761, 1532, 3071, 6146}},
    {"tree-bad.l3d", false, {1, 23, 263, 2423, 21863, 196823}},
    {"pine.l3d", false, {5, 125, 460}},
    {"leafbush.l3d", false, {1, 117, 363, 763, 1341, 2121, 3127, 4383, 5913}},
    {"flower.l3d", false, {1, 46, 1097, 5629, 26105, 121933}},
    {"blueberry.l3d", false, {2, 25, 194}},
    {"galium.l3d", false, {13, 103, 390, 1121, 2908, 7539}},
    {"palm.l3d", false, {5, 20, 49, 84, 125, 172, 225, 284, 349}},
    {"pine-bad.l3d", false, {5, 23, 93}},
    {"seaweed.l++", false, {1, 34, 298, 2410}},
    {"tree.l++", true, {2, 227, 632, 2657, 6302, 17237}},
    {"willow.l++", true, {2, 994, 3128, 9518, 28676}},
    {"pine.l++", true, {5, 179, 468, 872, 1679, 2607, 3356}},
    {"round.l++", true, {6, 20, 145, 267, 335, 460, 579}},
};

/// A late generation of a file; Lengths has only the first generations of the file.
struct Last {
    std::string file;
    std::string generation;
    std::string length; // of the word
};
const std::vector<Last> kLast{
    {"pine.l3d", "15", "24380"}, {"blueberry.l3d", "10", "9898"}, {"pine-bad.l3d", "8", "3138"},
    {"pine.l++", "15", "19370"}, {"round.l++", "64", "6554"},
};

/// Grammars of other dialects: the parts of the golden cases of each dialect, and the samples.
std::vector<fs::path> grammars() {
    std::set<fs::path> all;
    for (const lsys::DialectRow& row : lsys::dialects()) {
        const fs::path parts = kCases / fs::path(row.page).stem() / "parts";
        if (row.dialect == lsys::Dialect::Lsys) {
            continue;
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(parts)) {
            all.insert(entry.path());
        }
    }
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(LSYS_SOURCE_DIR) / "samples")) {
        if (entry.path().extension() == ".rules") {
            all.insert(entry.path());
        }
    }
    return {all.begin(), all.end()};
}

} // namespace

TEST_CASE("words have the same lengths as in L3D") {
    for (const Lengths& each : kL3dLengths) {
        const std::string path = (kCases / "l3d/parts" / each.file).string();
        std::string expected;
        for (const std::uint64_t length : each.lengths) {
            expected += std::to_string(length) + "\n";
        }
        const std::string last = std::to_string(each.lengths.size() - 1);
        for (const bool as_program : {true, false}) {
            if (!as_program && each.chosen_by_chance) {
                continue;
            }
            INFO(path << (as_program ? " --bug-compatible" : ""));
            std::vector<std::string> command{"dump", "--all", "--count", "-n", last, path};
            if (as_program) {
                command.emplace_back("--bug-compatible");
            }
            const LscRun run = run_lsc(command, "");
            INFO(run.err);
            CHECK(run.status == 0);
            CHECK(run.out == expected);
        }
    }
    for (const Last& each : kLast) {
        INFO(each.file);
        const LscRun run = run_lsc({"dump", "--count", "-n", each.generation, "--bug-compatible",
                                    (kCases / "l3d/parts" / each.file).string()},
                                   "");
        CHECK(run.out == each.length + "\n");
    }
}

TEST_CASE("surfaces have as many vertices as in L3D") {
    // L3D makes 2 * 20 to 2 * 100 vertices per segment, by thickness, and 8 per leaf.
    struct Surface {
        std::string text; // text after the three numbers of the header
        std::string thickness;
        long vertices;
        long leaf_faces;
    };
    const std::vector<Surface> surfaces{
        {"B\nB=f>(50)f*^=(70)f*(2)\n@\n", "20", 2 * (40 + 20 + 80) + 2 * 8, 2 * 6},
        {"fA\n@\n", "19.9", 40, 0},
        {"fA\n@\n", "40", 120, 0},
        {"fA\n@\n", "80", 200, 0},
    };
    const ScratchFolder scratch;
    for (const Surface& surface : surfaces) {
        INFO(surface.text << surface.thickness);
        const std::string grammar = scratch / "plant.l++";
        const std::string mesh = scratch / "plant.off+";
        lsys::tests::write_text(grammar, "1 90 " + surface.thickness + "\n" + surface.text);
        const LscRun run = run_lsc({"export", grammar, "--bug-compatible", "-o", mesh}, "");
        INFO(run.err);
        REQUIRE(run.status == 0);
        const std::string text = lsys::tests::read_text(mesh);
        CHECK(text.starts_with("OFF\n" + std::to_string(surface.vertices) + " "));
        long leaves = 0;
        for (std::size_t at = text.find(" 1\n3 "); at != std::string::npos;
             at = text.find(" 1\n3 ", at + 1)) {
            ++leaves;
        }
        leaves += text.ends_with(" 1\n") ? 1 : 0;
        CHECK(leaves == surface.leaf_faces);
    }
    // The tree of L3D has 485 segments, which taper from 40 to 20 sides, and 786 leaves.
    const std::string tree = (kCases / "l3d/parts/tree.l++").string();
    const std::string mesh = scratch / "tree.off+";
    const LscRun run = run_lsc({"export", tree, "--bug-compatible", "-o", mesh, "--stats"}, "");
    REQUIRE(run.status == 0);
    CHECK(lsys::tests::stated_number(run.out, "segments") == 485);
    const long vertices = lsys::tests::stated_number(run.out, "vertices");
    const long of_segments = vertices - 786 * 8;
    CHECK(of_segments >= 485 * 40);
    CHECK(of_segments <= 485 * 80);
    CHECK(of_segments % 40 == 0);
}

TEST_CASE("imported grammars derive the same words") {
    const ScratchFolder scratch;
    std::size_t without_warning = 0;
    std::size_t imported = 0;
    for (const fs::path& grammar : grammars()) {
        for (const bool as_program : {false, true}) {
            const std::string file = grammar.string();
            const std::string copy = scratch / "copy.lsys";
            INFO(file << (as_program ? " --bug-compatible" : ""));
            std::vector<std::string> options{"-n", "3", "--seed", "9"};
            std::vector<std::string> command{"import", file, "-o", copy, "-n", "3"};
            if (as_program) {
                command.emplace_back("--bug-compatible");
            }
            const LscRun run = run_lsc(command, "");
            if (run.status != 0) {
                continue;
            }
            ++imported;
            without_warning += run.err.find("warning: ") == std::string::npos ? 1U : 0U;
            std::vector<std::string> ours{"dump", copy};
            std::vector<std::string> theirs{"dump", file};
            ours.insert(ours.end(), options.begin(), options.end());
            theirs.insert(theirs.end(), options.begin(), options.end());
            if (as_program) {
                theirs.emplace_back("--bug-compatible");
            }
            const LscRun one = run_lsc(ours, "");
            const LscRun other = run_lsc(theirs, "");
            if (one.err.find("`--environment E=COMMAND`") != std::string::npos) { // asks a program
                CHECK(one.status == other.status);
                CHECK(other.err.find("`--environment E=COMMAND`") != std::string::npos);
                continue;
            }
            CHECK(one.status == 0);
            CHECK(one.out.size() > 1);
            CHECK(one.out == other.out);
            // The imported copy is formatted.
            CHECK(run_lsc({"fmt", "--check", copy}, "").status == 0);
        }
    }
    CHECK(imported > 50);
    CHECK(without_warning > 20);
}

namespace {

/// Replaces text as Carey's forest generator and L3D do, from left to right without overlap.
std::string with_replaced(const std::string& text, const std::string& key, const std::string& by) {
    std::string out;
    std::size_t at = 0;
    while (at < text.size()) {
        if (text.compare(at, key.size(), key) == 0) {
            out += by;
            at += key.size();
        } else {
            out += text[at++];
        }
    }
    return out;
}

struct TextRule {
    std::string key;
    std::string value;
};

/// A text of up to `count` symbols that ends in a letter, some with a parameter.
std::string random_text(std::mt19937& random, std::size_t count) {
    const std::string letters = "ABF";
    std::string text;
    for (std::size_t i = 1 + random() % count; i > 0; --i) {
        text += i > 1 && random() % 3 == 0 ? '+' : letters[random() % letters.size()];
        if (i > 1 && random() % 4 == 0) {
            text += "(" + std::to_string(3 + random() % 5) + ")";
        }
    }
    return text;
}

} // namespace

TEST_CASE("the rules of Carey's generator replace text, with parameters") {
    std::mt19937 random(7);
    const std::vector<std::string> keys{"A", "B", "F", "AB", "+F"};
    std::size_t compared = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<TextRule> rules;
        for (const std::string& key : keys) {
            if (random() % 2 == 0) {
                rules.push_back({key, random_text(random, 3)});
            }
        }
        if (rules.empty()) {
            continue;
        }
        std::string word = random_text(random, 4);
        std::string file = "axiom: " + word + "\ngenerations: 5\n";
        for (const TextRule& rule : rules) {
            file += rule.key + "=" + rule.value + "\n";
        }
        std::string wanted = word + "\n";
        for (std::size_t i = 0; i < 5; ++i) {
            const TextRule& rule = rules[i % rules.size()];
            word = with_replaced(word, rule.key, rule.value);
            wanted += word + "\n";
        }
        INFO(file);
        const ScratchFolder folder;
        lsys::tests::write_text(folder / "a.rules", file);
        const LscRun run = run_lsc({"dump", "--all", "-q", folder / "a.rules"}, "");
        INFO(run.err);
        CHECK(run.status == 0);
        CHECK(run.out == wanted);
        const LscRun count = run_lsc({"dump", "--count", "-q", folder / "a.rules"}, "");
        const auto modules =
            std::ranges::count_if(word, [](char c) { return c == '+' || (c >= 'A' && c <= 'Z'); });
        CHECK(count.out == std::to_string(modules) + "\n");
        ++compared;
    }
    CHECK(compared > 50);
}

TEST_CASE("a note appears if and only if the order of L3D's rules matters") {
    std::mt19937 random(11);
    const std::string letters = "ABCD";
    std::size_t notes = 0;
    std::size_t alike = 0;
    for (int round = 0; round < 120; ++round) {
        std::string order = letters;
        for (std::size_t i = order.size() - 1; i > 0; --i) {
            std::swap(order[i], order[random() % (i + 1)]);
        }
        std::vector<TextRule> by_line;
        for (const char key : order.substr(0, 2 + random() % 3)) {
            std::string value;
            for (std::size_t i = random() % 3; i > 0; --i) {
                value += letters[random() % letters.size()];
            }
            by_line.push_back({std::string(1, key), value + "F"});
        }
        std::vector<TextRule> by_key = by_line;
        std::ranges::sort(by_key, {}, &TextRule::key);
        const std::string axiom = std::string("F") + letters[random() % letters.size()];
        std::string file = "3 90 5\n" + axiom + "\n";
        for (const TextRule& rule : by_line) {
            file += rule.key + "=" + rule.value + "\n";
        }
        std::string first = axiom;
        std::string second = axiom;
        bool differs = false;
        for (int i = 0; i < 3; ++i) {
            for (const TextRule& rule : by_line) {
                first = with_replaced(first, rule.key, rule.value);
            }
            for (const TextRule& rule : by_key) {
                second = with_replaced(second, rule.key, rule.value);
            }
            differs = differs || first != second;
        }
        INFO(file << first << "\n" << second);
        const ScratchFolder folder;
        lsys::tests::write_text(folder / "a.l3d", file + "@\n");
        const LscRun run = run_lsc({"check", folder / "a.l3d"}, "");
        INFO(run.err);
        CHECK((run.err.find("[rule-order]") != std::string::npos) == differs);
        const LscRun as_program = run_lsc({"check", "--bug-compatible", folder / "a.l3d"}, "");
        CHECK(as_program.err.find("[rule-order]") == std::string::npos);
        ++(differs ? notes : alike);
    }
    CHECK(notes > 20);
    CHECK(alike > 20);
}
