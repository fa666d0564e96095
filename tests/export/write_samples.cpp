// SPDX-License-Identifier: MIT
// Exports every sample, and every model of samples/dialects, in every format, by `lsc export`.
// Usage: write_samples FOLDER.
// FOLDER/counts.txt gets a line `NAME VERTICES TRIANGLES PARTS` for each sample. Plants are exported
// at the last generation with at most kMaxVertices vertices.
#include "runtime/export/export.h"
#include "tests/support/lsc_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using lsys::tests::LscRun;
using lsys::tests::run_lsc;
using lsys::tests::Sample;
using lsys::tests::stated_number;

constexpr long kMaxVertices = 20000;

long occurrences(const std::string& text, const std::string& part) {
    long count = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) {
        ++count;
    }
    return count;
}

/// A sample, or a system of a file that holds several.
struct Model {
    Sample sample;
    std::string name;              // of the exported files
    std::vector<std::string> args; // --system NAME
};

bool failed(const Sample& sample, const LscRun& run) {
    if (run.status != 0) {
        std::fprintf(stderr, "%s: status %d\n%s", sample.file.string().c_str(), run.status,
                     run.err.c_str());
    }
    return run.status != 0;
}

/// The systems of a file of Fractint: the names before `{`.
std::vector<Model> fractint_systems(const fs::path& file) {
    std::vector<Model> systems;
    std::istringstream lines(lsys::tests::read_text(file.string()));
    for (std::string line; std::getline(lines, line);) {
        const std::string name = line.substr(0, line.find(' '));
        if (line[0] != ';' && line.find('{') != std::string::npos) {
            systems.push_back({{file, {}, "", 0, false}, "fractint-" + name, {"--system", name}});
        }
    }
    return systems;
}

/// The models of samples/dialects.
std::vector<Model> dialect_models() {
    constexpr std::array<std::string_view, 8> kOther = {".md", ".v",   ".func", ".con",
                                                        ".s",  ".rgb", ".tga",  ".map"};
    std::vector<Model> models;
    for (const auto& entry :
         fs::recursive_directory_iterator(LSYS_SOURCE_DIR + std::string("/samples/dialects"))) {
        const fs::path& file = entry.path();
        const std::string folder = file.parent_path().filename().string();
        const std::string extension = file.extension().string();
        if (!entry.is_regular_file() || std::ranges::find(kOther, extension) != kOther.end()) {
            continue;
        }
        if (folder == "fractint") {
            const std::vector<Model> systems = fractint_systems(file);
            models.insert(models.end(), systems.begin(), systems.end());
        } else {
            models.push_back({{file, {}, "", 0, false}, folder + "-" + file.stem().string(), {}});
        }
    }
    return models;
}

bool export_model(const Model& model, const fs::path& folder, std::ofstream& counts) {
    const Sample& sample = model.sample;
    const std::string& name = model.name;
    const auto run_export = [&](std::vector<std::string> args) {
        args.insert(args.begin(), {"export", sample.file.string()});
        args.insert(args.end(), model.args.begin(), model.args.end());
        return run_lsc(args, "");
    };
    const auto file = [&](std::string_view extension) {
        return (folder / fmt::format("{}.{}", name, extension)).string();
    };
    std::vector<std::string> first{"-o", file("ply"), "--stats"};
    if (!model.args.empty()) { // Fractint states no number of generations
        first.insert(first.end(), {"-n", "4"});
    }
    LscRun run = run_export(first);
    if (failed(sample, run)) {
        return false;
    }
    long generations = stated_number(run.out, "generations");
    while (stated_number(run.out, "vertices") > kMaxVertices && generations > 1) {
        --generations;
        run = run_export({"-n", std::to_string(generations), "-o", file("ply"), "--stats"});
        if (failed(sample, run)) {
            return false;
        }
    }
    const std::string n = std::to_string(generations);
    for (const lsys::ExportFormat format : lsys::export_formats()) {
        const LscRun written = run_export({"-n", n, "-o", file(lsys::traits_of(format).name)});
        if (failed(sample, written)) {
            return false;
        }
    }
    for (const std::vector<std::string>& form :
         std::vector<std::vector<std::string>>{{"separate.gltf", "--buffers", "separate"},
                                               {"quantize.glb", "--compress", "quantize"},
                                               {"quantize.gltf", "--compress", "quantize"},
                                               {"meshopt.glb", "--compress", "meshopt"},
                                               {"meshopt.gltf", "--compress", "meshopt"}}) {
        const LscRun written = run_export({"-n", n, "-o", file(form[0]), form[1], form[2]});
        if (failed(sample, written)) {
            return false;
        }
    }
    counts << name << ' ' << stated_number(run.out, "vertices") << ' '
           << stated_number(run.out, "triangles") << ' '
           << occurrences(lsys::tests::read_text(file("obj")), "\nusemtl ") << '\n';
    return true;
}

} // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: write_samples FOLDER\n", stderr);
        return 2;
    }
    const fs::path folder = arguments[1];
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream counts(folder / "counts.txt");
    std::vector<Model> models;
    for (const Sample& sample : lsys::tests::all_samples()) {
        models.push_back({sample, sample.file.stem().string(), {}});
    }
    bool fine = models.size() > 40;
    const std::vector<Model> others = dialect_models();
    fine = others.size() > 70 && fine;
    models.insert(models.end(), others.begin(), others.end());
    for (const Model& model : models) {
        fine = export_model(model, folder, counts) && fine;
    }
    return fine && counts.good() ? 0 : 1;
}
