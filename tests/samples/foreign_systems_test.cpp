// SPDX-License-Identifier: MIT
// Grammars of other programs: the imported grammar derives the same word as the original.
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::ScratchFolder;

struct Foreign {
    std::string file;   // in samples/dialects
    std::string system; // name of the system; empty if the file has only one
    std::string generations;
    std::string count; // number of modules after the generations; empty if random
};

std::vector<Foreign> foreign_samples() {
    return {
        {"abop/rowan.ls", "", "6", ""},
        {"abop/signal.txt", "", "12", ""},
        {"fractint/curves.l", "Snowflake", "4", "1792"},
        {"fractint/curves.l", "Dragon", "8", "1022"},
        {"fractint/curves.l", "ColourBush", "3", "1685"},
        {"fractint/curves.l", "Squares", "3", "232"},
        {"fractint/curves.l", "Star", "3", "464"},
        {"houdini/tree.hlsys", "", "5", ""},
        {"houdini/signal.hlsys", "", "6", ""},
        {"houdini/figure.hlsys", "", "3", "190"},
        {"sys/figure.sys", "", "3", "190"},
        {"sys/poplar.sys", "", "9", ""},
        {"carey/umbel.rules", "", "8", ""},
        {"cpfg/figure.l", "", "3", "190"},
        {"cpfg/fern.l", "", "14", "179"},
        {"cpfg/shower.l", "", "9", ""},
        {"lpy/umbel.lpy", "", "12", ""},
        {"lparser/fern.ls", "", "8", ""},
        {"l3d/larch.l3d", "", "6", "1147"},
        {"l3d/rose.l++", "", "5", ""},
    };
}

std::vector<std::string> with_system(std::vector<std::string> arguments, const Foreign& foreign) {
    if (!foreign.system.empty()) {
        arguments.insert(arguments.end(), {"--system", foreign.system});
    }
    return arguments;
}

} // namespace

TEST_CASE("the .sys figure is one program in every syntax") {
    // The dump of a program without the names of its turtle, symbols and productions.
    using Names = std::vector<std::pair<std::string, std::string>>;
    const auto program_of = [](const std::string& name, const std::string& text,
                               const Names& names) {
        const ScratchFolder scratch;
        lsys::tests::write_text(scratch / name, text);
        LscRun run = run_lsc({"dump", "--stage", "program", "-n", "3", scratch / name}, "");
        CHECK(run.status == 0);
        for (const auto& [from, to] : names) {
            for (std::size_t at = run.out.find(from); at != std::string::npos;
                 at = run.out.find(from, at)) {
                run.out.replace(at, from.size(), to);
            }
        }
        return run.out;
    };
    const std::string of_sys = program_of(
        "f.sys", "LSYSTEM\n1\nF\nF F[>F][<F]F 1\n",
        {{"turtle sys", "turtle"}, {"tapered-forward", "forward"}, {"`>`", "-"}, {"`<`", "+"}});
    CHECK(of_sys.find("F : * : F [ - F ] [ + F ] F") != std::string::npos);
    CHECK(of_sys == program_of("f.lsys",
                               "#set names letters;\n#w : F;\n"
                               "#r1 : F : * : F[-F][+F]F;\n",
                               {{"turtle lsys", "turtle"}}));
    CHECK(of_sys == program_of("f.hlsys", "F\nF=F[-F][+F]F\n", {{"turtle sidefx", "turtle"}}));
    // The + of cpfg turns left, its widths are pixels, and its files give the number of generations.
    CHECK(of_sys == program_of("f.l",
                               "Lsystem: 1\nderivation length: 3\nAxiom: F\n"
                               "F --> F[+F][-F]F\nendlsystem\n",
                               {{"turtle cpfg", "turtle"},
                                {"width 1,", "width 0.1,"},
                                {"  width_unit pixels\n", ""},
                                {"generations 3\n", ""},
                                {"p1", "r1"},
                                {" + ", " ~ "},
                                {" - ", " + "},
                                {" ~ ", " - "}}));
}

TEST_CASE("an imported grammar derives the word of the original") {
    const std::string folder = LSYS_SOURCE_DIR "/samples/dialects/";
    for (const Foreign& foreign : foreign_samples()) {
        const std::string file = folder + foreign.file;
        INFO(foreign.file << " " << foreign.system);
        const ScratchFolder scratch;
        const LscRun imported = run_lsc(with_system({"import", file, "-n", foreign.generations,
                                                     "-o", scratch / "imported.lsys"},
                                                    foreign),
                                        "");
        CHECK(imported.status == 0);
        CHECK(imported.err.empty());
        for (const char* const stage : {"word", "skeleton"}) {
            const std::vector<std::string> dump{"dump", "-n", foreign.generations, "--stage",
                                                stage};
            std::vector<std::string> original = dump;
            original.push_back(file);
            std::vector<std::string> copy = dump;
            copy.push_back(scratch / "imported.lsys");
            const LscRun first = run_lsc(with_system(original, foreign), "");
            const LscRun second = run_lsc(copy, "");
            CHECK(first.status == 0);
            CHECK(!first.out.empty());
            CHECK(first.out == second.out);
        }
        const LscRun counted =
            run_lsc(with_system({"dump", file, "-n", foreign.generations, "--count"}, foreign), "");
        if (!foreign.count.empty()) {
            CHECK(counted.out == foreign.count + "\n");
        }
    }
}
