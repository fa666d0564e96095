// SPDX-License-Identifier: MIT
// Exports plants that move, by `lsc export --frames`: each as one file of every format that holds
// motion, and as a PLY for each frame. Usage: write_motion FOLDER. FOLDER/counts.txt gets a line `NAME
// FRAMES FPS METRES` for each plant. METRES: max vertex error of a reduced skeleton; 0 if every
// segment is a joint. FOLDER/growth gets plants that grow, with a counts.txt of the same columns.
#include "runtime/export/export.h"
#include "tests/support/lsc_run.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;

// No joint is near an angle at which the mesh would get more rings, so all frames have the same
// vertices.
const char* const kTree =
    "#n = 4; #set angle 25; #set spring 30; #object L LEAF; #w : !(0.06) F(1) X;"
    "#p : X : * : !(0.06) F(0.6, 400) [ +(35) X L(0.3) ] /(120) [ &(30) X ] /(120)"
    " [ ^(40) L(0.2) ] F(0.4, 300) { F(0.3) +(100) F(0.3) +(100) F(0.3) };";
const char* const kReed =
    "#n = 40; #set angle 3; #set spring 30; #w : !(0.02) A; #p : A : * : F(0.1, 2) + /(20) A;";

struct Case {
    const char* name;
    const char* grammar;
    std::vector<std::string> options;
    std::vector<std::string> skin_options{"--bones", "all"};
    const char* metres = "0"; // METRES
};

const std::array kCases{
    Case{"tubes", kTree, {"--wind", "2.5,0,1", "--gravity", "1"}},
    Case{"cylinders", kTree, {"--wind", "8,0,3", "--method", "cylinders"}},
    Case{"boxes", kTree, {"--wind", "3,0,3", "--method", "boxes", "--subdivisions", "1"}},
    Case{"settled", kTree, {"--gravity", "4", "--wind", "2.5,0,1,1", "--settle"}},
    Case{"looping", kTree, {"--wind", "2.5,0,1,0.6", "--loop"}},
    Case{"bones", kTree, {"--wind", "2.5,0,1,0.6", "--loop"}, {"--bones", "40"}, "0.06"},
    Case{"bent", kReed, {"--wind", "2.5,0,1,0.6", "--loop"}, {"--bones", "8"}, "0.06"},
    Case{"reed", kReed, {"--wind", "2.5,0,1", "--threads", "1"}},
};
constexpr const char* kFrames = "13";
constexpr const char* kRate = "10";

/// Plants that grow. Their axioms draw something, because a series skips the generations before the
/// first drawing.
const std::array kGrowths{
    Case{"tree", kTree, {"--grow", "-n", "3"}},
    Case{"boxes", kTree, {"--grow", "-n", "2", "--method", "boxes", "--subdivisions", "1"}},
    Case{"carpet", "#n = 3; #w : F; #p : F : * : F [ +(60) F ] F;", {"--grow"}},
};

bool write_file(const Case& motion, const fs::path& path, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"export",   "-",     "-o",    path.string(),
                                       "--frames", kFrames, "--fps", kRate};
    arguments.insert(arguments.end(), motion.options.begin(), motion.options.end());
    arguments.insert(arguments.end(), options.begin(), options.end());
    const LscRun run = run_lsc(arguments, motion.grammar);
    if (run.status != 0) {
        std::fprintf(stderr, "%s: status %d\n%s", path.string().c_str(), run.status,
                     run.err.c_str());
    }
    return run.status == 0;
}

/// Options for formats that store motion. Cases with a reduced skeleton (--bones N) are exported with
/// wind data.
std::vector<std::string> options_for(const Case& motion, const lsys::FormatTraits& traits) {
    std::vector<std::string> options;
    if (traits.motion) {
        options = motion.skin_options;
    }
    if (traits.wind_data && motion.skin_options.back() != "all") {
        options.emplace_back("--wind-data");
    }
    return options;
}

bool write_case(const Case& motion, const fs::path& folder, std::ofstream& counts) {
    for (const lsys::ExportFormat format : lsys::export_formats()) {
        const lsys::FormatTraits& traits = lsys::traits_of(format);
        if (!traits.motion && format != lsys::ExportFormat::Ply) {
            continue;
        }
        if (!write_file(motion, folder / fmt::format("{}.{}", motion.name, traits.name),
                        options_for(motion, traits))) {
            return false;
        }
    }
    for (const char* const compression : {"quantize", "meshopt"}) {
        std::vector<std::string> options =
            options_for(motion, lsys::traits_of(lsys::ExportFormat::Glb));
        options.insert(options.end(), {"--compress", compression});
        if (!write_file(motion, folder / fmt::format("{}.{}.glb", motion.name, compression),
                        options)) {
            return false;
        }
    }
    counts << motion.name << ' ' << kFrames << ' ' << kRate << ' ' << motion.metres << '\n';
    return true;
}

bool write_growth(const Case& growth, const fs::path& folder, std::ofstream& counts) {
    for (const char* const format : {"glb", "gltf", "ply"}) {
        if (!write_file(growth, folder / fmt::format("{}.{}", growth.name, format), {})) {
            return false;
        }
    }
    counts << growth.name << ' ' << kFrames << ' ' << kRate << " 0\n";
    return true;
}

} // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: write_motion FOLDER\n", stderr);
        return 2;
    }
    const fs::path folder = arguments[1];
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream counts(folder / "counts.txt");
    bool fine = true;
    for (const Case& motion : kCases) {
        fine = write_case(motion, folder, counts) && fine;
    }
    fs::create_directories(folder / "growth");
    std::ofstream growth_counts(folder / "growth" / "counts.txt");
    for (const Case& growth : kGrowths) {
        fine = write_growth(growth, folder / "growth", growth_counts) && fine;
    }
    return fine && counts.good() && growth_counts.good() ? 0 : 1;
}
