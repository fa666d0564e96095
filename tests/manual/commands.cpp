// SPDX-License-Identifier: MIT
#include "tests/manual/commands.h"

#include "runtime/cli/command_line.h"
#include "runtime/cli/lsc.h"
#include "tests/support/lsc_run.h"

#ifdef LSYS_WITH_LSVIEW
#include "viewer/app/options.h"
#endif

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

namespace lsys::tests {

namespace {

constexpr std::string_view kPrompt = "$ ";

std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        text += line + '\n';
    }
    return text;
}

std::string usage_message(const UsageError* error) {
    return error == nullptr ? std::string() : error->message;
}

} // namespace

std::vector<std::string> words_of(std::string_view command) {
    std::vector<std::string> words;
    bool in_word = false;
    char quote = '\0';
    for (const char c : command) {
        if (quote != '\0') {
            if (c == quote) {
                quote = '\0';
            } else {
                words.back() += c;
            }
            continue;
        }
        if (c == ' ') {
            in_word = false;
            continue;
        }
        if (!in_word) {
            if (c == '#') {
                break;
            }
            words.emplace_back();
            in_word = true;
        }
        if (c == '\'' || c == '"') {
            quote = c;
        } else {
            words.back() += c;
        }
    }
    return words;
}

std::vector<SessionStep> steps_of(const std::vector<std::string>& lines) {
    std::vector<SessionStep> steps;
    bool goes_on = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (goes_on) {
            steps.back().command += line;
        } else if (line.starts_with(kPrompt)) {
            steps.push_back({i, line.substr(kPrompt.size()), {}});
        } else if (!steps.empty()) {
            steps.back().output.push_back(line);
            continue;
        } else {
            continue;
        }
        goes_on = steps.back().command.ends_with('\\');
        if (goes_on) {
            steps.back().command.pop_back();
        }
    }
    return steps;
}

bool matches_output(const std::vector<std::string>& expected,
                    const std::vector<std::string>& output) {
    // reached[k]: whether the lines of `expected` so far match the first k lines of the output.
    std::vector<bool> reached(output.size() + 1);
    reached[0] = true;
    for (const std::string& line : expected) {
        std::vector<bool> next(output.size() + 1);
        for (std::size_t k = 0; k <= output.size(); ++k) {
            if (line == "...") {
                next[k] = reached[k] || (k > 0 && next[k - 1]);
            } else {
                next[k] = k > 0 && reached[k - 1] && output[k - 1] == line;
            }
        }
        reached = std::move(next);
    }
    return reached.back();
}

std::string check_options(const std::vector<std::string>& words) {
    if (words.empty()) {
        return {};
    }
    const std::vector<std::string> arguments(words.begin() + 1, words.end());
    if (words[0] == "lsc") {
        const lsc::CommandLine line = lsc::parse_command_line(arguments);
        return usage_message(std::get_if<UsageError>(&line));
    }
#ifdef LSYS_WITH_LSVIEW
    if (words[0] == "lsview") {
        const view::ParsedOptions options = view::parse_options(arguments);
        return usage_message(std::get_if<UsageError>(&options));
    }
#endif
    return {};
}

Session::Session(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::string Session::run(const SessionStep& step) {
    const std::vector<std::string> words = words_of(step.command);
    const std::string command = "$ " + step.command + "\n";
    if (words.empty()) {
        return command + "there is no command";
    }
    if (words[0] == "echo" && words.size() == 2 && words[1] == "$?") {
        const std::vector<std::string> status{std::to_string(std::exchange(status_, 0))};
        return step.output == status ? "" : command + "the exit status is " + status[0];
    }
    if (std::string left = finish(); !left.empty()) {
        return left;
    }
    last_ = command;
    if (words[0] == "cat" && words.size() == 2) {
        return show_file(step, words[1]);
    }
    if (words[0] == "lsc") {
        return run_lsc(step, {words.begin() + 1, words.end()});
    }
    if (words[0] == "lsview") { // lsview needs OpenGL, and tests/viewer tests its pictures
        const std::string wrong = check_options(words);
        return wrong.empty() ? "" : command + wrong;
    }
    return command + "the test runs lsc, lsview, `cat FILE` and `echo $?` only";
}

std::string Session::finish() const {
    return status_ == 0 ? ""
                        : last_ + "the exit status is " + std::to_string(status_) +
                              "; show it by `$ echo $?`";
}

/// Runs `cat`. Writes the file if it is missing; an existing file must have the text that is shown.
std::string Session::show_file(const SessionStep& step, const std::string& name) const {
    const std::filesystem::path path = folder_ / name;
    if (!std::filesystem::exists(path)) {
        std::filesystem::create_directories(path.parent_path());
        write_text(path, joined(step.output));
        return {};
    }
    const std::string text = read_text(path);
    return matches_output(step.output, split_lines(text)) ? "" : last_ + "the file holds\n" + text;
}

std::string Session::run_lsc(const SessionStep& step, const std::vector<std::string>& arguments) {
    const Result result = result_of(arguments);
    status_ = result.status;
    return matches_output(step.output, split_lines(result.output))
               ? ""
               : last_ + "prints\n" + result.output;
}

Session::Result Session::result_of(const std::vector<std::string>& arguments) const {
    std::istringstream in;
    std::ostringstream terminal;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
    const int status = lsc::run(arguments, {in, terminal, terminal});
    std::filesystem::current_path(before);
    return {status, terminal.str()};
}

} // namespace lsys::tests
