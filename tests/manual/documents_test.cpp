// SPDX-License-Identifier: MIT
// Checks docs/documents.md: every feature of the documents has a row, and the commands in the row
// print the output that is shown after them.
#include "tests/manual/commands.h"
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace lsys::tests {

namespace {

constexpr const char* kDocument = "docs/documents.md";

struct DocumentRow {
    std::size_t line = 0; // from 1
    std::string id;
    std::string rating;
    std::string commands; // the last column
};

std::vector<DocumentRow> rows_of(const std::string& document) {
    static const std::regex row(R"(\| ([CSTLU]\d+) \|.*\|[^|]*\| ([^|]*) \| ([^|]*)\|)");
    std::vector<DocumentRow> rows;
    std::istringstream lines(document);
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (std::smatch match; std::regex_match(line, match, row)) {
            rows.push_back({number, match[1], match[2], match[3]});
        }
    }
    return rows;
}

struct ShownCommand {
    std::string command;
    std::string expected; // part of the output; may be empty
};

/// The commands in a table cell. A command is code that begins with `lsc` or `lsview`; code after
/// an arrow is its expected output.
std::vector<ShownCommand> commands_of(const std::string& cell) {
    static const std::regex code("(``.*?``|`[^`]*`)(?: → (``.*?``|`[^`]*`))?");
    const auto text_of = [](std::string span) {
        const std::size_t quotes = span.find_first_not_of('`');
        return span.empty() ? span : span.substr(quotes, span.size() - 2 * quotes);
    };
    std::vector<ShownCommand> commands;
    for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at) {
        const std::string command = text_of((*at)[1]);
        if (command.starts_with("lsc ") || command.starts_with("lsview ")) {
            commands.push_back({command, text_of((*at)[2])});
        }
    }
    return commands;
}

} // namespace

TEST_CASE("the table of the documents has a row for each feature") {
    const std::map<char, std::size_t> counts = {
        {'C', 48}, {'S', 22}, {'T', 49}, {'L', 18}, {'U', 8}};
    const std::set<std::string> later = {"C28", "C45", "C48", "S22", "T46"};
    const std::set<std::string> not_planned = {"S15", "S19"};
    std::map<char, std::size_t> seen;
    for (const DocumentRow& row : rows_of(read_text(source_root() / kDocument))) {
        INFO(kDocument << ":" << row.line);
        CHECK(row.id == row.id[0] + std::to_string(++seen[row.id[0]]));
        if (later.count(row.id) != 0) {
            CHECK(row.rating == "later");
        } else if (not_planned.count(row.id) != 0) {
            CHECK(row.rating == "not planned");
        } else {
            CHECK((row.rating == "works" || row.rating == "works differently"));
        }
    }
    CHECK(seen == counts);
}

TEST_CASE("the commands in the table of the documents print the output stated there") {
    const ScratchFolder folder;
    std::filesystem::create_directory_symlink(source_root() / "samples", folder.path() / "samples");
    const std::string document = read_text(source_root() / kDocument);
    Session session(folder.path());
    for (const Fence& fence : fences_of(document)) {
        for (const SessionStep& step : steps_of(fence.lines)) {
            CHECK(session.run(step).empty()); // the blocks write the grammars of the commands
        }
    }
    std::size_t count = 0;
    for (const DocumentRow& row : rows_of(document)) {
        for (const ShownCommand& shown : commands_of(row.commands)) {
            INFO(kDocument << ":" << row.line << ": " << shown.command);
            const std::vector<std::string> words = words_of(shown.command);
            CHECK(check_options(words).empty());
            if (words[0] != "lsc") { // lsview needs OpenGL, and tests/viewer tests its pictures
                continue;
            }
            const Session::Result result = session.result_of({words.begin() + 1, words.end()});
            const bool fails = result.output.find("error: ") != std::string::npos;
            INFO(result.output.substr(0, 2000));
            CHECK(result.status == (fails ? 1 : 0));
            CHECK(result.output.find(shown.expected) != std::string::npos);
            ++count;
        }
    }
    CHECK(count >= 80);
}

} // namespace lsys::tests
