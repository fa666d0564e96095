// SPDX-License-Identifier: MIT
// Exports every sample, and every model of samples/dialects except those of Fractint, whose files
// hold several, in every format, by `lsc export`. Usage: write_samples FOLDER.
// FOLDER/counts.txt gets a line `NAME VERTICES TRIANGLES PARTS` for each sample. Plants are exported
// at the last generation with at most kMaxVertices vertices.
#include "runtime/export/export.h"
#include "tests/support/lsc_run.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
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

bool failed(const Sample& sample, const LscRun& run) {
    if (run.status != 0) {
        std::fprintf(stderr, "%s: status %d\n%s", sample.file.string().c_str(), run.status,
                     run.err.c_str());
    }
    return run.status != 0;
}

/// The models of samples/dialects with one system each.
std::vector<Sample> dialect_models() {
    std::vector<Sample> models;
    for (const auto& entry :
         fs::recursive_directory_iterator(LSYS_SOURCE_DIR + std::string("/samples/dialects"))) {
        const fs::path& file = entry.path();
        const std::string folder = file.parent_path().filename().string();
        const fs::path extension = file.extension();
        const bool is_model = entry.is_regular_file() && extension != ".md" && extension != ".v" &&
                              extension != ".func" && extension != ".con" && extension != ".s" &&
                              folder != "fractint";
        if (is_model) {
            models.emplace_back().file = file;
        }
    }
    return models;
}

/// The name of a file without extension; for models of a dialect, with the dialect before it.
std::string name_of(const fs::path& file) {
    const fs::path folder = file.parent_path();
    const bool is_dialect = folder.parent_path().filename() == "dialects";
    return (is_dialect ? folder.filename().string() + "-" : "") + file.stem().string();
}

bool export_sample(const Sample& sample, const fs::path& folder, std::ofstream& counts) {
    const std::string name = name_of(sample.file);
    const auto file = [&](std::string_view extension) {
        return (folder / fmt::format("{}.{}", name, extension)).string();
    };
    const std::string source = sample.file.string();
    LscRun run = run_lsc({"export", source, "-o", file("ply"), "--stats"}, "");
    if (failed(sample, run)) {
        return false;
    }
    long generations = stated_number(run.out, "generations");
    while (stated_number(run.out, "vertices") > kMaxVertices && generations > 1) {
        --generations;
        run = run_lsc(
            {"export", source, "-n", std::to_string(generations), "-o", file("ply"), "--stats"},
            "");
        if (failed(sample, run)) {
            return false;
        }
    }
    const std::string n = std::to_string(generations);
    for (const lsys::ExportFormat format : lsys::export_formats()) {
        const LscRun written =
            run_lsc({"export", source, "-n", n, "-o", file(lsys::traits_of(format).name)}, "");
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
        const LscRun written =
            run_lsc({"export", source, "-n", n, "-o", file(form[0]), form[1], form[2]}, "");
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
    std::vector<Sample> samples = lsys::tests::all_samples();
    bool fine = samples.size() > 40;
    const std::vector<Sample> models = dialect_models();
    fine = models.size() > 30 && fine;
    samples.insert(samples.end(), models.begin(), models.end());
    for (const Sample& sample : samples) {
        fine = export_sample(sample, folder, counts) && fine;
    }
    return fine && counts.good() ? 0 : 1;
}
