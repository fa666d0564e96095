// SPDX-License-Identifier: MIT
// `lsview --pick` and `--colours`: the text about the part of the plant at a pixel.
#include "runtime/program/host.h"
#include "tests/viewer/lsview_run.h"
#include "tests/viewer/picture.h"
#include "viewer/app/forest_document.h"
#include "viewer/app/picking.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

using namespace lsys;
using namespace lsys::tests;

namespace {

constexpr int kPictureWidth = 160;
constexpr int kPictureHeight = 120;
constexpr const char* kCross = "#n = 1;\n"
                               "#w : !(0.4) A;\n"
                               "#up : A : * : F(2) [ +(90) F(1.5) ] F(3);\n";

/// Options for a view of a plant from the front; the picture is 12 m high.
const std::vector<std::string> kFront = {"--camera", "eye 0,3,60 target 0,3,0 fov 11.421186",
                                         "--size",
                                         fmt::format("{}x{}", kPictureWidth, kPictureHeight)};

/// The pixel of a place in the plane of a plant that kFront shows, m.
std::string pixel(double x, double y) {
    const double metre = kPictureHeight / 12.0;
    return fmt::format("{},{}", static_cast<int>(std::floor(0.5 * kPictureWidth + x * metre)),
                       static_cast<int>(std::floor(0.5 * kPictureHeight - (y - 3.0) * metre)));
}

struct PickRun {
    LscRun run;
    std::vector<std::string> lines;
};

PickRun picked(std::vector<std::string> arguments, const std::string& at) {
    const ScratchFolder folder;
    arguments.insert(arguments.end(), {"--screenshot", folder / "a.png", "--pick", at});
    PickRun picked{run_lsview(arguments), {}};
    std::istringstream text(picked.run.out);
    for (std::string line; std::getline(text, line);) {
        picked.lines.push_back(line);
    }
    return picked;
}

std::vector<std::string> with_front(const std::string& file, std::vector<std::string> more) {
    more.insert(more.begin(), file);
    more.insert(more.end(), kFront.begin(), kFront.end());
    return more;
}

} // namespace

TEST_CASE(
    "the option --pick on a plant prints the module with its production, place and generation") {
    const ScratchFolder folder;
    const std::string file = folder / "cross.lsys";
    write_text(file, kCross);
    const auto at = [&](double x, double y) { return picked(with_front(file, {}), pixel(x, y)); };
    const PickRun trunk = at(0.0, 1.0);
    CAPTURE(trunk.run.err, trunk.run.out);
    REQUIRE(trunk.run.status == 0);
    REQUIRE(trunk.lines.size() == 4);
    CHECK(trunk.lines[0] == "F(2), module 1 of 7");
    CHECK(trunk.lines[1] == fmt::format("from up at {}:3:15, generation 1", file));
    CHECK(trunk.lines[2].rfind("segment 0 of 3, 2 m long, ", 0) == 0);
    CHECK(at(0.0, 4.0).lines.at(0) == "F(3), module 6 of 7");
    // The branch turns towards +X.
    CHECK(at(1.2, 2.0).lines.at(0) == "F(1.5), module 4 of 7");
    CHECK(at(1.2, 2.0).lines.at(1) == fmt::format("from up at {}:3:28, generation 1", file));
    CHECK(at(-1.2, 2.0).lines == std::vector<std::string>{"nothing"});
    CHECK(at(1.2, 3.0).lines == std::vector<std::string>{"nothing"});
}

TEST_CASE("the option --pick on a moving plant uses its pose") {
    const ScratchFolder folder;
    const std::string file = folder / "cross.lsys";
    write_text(file, kCross);
    // Between the generations, segments have half of their length, so the tip is at 2.5 m.
    const PickRun grown = picked(with_front(file, {"--grow", "--frames", "3"}), pixel(0.0, 4.0));
    CAPTURE(grown.run.err);
    REQUIRE(grown.run.status == 0);
    REQUIRE(grown.lines.size() == 9);
    CHECK(grown.lines[0] == "picture 1");
    CHECK(grown.lines[1] == "nothing");
    CHECK(grown.lines[2] == "picture 2");
    CHECK(grown.lines[3] == "nothing");
    CHECK(grown.lines[4] == "picture 3");
    CHECK(grown.lines[5] == "F(3), module 6 of 7");
    const PickRun half = picked(with_front(file, {"--grow", "--frames", "3"}), pixel(0.0, 2.0));
    REQUIRE(half.lines.size() > 4);
    CHECK(half.lines[3] == "F(3), module 6 of 7");
    // A strong wind along X moves the top away.
    const std::vector<std::string> windy = {"--wind", "40,0,0", "--set", "elasticity=3e6"};
    CHECK(picked(with_front(file, {}), pixel(0.0, 4.6)).lines.at(0) == "F(3), module 6 of 7");
    CHECK(picked(with_front(file, windy), pixel(0.0, 4.6)).lines.at(0) == "nothing");
}

TEST_CASE("the option --pick with --why prints the text of lsc trace") {
    const ScratchFolder folder;
    const std::string file = folder / "bud.lsys";
    write_text(file, "#n = 2;\n"
                     "#w : !(0.4) A(3);\n"
                     "#low  : A(x) : x < 1       : F(x);\n"
                     "#up   : A(x) : x >= 1 ~ 0.5 : let y = x - 1 : F(y) [ +(90) S(y) ] A(x - 1);\n"
                     "#both : A(x) : x >= 1 ~ 0.5 : F(x - 1) [ +(90) S(x - 1) ] A(x - 1);\n"
                     "#interpret s : S(x) : * : F(x) F(0.1);\n");
    struct Scope {
        const char* why;
        const char* option; // option of lsc trace; empty: none
    };
    for (const Scope scope :
         {Scope{"written", "--written"}, Scope{"next", ""}, Scope{"back", "--back"}}) {
        for (const double x : {0.0, 1.2}) { // the stem, and a branch that is drawn by #interpret
            const PickRun pick =
                picked(with_front(file, {"--why", scope.why}), pixel(x, x == 0.0 ? 1.0 : 2.0));
            CAPTURE(scope.why, x, pick.run.err, pick.run.out);
            REQUIRE(pick.run.status == 0);
            REQUIRE(pick.lines.size() > 5);
            CHECK(pick.lines[0] == (x == 0.0 ? "F(2), module 1 of 12" : "S(2), module 4 of 12"));
            std::vector<std::string> arguments = {"trace", file, "--at", x == 0.0 ? "1" : "4"};
            if (scope.option[0] != '\0') {
                arguments.emplace_back(scope.option);
            }
            const LscRun trace = run_lsc(arguments, "");
            REQUIRE(trace.status == 0);
            const std::size_t at = pick.run.out.find("\n\n");
            REQUIRE(at != std::string::npos);
            CHECK(pick.run.out.substr(at + 2) == trace.out);
            if (x != 0.0) {
                CHECK((trace.out.find("interpretation, pass 0") == std::string::npos) ==
                      (scope.why == std::string("back")));
            }
        }
    }
    CHECK(picked(with_front(file, {"--why", "written"}), pixel(-3.0, 3.0)).lines ==
          std::vector<std::string>{"nothing"});
}

TEST_CASE("the option --why at a moment of growth traces the word of that moment") {
    const ScratchFolder folder;
    const std::string file = folder / "two.lsys";
    write_text(file, "#n = 3;\n#w : !(0.4) A;\n#up : A : step() < steps() - 1 : F(2) A;\n");
    const PickRun grown =
        picked(with_front(file, {"--grow", "--frames", "4", "--why", "written"}), pixel(0.0, 1.0));
    CAPTURE(grown.run.err, grown.run.out);
    REQUIRE(grown.run.status == 0);
    const auto prints = [&](const char* text) {
        return grown.run.out.find(text) != std::string::npos;
    };
    CHECK(prints("F(2) at position 1 of generation 1, written by `up`"));
    CHECK(prints("F(2) at position 1 of generation 2, written by `up`"));
    CHECK(prints("steps() - 1   3 - 1 = 2")); // the whole derivation has 3 generations
}

TEST_CASE("the option --pick on a forest prints the branch and its number of instances") {
    const ScratchFolder folder;
    const std::string file = folder / "bush.lsys";
    write_text(file, "#n = 4;\n#set names letters;\n#set angle 25;\n#set width 0.3;\n#w : A;\n"
                     "#one : A : ~ 0.5 : F[+A][-A]/A;\n#two : A : ~ 0.5 : F[+A]//A;\n");
    const std::vector<std::string> arguments = {file,
                                                "--count",
                                                "30",
                                                "--forest-size",
                                                "30",
                                                "--heroes",
                                                "3",
                                                "--key",
                                                "7",
                                                "--rho",
                                                "0.5",
                                                "--camera",
                                                "eye 14.67,2.6,27.95 target 14.67,2.3,17.95 fov 14",
                                                "--samples",
                                                "1",
                                                "--size",
                                                "320x240"};
    // Make the same forest without lsview.
    view::ViewOptions options = std::get<view::ViewOptions>(view::parse_options(arguments));
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    const Console console({in, out, err, false, nullptr, "lsview"}, options.messages);
    Outcome<std::shared_ptr<view::ForestDocument>> made =
        view::make_forest_document(options, make_project(console, options.run));
    REQUIRE(made);
    const view::ForestDocument& document = *made.value();
    const InstanceCache& cache = *document.model.forms[0].cache;
    std::map<std::uint32_t, std::uint64_t> counts;
    std::map<std::uint32_t, std::uint64_t> trees;
    TreeExpander expander(cache, document.grown.forest.key);
    for (const Tree& tree : document.grown.forest.trees) {
        std::map<std::uint32_t, std::uint64_t> here;
        expander.expand(tree, [&](const BranchInstance& branch) { ++here[branch.instance]; });
        for (const auto& [instance, count] : here) {
            counts[instance] += count;
            ++trees[instance];
        }
    }
    std::size_t branches = 0;
    for (int y = 60; y <= 180; y += 60) {
        for (int x = 60; x <= 260; x += 50) {
            const PickRun pick = picked(arguments, fmt::format("{},{}", x, y));
            CAPTURE(pick.run.err, pick.run.out);
            REQUIRE(pick.run.status == 0);
            REQUIRE_FALSE(pick.lines.empty());
            std::smatch found;
            const std::regex branch("branch (\\d+) of \\d+: id (\\d+), age (\\d+), hero (\\d+)");
            if (!std::regex_match(pick.lines[0], found, branch)) {
                continue;
            }
            ++branches;
            const auto number = static_cast<std::uint32_t>(std::stoul(found[1]));
            const Instance& instance = cache.instances.at(number);
            const InstanceSlot& slot = cache.slots[instance.slot];
            CHECK(found[2] == std::to_string(slot.id));
            CHECK(found[3] == std::to_string(slot.age));
            CHECK(found[4] == std::to_string(instance.hero));
            REQUIRE(pick.lines.size() == 4);
            if (slot.id == 0) {
                CHECK(pick.lines[1] == "from the axiom");
            } else { // the place of the branch's bracket in `one` or `two`
                const std::regex place("from (one at .*bush.lsys:6:2[15]|two at .*bush.lsys:7:21), "
                                       "generation (\\d+)");
                REQUIRE(std::regex_match(pick.lines[1], found, place));
                CHECK(found[2] == std::to_string(slot.age));
            }
            CHECK(pick.lines[2] == fmt::format("it occurs {} time{} in the forest, in {} tree{}",
                                               counts[number], counts[number] == 1 ? "" : "s",
                                               trees[number], trees[number] == 1 ? "" : "s"));
            CHECK(pick.lines[3].find("of `bush`: 4 generations") != std::string::npos);
        }
    }
    CHECK(branches > 3);
    view::Picked branch;
    branch.kind = view::PickedKind::Branch;
    branch.tree = document.grown.forest.trees.front();
    const Outcome<view::Description> described =
        view::describe(branch, {}, document, file, make_project(console, options.run));
    REQUIRE(described);
    CHECK_FALSE(described.value().module); // no module to trace; the hint says why
    CHECK(described.value().hint.find("open its grammar alone") != std::string::npos);
}

TEST_CASE("invalid arguments of --pick and --colours are reported") {
    const auto message_of = [](std::vector<std::string> arguments) {
        const LscRun run = run_lsview(arguments);
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        return run.err;
    };
    const std::string plant = sample("abop-1-24a");
    CHECK(message_of({plant, "--pick", "3,3"}).find("add `--screenshot FILE`") !=
          std::string::npos);
    CHECK(message_of({plant, "--pick", "3", "--screenshot", "a.png"})
              .find("not a pixel of a picture") != std::string::npos);
    CHECK(message_of({plant, "--pick", "32,3", "--size", "32x24", "--screenshot", "a.png"})
              .find("outside of the picture of 32 x 24 pixels") != std::string::npos);
    CHECK(message_of({plant, "--pick", "3,3", "--screenshot", "-"}).find("standard output") !=
          std::string::npos);
    CHECK(message_of({plant, "--why", "back", "--screenshot", "a.png"}).find("add `--pick X,Y`") !=
          std::string::npos);
    CHECK(message_of(
              {plant, "--count", "3", "--why", "back", "--pick", "3,3", "--screenshot", "a.png"})
              .find("show its grammar alone") != std::string::npos);
    CHECK(message_of({plant, "--colours", "id", "--screenshot", "a.png"}).find("`--count 1`") !=
          std::string::npos);
    CHECK(message_of({plant, "--colours", "order", "--count", "3", "--screenshot", "a.png"})
              .find("--colours") != std::string::npos);
}

TEST_CASE("a message beside the picture says that a plant falls") {
    const ScratchFolder folder;
    const std::string file = folder / "stalk.lsys";
    write_text(file, "#n = 1;\n#set width 0.02;\n#w : F(2) +(10) F(4) F(4);\n");
    const auto shown = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {file, "--size", "32x24", "--screenshot",
                                              folder / "a.png"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_lsview(arguments);
    };
    CHECK(shown({}).err.empty());
    const LscRun fallen = shown({"--gravity", "9.81"});
    CHECK(fallen.status == 0);
    CAPTURE(fallen.err);
    CHECK(fallen.err.find("under 9.81 m/s2 [weak-stem]") != std::string::npos);
    CHECK(fallen.err.find("it stands with `#set elasticity") != std::string::npos);
    const LscRun exported =
        run_lsc({"export", file, "-o", folder / "a.obj", "--gravity", "9.81"}, "");
    const auto warning = [](const std::string& text) {
        const std::size_t at = text.find("the plant sinks");
        return at == std::string::npos ? text : text.substr(at, text.find("wrote") - at);
    };
    CHECK(warning(fallen.err).substr(0, 60) == warning(exported.err).substr(0, 60));
}
