// SPDX-License-Identifier: MIT
#include "tests/support/lsc_run.h"

#include "grammar/base/paths.h"
#include "runtime/cli/lsc.h"
#include "runtime/platform/process.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace lsys::tests {

namespace fs = std::filesystem;

LscRun run_lsc(const std::vector<std::string>& arguments, const std::string& input) {
    std::istringstream in(input);
    std::ostringstream out;
    std::ostringstream err;
    LscRun run;
    run.status = lsc::run(arguments, {in, out, err});
    run.out = std::move(out).str();
    run.err = std::move(err).str();
    return run;
}

long stated_number(const std::string& stats, const std::string& row) {
    const std::size_t at = ("\n" + stats).find("\n" + row + ' ');
    if (at == std::string::npos) {
        return -1;
    }
    std::string digits;
    for (std::size_t i = at + row.size(); i < stats.size() && stats[i] != '\n'; ++i) {
        if (stats[i] >= '0' && stats[i] <= '9') {
            digits += stats[i];
        }
    }
    return digits.empty() ? -1 : std::stol(digits);
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw std::runtime_error("cannot read " + path_text(path));
    }
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_text(const fs::path& path, std::string_view text) {
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file) {
        throw std::runtime_error("cannot write " + path_text(path));
    }
}

ScratchFolder::ScratchFolder() {
    static std::atomic<int> number{0};
    path_ = fs::temp_directory_path() /
            ("lsc-test-" + std::to_string(platform::process_id()) + "-" + std::to_string(++number));
    fs::remove_all(path_);
    fs::create_directories(path_);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string ScratchFolder::operator/(std::string_view name) const {
    return path_text(path_ / path_of(name));
}

std::size_t ScratchFolder::file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), {}));
}

std::vector<Sample> all_samples() {
    std::vector<fs::path> folders;
    for (const char* const parent : {"/samples", "/samples/species"}) {
        for (const fs::directory_entry& entry :
             fs::directory_iterator(LSYS_SOURCE_DIR + std::string(parent))) {
            folders.push_back(entry.path());
        }
    }
    std::vector<Sample> samples;
    for (const fs::path& folder : folders) {
        const std::string name = path_text(folder.filename());
        Sample sample;
        sample.file = folder / (name + ".lsys");
        if (!fs::exists(sample.file)) {
            continue;
        }
        sample.declares_warnings = name.ends_with("-as-printed");
        std::istringstream lines(read_text(sample.file));
        for (std::string line; std::getline(lines, line) && line.starts_with("//");) {
            std::istringstream words(line.substr(2));
            std::string key;
            words >> key;
            if (key == "run:") {
                std::vector<std::string> run;
                for (std::string word; words >> word;) {
                    run.push_back(word);
                }
                run.insert(run.begin() + (run.empty() ? 0 : 1), path_text(sample.file));
                sample.runs.push_back(std::move(run));
            } else if (key == "counts:") {
                for (std::string word; words >> word; ++sample.counts_size) {
                    sample.counts += word + "\n";
                }
            }
        }
        samples.push_back(std::move(sample));
    }
    std::sort(samples.begin(), samples.end(),
              [](const Sample& a, const Sample& b) { return a.file < b.file; });
    return samples;
}

} // namespace lsys::tests
