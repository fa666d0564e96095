// SPDX-License-Identifier: MIT
#include "tests/support/ui_case.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <optional>

namespace lsys::tests {

namespace {

constexpr std::string_view kRun = " run: ";
constexpr std::string_view kExit = " exit: ";
constexpr std::string_view kSystem = " system: ";
constexpr std::string_view kSeverities[] = {"error", "warning", "note"};

std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) {
        text.remove_suffix(1);
    }
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
        text.remove_prefix(1);
    }
    return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// Removes `[code]` from the end of `text`; returns the code.
std::string take_code(std::string_view& text) {
    const std::size_t open = text.rfind('[');
    if (!text.ends_with(']') || open == std::string_view::npos) {
        return {};
    }
    const std::string_view code = text.substr(open + 1, text.size() - open - 2);
    const bool is_code = !code.empty() && std::all_of(code.begin(), code.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    });
    if (!is_code) {
        return {};
    }
    text = trim(text.substr(0, open));
    return std::string(code);
}

void add_run(std::string_view line, UiCase& found) {
    UiRun run;
    run.words = split_words(line.substr(kRun.size()));
    const auto input = std::find(run.words.begin(), run.words.end(), "<");
    if (input != run.words.end() && input + 1 != run.words.end()) {
        run.input = *(input + 1);
        run.words.erase(input, input + 2);
    }
    found.runs.push_back(std::move(run));
}

void add_header(std::string_view line, UiCase& found) {
    if (line.starts_with(kRun)) {
        add_run(line, found);
    } else if (line.starts_with(kExit)) {
        if (found.runs.empty() ||
            !parse_number(trim(line.substr(kExit.size())), found.runs.back().exit_status)) {
            found.mistakes.emplace_back("`exit:` wants a number and a `run:` before it");
        }
    } else if (line.starts_with(kSystem)) {
        found.needs_posix = trim(line.substr(kSystem.size())) == "posix";
        if (!found.needs_posix) {
            found.mistakes.emplace_back("`system:` wants `posix`");
        }
    }
}

/// Adds the annotation in `text`, which begins after `//~` or `/*~`, to `found`.
void add_annotation(std::string_view text, std::uint32_t line, UiCase& found) {
    UiAnnotation annotation;
    annotation.written_at = line;
    annotation.line = line;
    while (!text.empty() && (text[0] == '^' || text[0] == 'v' || text[0] == '?')) {
        if (text[0] == '^') {
            --annotation.line;
        } else if (text[0] == 'v') {
            ++annotation.line;
        } else {
            annotation.line = 0;
        }
        text.remove_prefix(1);
    }
    text = trim(text);
    for (const std::string_view severity : kSeverities) {
        if (text.starts_with(severity) && text.substr(severity.size()).starts_with(":")) {
            annotation.severity = severity;
            text = trim(text.substr(severity.size() + 1));
            annotation.code = take_code(text);
            annotation.text = text;
            found.annotations.push_back(std::move(annotation));
            return;
        }
    }
    found.mistakes.push_back("line " + std::to_string(line) +
                             ": an annotation begins with error:, warning: or note:");
}

void add_annotations(std::string_view line,
                     std::string_view comment,
                     std::uint32_t number,
                     UiCase& found) {
    const std::string mark = std::string(comment) + "~";
    for (std::size_t at = 0; at + mark.size() <= line.size(); ++at) {
        const std::string_view opening = line.substr(at, 3);
        if (opening == "/*~") {
            const std::string_view rest = line.substr(at + 3);
            add_annotation(rest.substr(0, rest.find("*/")), number, found);
        } else if (line.substr(at).starts_with(mark)) {
            add_annotation(line.substr(at + mark.size()), number, found);
            return;
        }
    }
}

/// Parses `file:line:col: severity: text [code]` or `lsc: severity: text [code]`.
std::optional<UiDiagnostic> parse_head(std::string_view line) {
    for (const std::string_view severity : kSeverities) {
        const std::string mark = ": " + std::string(severity) + ": ";
        const std::size_t at = line.find(mark);
        if (at == std::string_view::npos) {
            continue;
        }
        UiDiagnostic diagnostic;
        diagnostic.severity = severity;
        std::string_view text = line.substr(at + mark.size());
        diagnostic.code = take_code(text);
        diagnostic.message = text;
        std::string_view place = line.substr(0, at);
        if (place != "lsc") {
            const std::size_t column = place.rfind(':');
            const std::size_t row =
                column == std::string_view::npos ? column : place.rfind(':', column - 1);
            if (row == std::string_view::npos || row == 0 ||
                !parse_number(place.substr(row + 1, column - row - 1), diagnostic.line)) {
                continue;
            }
            diagnostic.file = place.substr(0, row);
        }
        if (!diagnostic.code.empty()) {
            return diagnostic;
        }
    }
    return std::nullopt;
}

std::optional<UiDiagnostic> parse_object(std::string_view line) {
    const nlohmann::json object = nlohmann::json::parse(line, nullptr, false);
    if (!object.is_object() || !object.contains("code")) {
        return std::nullopt;
    }
    UiDiagnostic diagnostic;
    diagnostic.file = object.value("file", "");
    diagnostic.line = object.value("line", 0U);
    diagnostic.severity = object.value("severity", "");
    diagnostic.message = object.value("message", "");
    diagnostic.code = object.value("code", "");
    return diagnostic;
}

} // namespace

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> words;
    bool in_word = false;
    bool in_quotes = false;
    for (const char c : trim(text)) {
        if (c == '\'') {
            in_quotes = !in_quotes;
            if (!in_word) {
                words.emplace_back();
                in_word = true;
            }
        } else if (c == ' ' && !in_quotes) {
            in_word = false;
        } else {
            if (!in_word) {
                words.emplace_back();
                in_word = true;
            }
            words.back() += c;
        }
    }
    return words;
}

UiCase parse_ui_case(const std::filesystem::path& file, std::string_view text) {
    UiCase found;
    found.file = file;
    const std::string_view comment = file.extension() == ".toml" ? "#" : "//";
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.remove_prefix(3);
    }
    bool in_header = true;
    std::uint32_t number = 0;
    for (const std::string_view line : split_lines(text)) {
        ++number;
        in_header = in_header && line.starts_with(comment);
        if (in_header) {
            add_header(line.substr(comment.size()), found);
        }
        add_annotations(line, comment, number, found);
    }
    if (found.runs.empty()) {
        found.mistakes.emplace_back("the first lines hold no `run: ARGUMENTS`");
    }
    return found;
}

std::vector<UiDiagnostic> parse_diagnostics(std::string_view text) {
    std::vector<UiDiagnostic> all;
    for (const std::string_view line : split_lines(text)) {
        const std::optional<UiDiagnostic> found =
            line.starts_with('{') ? parse_object(line) : parse_head(line);
        if (found) {
            all.push_back(*found);
        }
    }
    return all;
}

bool matches(const UiAnnotation& annotation,
             const UiDiagnostic& diagnostic,
             std::string_view name) {
    if (annotation.severity != diagnostic.severity ||
        diagnostic.message.find(annotation.text) == std::string::npos ||
        (!annotation.code.empty() && annotation.code != diagnostic.code)) {
        return false;
    }
    const bool is_of_case = diagnostic.file == name || diagnostic.file == "<stdin>";
    return annotation.line == 0 || (is_of_case && annotation.line == diagnostic.line);
}

} // namespace lsys::tests
