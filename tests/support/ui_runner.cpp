// SPDX-License-Identifier: MIT
#include "tests/support/ui_runner.h"

#include "grammar/base/paths.h"
#include "runtime/cli/lsc.h"
#include "runtime/platform/process.h"
#include "tests/support/ui_case.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

namespace lsys::tests {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kCases[] = {".lsys", ".toml"}; // grammars, scenes
constexpr std::string_view kGoldens[] = {".stdout", ".stderr", ".fixed"};

std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const fs::path& path, std::string_view text) {
    std::ofstream file(path, std::ios::binary);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
}

/// A temporary folder, removed by the destructor, which also restores the working directory.
class Scratch {
public:
    Scratch() : before_(fs::current_path()) {
        path_ = fs::temp_directory_path() / ("lsc-ui-" + std::to_string(platform::process_id()));
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        fs::current_path(before_, ignored);
        fs::remove_all(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path before_; // working directory before
    fs::path path_;
};

struct Printed {
    int status = 0;
    std::string out;
    std::string err;
};

Printed run_lsc(const std::vector<std::string>& arguments, const std::string& input) {
    std::istringstream in(input);
    std::ostringstream out;
    std::ostringstream err;
    Printed printed;
    printed.status = lsc::run(arguments, {in, out, err});
    printed.out = out.str();
    printed.err = err.str();
    return printed;
}

/// Runs one case and checks its results.
class CaseRun {
public:
    CaseRun(const UiCase& the_case, const UiOptions& options, UiOutcome& outcome)
        : case_(the_case), options_(options), outcome_(outcome),
          name_(path_text(the_case.file.filename())) {}

    void run() {
        for (const std::string& mistake : case_.mistakes) {
            fail(mistake);
        }
        const Scratch scratch;
        fs::current_path(case_.file.parent_path());
        std::string out;
        std::string err;
        std::vector<UiDiagnostic> diagnostics;
        for (const UiRun& run : case_.runs) {
            const Printed printed = run_once(run, path_text(scratch.path()));
            if (case_.runs.size() > 1) {
                const std::string heading = "$ lsc " + line_of(run) + "\n";
                out += printed.out.empty() ? "" : heading;
                err += printed.err.empty() ? "" : heading;
            }
            out += printed.out;
            err += printed.err;
            for (UiDiagnostic& diagnostic : parse_diagnostics(printed.err)) {
                diagnostics.push_back(std::move(diagnostic));
            }
        }
        check_annotations(diagnostics);
        compare(".stdout", out);
        compare(".stderr", err);
        compare(".fixed", fix(scratch.path()));
    }

    /// Runs a case without annotations; does not check exit status and standard output. The folder
    /// of the run has the files whose names begin with `prefix`.
    void run_listed(const std::string& prefix) {
        const Scratch scratch;
        const fs::path folder = scratch.path() / "case"; // the run may write files
        fs::create_directories(folder);
        for (const fs::directory_entry& entry : fs::directory_iterator(case_.file.parent_path())) {
            if (path_text(entry.path().filename()).starts_with(prefix)) {
                fs::copy(entry.path(), folder);
            }
        }
        fs::current_path(folder);
        ignores_status_ = true;
        const Printed printed = run_once(case_.runs.front(), path_text(scratch.path()));
        compare(".stderr", printed.err);
        compare(".fixed", fix(scratch.path()));
    }

private:
    void fail(const std::string& what) {
        outcome_.failures.push_back(path_text(case_.file.lexically_relative(options_.root)) + ": " +
                                    what);
    }

    static std::string line_of(const UiRun& run) {
        std::string line;
        for (const std::string& word : run.words) {
            line += (line.empty() ? "" : " ") + word;
        }
        return run.input.empty() ? line : line + " < " + run.input;
    }

    /// Replaces the word `%` by the file name of the case, and `%t` by a folder for output.
    std::string expand(std::string word, const std::string& scratch) const {
        replace_all(word, "%t", scratch);
        return word == "%" ? name_ : word;
    }

    Printed run_once(const UiRun& run, const std::string& scratch) {
        std::vector<std::string> arguments;
        bool names_the_case = !run.input.empty();
        for (const std::string& word : run.words) {
            names_the_case = names_the_case || word.find('%') != std::string::npos;
            if (word != "%-") {
                arguments.push_back(expand(word, scratch));
            }
        }
        if (!names_the_case) {
            arguments.push_back(name_);
        }
        Printed printed =
            run_lsc(arguments, run.input.empty() ? "" : read_file(expand(run.input, scratch)));
        replace_all(printed.out, scratch, "%t");
        replace_all(printed.err, scratch, "%t");
        if (printed.status != run.exit_status && !ignores_status_) {
            fail("`lsc " + line_of(run) + "` ended with status " + std::to_string(printed.status) +
                 ", not " + std::to_string(run.exit_status) + "\n" + printed.err);
        }
        return printed;
    }

    void check_annotations(const std::vector<UiDiagnostic>& diagnostics) {
        std::vector<bool> met(case_.annotations.size(), false);
        for (const UiDiagnostic& diagnostic : diagnostics) {
            bool expected = false;
            for (std::size_t i = 0; i < met.size(); ++i) {
                if (matches(case_.annotations[i], diagnostic, name_)) {
                    met[i] = true;
                    expected = true;
                }
            }
            if (!expected) {
                fail("not annotated: line " + std::to_string(diagnostic.line) + " " +
                     diagnostic.severity + ": " + diagnostic.message + " [" + diagnostic.code +
                     "]");
            }
        }
        for (std::size_t i = 0; i < met.size(); ++i) {
            const UiAnnotation& annotation = case_.annotations[i];
            outcome_.codes.insert(annotation.code);
            if (!met[i]) {
                fail("annotation of line " + std::to_string(annotation.written_at) +
                     " is not met: " + annotation.severity + ": " + annotation.text + " [" +
                     annotation.code + "]");
            }
        }
    }

    /// The text of the case after `check --fix` on a copy; empty if it is unchanged, or if the
    /// first run is not `check`. Checks that no certain fix is left.
    std::string fix(const fs::path& scratch) {
        if (case_.runs.empty() || case_.runs.front().words.empty() ||
            case_.runs.front().words.front() != "check") {
            return {};
        }
        const fs::path folder = scratch / "fix";
        const fs::path parts = case_.file.parent_path() / "parts";
        fs::create_directories(folder);
        if (fs::exists(parts)) {
            fs::copy(parts, folder / "parts",
                     fs::copy_options::recursive | fs::copy_options::copy_symlinks);
        }
        const std::string before = read_file(case_.file);
        write_file(folder / name_, before);
        fs::current_path(folder);
        static_cast<void>(run_lsc({"check", "--fix", "--quiet", name_}, ""));
        const std::string after = read_file(folder / name_);
        if (after == before) {
            return {};
        }
        const Printed left = run_lsc({"check", "--message-format", "json", name_}, "");
        std::istringstream lines(left.err);
        for (std::string line; std::getline(lines, line);) {
            const nlohmann::json object = nlohmann::json::parse(line, nullptr, false);
            if (!object.is_object() || !object.contains("fixes")) {
                continue;
            }
            for (const nlohmann::json& one : object["fixes"]) {
                if (one["machine_applicable"] == true) {
                    fail("after --fix there is still a fix: " + line);
                }
            }
        }
        return after;
    }

    void compare(std::string_view extension, const std::string& actual) {
        fs::path golden = case_.file;
        golden.replace_extension(extension);
        const std::string expected = read_file(golden);
        if (actual == expected && fs::exists(golden) != actual.empty()) {
            return;
        }
        if (options_.bless) {
            if (actual.empty()) {
                fs::remove(golden);
            } else {
                write_file(golden, actual);
            }
            outcome_.blessed.push_back(path_text(golden.lexically_relative(options_.root)));
            return;
        }
        fail("differs from " + path_text(golden.filename()) + "\n--- expected\n" + expected +
             "--- actual\n" + actual + "---");
    }

    const UiCase& case_;
    const UiOptions& options_;
    UiOutcome& outcome_;
    std::string name_;
    bool ignores_status_ = false;
};

/// Reports golden files without a case.
void check_strays(const fs::path& feature, const UiOptions& options, UiOutcome& outcome) {
    for (const fs::directory_entry& entry : fs::directory_iterator(feature)) {
        const std::string extension = path_text(entry.path().extension());
        if (std::find(std::begin(kGoldens), std::end(kGoldens), extension) == std::end(kGoldens)) {
            continue;
        }
        const auto owned_by = [&](std::string_view kind) {
            fs::path owner = entry.path();
            owner.replace_extension(kind);
            return fs::exists(owner);
        };
        if (std::none_of(std::begin(kCases), std::end(kCases), owned_by)) {
            outcome.failures.push_back(path_text(entry.path().lexically_relative(options.root)) +
                                       ": no case owns this file");
        }
    }
}

bool passes(const std::string& name, const std::vector<std::string>& filters) {
    return filters.empty() ||
           std::any_of(filters.begin(), filters.end(), [&](const std::string& filter) {
               return name.find(filter) != std::string::npos;
           });
}

} // namespace

UiOutcome run_listed_cases(const std::vector<ListedCase>& cases, const UiOptions& options) {
    UiOutcome outcome;
    for (const ListedCase& listed : cases) {
        UiCase the_case;
        the_case.file = listed.file;
        the_case.runs.push_back({listed.words, "", 0});
        CaseRun(the_case, options, outcome).run_listed(listed.name);
        ++outcome.case_count;
    }
    return outcome;
}

UiOutcome run_ui_cases(const UiOptions& options) {
    UiOutcome outcome;
    std::vector<fs::path> features;
    for (const fs::directory_entry& entry : fs::directory_iterator(options.root)) {
        if (entry.is_directory()) {
            features.push_back(entry.path());
        }
    }
    std::sort(features.begin(), features.end());
    for (const fs::path& feature : features) {
        std::vector<fs::path> files;
        for (const fs::directory_entry& entry : fs::directory_iterator(feature)) {
            const std::string name = path_text(entry.path().lexically_relative(options.root));
            const bool is_case = std::find(std::begin(kCases), std::end(kCases),
                                           path_text(entry.path().extension())) != std::end(kCases);
            if (is_case && passes(name, options.filters)) {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) {
            if (options.verbose) {
                std::printf("%s\n", path_text(file.lexically_relative(options.root)).c_str());
                std::fflush(stdout);
            }
            const UiCase the_case = parse_ui_case(file, read_file(file));
#ifdef _WIN32
            if (the_case.needs_posix) {
                continue;
            }
#endif
            CaseRun(the_case, options, outcome).run();
            ++outcome.case_count;
        }
        if (!files.empty()) {
            check_strays(feature, options, outcome);
        }
    }
    return outcome;
}

} // namespace lsys::tests
