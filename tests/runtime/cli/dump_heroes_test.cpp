// SPDX-License-Identifier: MIT
// Compares the output of `lsc dump --stage heroes`, `cache` and `instanced` with a slow
// interpretation of the words.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

// All branches begin with the same turtle state, so a key is (id, age).
const char* const kBranching = "#n = 6; #set names letters; #set angle 25; #w : A;"
                               "#p : A : ~ 0.4 : F[+A[-A]F][-A]A; #q : A : ~ 0.4 : F[+A]A;"
                               "#r : A : ~ 0.2 : F[-F]A;";

std::string output_of(const std::vector<std::string>& arguments) {
    const LscRun run = run_lsc(arguments, "");
    INFO(run.err);
    REQUIRE(run.status == 0);
    return run.out;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// Reads the key `(id,age)` at `at`; returns the index after the key.
std::size_t read_key(const std::string& word, std::size_t at, std::pair<int, int>& key) {
    char* end = nullptr;
    key.first = static_cast<int>(std::strtol(word.c_str() + at + 1, &end, 10));
    key.second = static_cast<int>(std::strtol(end + 1, &end, 10));
    return static_cast<std::size_t>(end - word.c_str()) + 1;
}

/// A word of a hero without the operations of instancing.
std::string plain_word(const std::string& hero) {
    std::string word;
    std::pair<int, int> key;
    for (std::size_t i = 0; i < hero.size(); ++i) {
        if (hero[i] == '@' || hero[i] == '<') {
            i = read_key(hero, i + 1, key) - 1;
        } else if (hero[i] != '$' && hero[i] != '>') {
            word += hero[i];
        }
    }
    return word;
}

/// Branches of the heroes with one key, as `lsc dump --stage cache` counts them.
struct KeyRow {
    int instances = 0;
    int hits = 0;
    int misses = 0;
    int recorded = 0;
    bool operator==(const KeyRow&) const = default;
};
using KeyTable = std::map<std::pair<int, int>, KeyRow>;

/// Records the branches of a hero symbol by symbol, as in Carey 2019, sections 3.2.3 and 4.4.
void record(const std::string& hero, KeyTable& table) {
    for (std::size_t i = 0; i < hero.size();) {
        const char symbol = hero[i++];
        if (symbol != '@' && symbol != '<') {
            continue;
        }
        std::pair<int, int> key;
        i = read_key(hero, i, key);
        KeyRow& row = table[key];
        if (symbol == '@') {
            ++row.recorded;
            ++row.instances;
        } else if (row.instances == 0) {
            ++row.misses;
            ++row.instances;
        } else {
            ++row.hits;
            for (int depth = 1; depth > 0; ++i) { // skip to the matching `>`
                depth += hero[i] == '@' || hero[i] == '<' ? 1 : 0;
                depth -= hero[i] == '$' || hero[i] == '>' ? 1 : 0;
            }
        }
    }
}

} // namespace

TEST_CASE("a hero's word without its operations is the plain word of its seed") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", kBranching);
    const std::string file = folder / "tree.lsys";
    const std::vector<std::string> lines =
        lines_of(output_of({"dump", "--stage", "heroes", "--heroes", "5", "--seed", "40", file}));
    REQUIRE(lines.size() == 10);
    for (int hero = 0; hero < 5; ++hero) {
        const std::string seed = std::to_string(40 + hero);
        const std::size_t line = 2 * static_cast<std::size_t>(hero);
        CHECK(lines[line] == "hero " + std::to_string(hero) + ", seed " + seed + ":");
        CHECK(plain_word(lines[line + 1]) + "\n" == output_of({"dump", "--seed", seed, file}));
    }
    CHECK(output_of({"dump", "--stage", "heroes", "--heroes", "1", "--seed", "40", "--count",
                     file}) == output_of({"dump", "--seed", "40", "--count", file}));
}

TEST_CASE("the cache has the branches of the words of all heroes") {
    const ScratchFolder folder;
    write_text(folder / "tree.lsys", kBranching);
    const std::string file = folder / "tree.lsys";
    for (const char* const rho : {"0", "0.3", "0.9", "1"}) {
        KeyTable expected;
        for (const std::string& line :
             lines_of(output_of({"dump", "--stage", "heroes", "--rho", rho, file}))) {
            if (line.starts_with("@")) {
                record(line, expected);
            }
        }
        const std::vector<std::string> lines =
            lines_of(output_of({"dump", "--stage", "cache", "--rho", rho, file}));
        KeyTable printed;
        std::map<std::pair<int, int>, int> exits;
        std::size_t instances = 0;
        KeyRow* row = nullptr;
        for (const std::string& line : lines) {
            int number = 0;
            int id = 0;
            int age = 0;
            KeyRow read;
            int dropped = 0;
            if (std::sscanf(line.c_str(), "key %d: id %d age %d", &number, &id, &age) == 3) {
                row = &printed[{id, age}];
            } else if (std::sscanf(line.c_str(),
                                   "  instances %d hits %d misses %d recorded %d dropped %d",
                                   &read.instances, &read.hits, &read.misses, &read.recorded,
                                   &dropped) == 5) {
                REQUIRE(row != nullptr);
                *row = read;
                CHECK(dropped == 0);
            } else if (std::sscanf(line.c_str(), "    exit to key %d: id %d age %d", &number, &id,
                                   &age) == 3) {
                ++exits[{id, age}];
            } else if (line.starts_with("  instance ")) {
                ++instances;
            }
        }
        CHECK(printed == expected);
        std::size_t total = 0;
        for (const auto& [key, each] : expected) {
            total += static_cast<std::size_t>(each.instances);
            // Each branch of a hero (hit or miss) is at least one exit of the hero.
            CHECK(exits[key] >= each.hits + each.misses);
        }
        CHECK(instances == total);
    }
}

TEST_CASE("a listing of forms shows the requested rows") {
    const ScratchFolder folder;
    const auto write = [&](int branches) {
        std::string text = "#n = 1; #w : A; #p : A : ~ 0.5 : F";
        for (int i = 0; i < branches; ++i) {
            text += " [A]";
        }
        write_text(folder / "many.lsys", text + "; #q : A : ~ 0.5 : F;");
        return folder / "many.lsys";
    };
    // 24 choose i forms have i exchanged branches of the 24. The probabilities of all forms must
    // sum to that of the production.
    const std::string file = write(24);
    const std::vector<std::string> rows =
        lines_of(output_of({"dump", "--stage", "instanced", "--rho", "0.25", "--first", "16777213",
                            "--rows", "100", file}));
    REQUIRE(rows.size() == 4); // axiom and three forms
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::uint64_t form = 16'777'212 + i;
        CHECK(rows[i].starts_with("#p." + std::to_string(form) + " : A : * ~ "));
        std::size_t recorded = 0;
        std::size_t branch = 0;
        for (std::size_t at = 0; (at = rows[i].find("[A]", at)) != std::string::npos; ++at) {
            const bool records = rows[i][at + 3] == '$';
            CHECK(records == ((form >> branch++ & 1U) != 0));
            recorded += records ? 1U : 0U;
        }
        CHECK(branch == 24);
        const double chance = std::stod(rows[i].substr(rows[i].find('~') + 1));
        const double expected = 0.5 * std::pow(0.75, recorded) * std::pow(0.25, 24 - recorded);
        CHECK(chance == Approx(expected).epsilon(1e-8));
    }
    CHECK(lines_of(output_of({"dump", "--stage", "instanced", file, "-q"})).size() == 1 + 4096 + 1);
    // More branches than the index of a form has bits.
    const std::string wide = write(70);
    const std::vector<std::string> last = lines_of(
        output_of({"dump", "--stage", "instanced", "--first", "18446744073709551615", wide}));
    REQUIRE(last.size() == 2);
    CHECK(last[1].starts_with("#p.18446744073709551615 : "));
    CHECK(run_lsc({"dump", "--stage", "instanced", "--first", "256", write(8)}, "").status == 2);
}
