// SPDX-License-Identifier: MIT
#include "runtime/cli/explanations.h"

namespace lsys::lsc {

namespace {

constexpr std::string_view kHeading = "## ";
constexpr std::string_view kFence = "```";
constexpr std::string_view kRun = "run: ";
constexpr std::string_view kFile = "file: ";

/// Removes the first line of `text` and returns it without its line end.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

/// Parses the lines of a fenced block up to its closing fence into the files of `example`.
void parse_example(std::string_view& text, Example& example) {
    example.files.emplace_back("example.lsys", std::string());
    bool is_first = true;
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        if (line == kFence) {
            return;
        }
        if (is_first && line.starts_with(kRun)) {
            example.arguments = line.substr(kRun.size());
        } else if (line.starts_with(kFile)) {
            example.files.emplace_back(line.substr(kFile.size()), std::string());
        } else {
            example.files.back().second += line;
            example.files.back().second += '\n';
        }
        is_first = false;
    }
}

void trim_blank_lines(std::string& text) {
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    text.erase(0, text.find_first_not_of('\n'));
}

} // namespace

std::vector<Explanation> parse_explanations(std::string_view markdown) {
    std::vector<Explanation> all;
    while (!markdown.empty()) {
        const std::string_view line = take_line(markdown);
        if (line.starts_with(kHeading)) {
            all.push_back({std::string(line.substr(kHeading.size())), {}, {}});
        } else if (all.empty()) {
            continue; // text before the first explanation
        } else if (line.starts_with(kFence)) {
            Example example;
            example.is_correct = line.find(" right") != std::string_view::npos;
            example.is_sketch = line.ends_with(" sketch");
            parse_example(markdown, example);
            all.back().examples.push_back(std::move(example));
        } else {
            all.back().text += line;
            all.back().text += '\n';
        }
    }
    for (Explanation& explanation : all) {
        trim_blank_lines(explanation.text);
    }
    return all;
}

} // namespace lsys::lsc
