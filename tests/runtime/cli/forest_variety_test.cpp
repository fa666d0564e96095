// SPDX-License-Identifier: MIT
// `lsc forest --variety` and `--memory`, and the note about forests with few different trees.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;
using lsys::tests::write_text;

std::string sample(const std::string& name) {
    return std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + name + ".lsys";
}

/// The text between `before` and `after`.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t begin = text.find(before);
    INFO(text);
    REQUIRE(begin != std::string::npos);
    const std::size_t end = text.find(after, begin + before.size());
    REQUIRE(end != std::string::npos);
    return text.substr(begin + before.size(), end - begin - before.size());
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words(1);
    for (const char c : text) {
        if (c == ' ') {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

LscRun forest(std::vector<std::string> arguments, const std::vector<std::string>& further) {
    arguments.insert(arguments.begin(), "forest");
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run_lsc(arguments, "");
}

/// The number of different trees and the digest, from the statistics.
std::pair<int, std::string> shape_of(const LscRun& run) {
    INFO(run.err);
    REQUIRE(run.status == 0);
    return {std::stoi(between(run.out, "trees      300, ", " of")),
            between(run.out, "digest     ", "\n")};
}

} // namespace

TEST_CASE("the option --variety chooses heroes that give the requested number of different trees") {
    for (const std::string name : {"carey-type-0", "carey-type-2"}) {
        const std::vector<std::string> base{sample(name), "--count", "300", "--stats"};
        const LscRun run = forest(base, {"--variety", "0.9"});
        const auto [different, digest] = shape_of(run);
        CHECK(different >= 270);
        // The options that the run prints give the same forest.
        const std::string chosen = between(run.err, name + ": chose ", ": ");
        CHECK(run.err.find(std::to_string(different) + " of 300 trees different") !=
              std::string::npos);
        CHECK(shape_of(forest(base, words_of(chosen))).second == digest);
        CHECK(shape_of(forest(base, {"--variety", "0.9", "--threads", "1"})).second == digest);
    }
}

TEST_CASE("if --variety and --memory contradict each other, the message has the nearest possible "
          "values") {
    const std::vector<std::string> base{sample("carey-type-0"), "--count", "300", "--stats", "-q"};
    const LscRun refused = forest(base, {"--variety", "0.9", "--memory", "1K"});
    CHECK(refused.status == 2);
    const std::string memory = between(refused.err, "`--memory ", "` is enough");
    CHECK(shape_of(forest(base, {"--variety", "0.9", "--memory", memory})).first >= 270);
    const LscRun some = forest(base, {"--variety", "1", "--memory", memory});
    if (some.status != 0) {
        const std::string share = between(some.err, "`--variety ", "`");
        CHECK(shape_of(forest(base, {"--variety", share, "--memory", memory})).first >=
              static_cast<int>(300.0 * std::stod(share)));
    }
    CHECK(shape_of(forest(base, {"--memory", memory})).first >= 270);
}

TEST_CASE("if --memory is too small, the message has the least memory that is enough") {
    const ScratchFolder folder;
    write_text(folder / "a.lsys", "#n = 3; #w : A(2);\n"
                                  "#p : A(x) : * : F(x) [ +({10, 40}) A(x/2) ] A(x);\n");
    const std::vector<std::string> base{folder / "a.lsys", "--count", "1000", "--stats", "-q"};
    const LscRun refused = forest(base, {"--memory", "1"});
    CHECK(refused.status == 2);
    CHECK(refused.err.find("--memory 1: no choice") != std::string::npos);
    const std::string memory = between(refused.err, "`--memory ", "` is the minimum");
    CHECK(forest(base, {"--memory", memory}).status == 0);
}

TEST_CASE("the option --variety is refused for a system without chance") {
    const ScratchFolder folder;
    write_text(folder / "fixed.lsys", "#n = 3; #w : A; #p : A : * : F[+A][-A];");
    const LscRun run = forest({folder / "fixed.lsys"}, {"--variety", "0.5", "--stats"});
    CHECK(run.status == 2);
    CHECK(run.err.find("--variety 0.5: nothing that `fixed` derives is left to chance") !=
          std::string::npos);
    // A forest of one tree needs no variety.
    CHECK(forest({folder / "fixed.lsys"}, {"--variety", "1", "--stats", "--count", "1"}).status ==
          0);
}

TEST_CASE("a note appears if few trees of a forest differ") {
    const ScratchFolder folder;
    write_text(folder / "twig.lsys",
               "#n = 2; #w : A; #p : A : ~ 0.5 : F[+A]A; #q : A : ~ 0.5 : F;");
    const std::vector<std::string> base{folder / "twig.lsys", "--count", "500", "--stats"};
    const LscRun run = forest(base, {});
    CHECK(run.status == 0);
    const std::string different = between(run.out, "trees      500, ", " of");
    CHECK(run.err.find("note: only " + different + " of 500 trees of `twig` differ [no-variety]") !=
          std::string::npos);
    CHECK(forest(base, {"--heroes", "1"}).err.find("no-variety") == std::string::npos);
    CHECK(forest(base, {"--rho", "0"}).err.empty());
    CHECK(forest({sample("carey-type-2")}, {"--count", "100", "--stats"}).err.empty());
}
