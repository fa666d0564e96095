// SPDX-License-Identifier: MIT
// tests_mistakes [--bless] [FILTER...]: runs the mistakes of mistakes.tsv and compares the messages
// with the golden files beside them. tests_mistakes --grades: checks the means of grades.tsv against
// the floors of floors.tsv.
#include "tests/support/ui_case.h"
#include "tests/support/ui_runner.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

/// Mean grade that the mistakes of each persona should reach.
constexpr double kGoal = 2.7;

/// The rows of a table, whose columns are separated by tabs.
std::vector<Row> read_table(const fs::path& path) {
    std::vector<Row> rows;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        Row row;
        std::istringstream columns(line);
        for (std::string column; std::getline(columns, column, '\t');) {
            row.push_back(column);
        }
        if (!row.empty()) {
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

std::string persona_of(const std::string& name) {
    return name.substr(0, name.rfind('-'));
}

/// The mistakes whose name begins with one of the filters; all mistakes if there are no filters.
std::vector<lsys::tests::ListedCase> read_cases(const lsys::tests::UiOptions& options) {
    std::vector<lsys::tests::ListedCase> cases;
    for (const Row& row : read_table(options.root / "mistakes.tsv")) {
        const bool passes =
            options.filters.empty() ||
            std::any_of(options.filters.begin(), options.filters.end(),
                        [&](const std::string& filter) { return row[0].find(filter) == 0; });
        if (!passes || row.size() < 2) {
            continue;
        }
        lsys::tests::ListedCase listed;
        for (const std::string& word : lsys::tests::split_words(row[1])) {
            if (word != "lsc") {
                listed.words.push_back(word);
            }
        }
        const auto file =
            std::find_if(listed.words.begin(), listed.words.end(), [&](const std::string& word) {
                return word.starts_with(row[0]) && fs::exists(options.root / word);
            });
        if (file == listed.words.end()) {
            std::printf("FAILED %s: its command names no file of it\n", row[0].c_str());
            continue;
        }
        listed.file = options.root / *file;
        listed.name = row[0];
        *file = "%";
        cases.push_back(std::move(listed));
    }
    return cases;
}

struct Mean {
    std::size_t count = 0;
    double sum = 0.0;
    [[nodiscard]] double value() const { return sum / static_cast<double>(count); }
};

/// Returns the exit status: 0 if the grades reach the floors, each mistake has a grade, and the
/// floor is 2.7 for each persona whose mean has reached 2.7.
int check_grades(const fs::path& root) {
    int failures = 0;
    const auto fail = [&](const std::string& what) {
        std::printf("FAILED %s\n", what.c_str());
        ++failures;
    };
    std::map<std::string, Mean> means;
    std::set<std::string> graded;
    for (const Row& row : read_table(root / "grades.tsv")) {
        if (row.size() < 3 || row[1].find_first_not_of("0123") != std::string::npos) {
            fail("grades.tsv: no grade of `" + row[0] + "`");
            continue;
        }
        Mean& mean = means[persona_of(row[0])];
        ++mean.count;
        mean.sum += std::stod(row[1]);
        graded.insert(row[0]);
    }
    for (const Row& row : read_table(root / "mistakes.tsv")) {
        if (!graded.contains(row[0])) {
            fail("grades.tsv: no grade of `" + row[0] + "`");
        }
    }
    std::map<std::string, double> floors;
    for (const Row& row : read_table(root / "floors.tsv")) {
        floors[row[0]] = row.size() > 1 ? std::stod(row[1]) : kGoal;
    }
    constexpr double kRounding = 0.005; // floors have two decimals
    for (const auto& [persona, mean] : means) {
        std::printf("%-10s %.2f of 3, %zu mistakes\n", persona.c_str(), mean.value(), mean.count);
        if (!floors.contains(persona)) {
            fail("floors.tsv: no floor of " + persona);
        } else if (mean.value() < floors[persona] - kRounding) {
            fail(persona + ": the mean is below its floor of " + std::to_string(floors[persona]));
        } else if (mean.value() >= kGoal && floors[persona] < kGoal) {
            fail(persona + ": the mean has reached 2.7, which is its floor from now on");
        }
    }
    return failures == 0 && !means.empty() ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    lsys::tests::UiOptions options;
    options.root = LSYS_SOURCE_DIR "/tests/mistakes";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--bless") {
            options.bless = true;
        } else if (word == "--grades") {
            return check_grades(options.root);
        } else {
            options.filters.push_back(word);
        }
    }
    const lsys::tests::UiOutcome outcome =
        lsys::tests::run_listed_cases(read_cases(options), options);
    for (const std::string& file : outcome.blessed) {
        std::printf("blessed %s\n", file.c_str());
    }
    for (const std::string& failure : outcome.failures) {
        std::printf("FAILED %s\n", failure.c_str());
    }
    std::printf("%zu mistakes, %zu failures\n", outcome.case_count, outcome.failures.size());
    return outcome.failures.empty() && outcome.case_count > 0 ? 0 : 1;
}
