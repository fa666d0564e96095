// SPDX-License-Identifier: MIT
#include "grammar/base/diagnostic.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/explanations.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

/// A table of all codes with severity and meaning, in the order of diagnostics.def.
std::string list_all() {
    std::size_t width = 0;
    for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
        width = std::max(width, info(static_cast<DiagnosticCode>(i)).name.size());
    }
    std::string text;
    for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
        const DiagnosticInfo& row = info(static_cast<DiagnosticCode>(i));
        text += fmt::format("{:<{}}  {:<7}  {}\n", row.name, width, severity_name(row.severity),
                            row.meaning);
    }
    return text;
}

/// Max columns of prose: the default width of terminals.
constexpr std::size_t kColumns = 80;

/// `text` in lines of at most kColumns characters; blank lines separate paragraphs. A longer word
/// has a line of its own.
std::string wrapped(std::string_view text) {
    std::string out;
    std::size_t column = 0; // length of the current line
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t begin = std::min(text.find_first_not_of(" \n", at), text.size());
        const std::string_view gap = text.substr(at, begin - at);
        const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        if (word.empty()) {
            break;
        }
        const auto width = static_cast<std::size_t>(
            std::count_if(word.begin(), word.end(), [](char c) { return (c & '\xC0') != '\x80'; }));
        if (std::count(gap.begin(), gap.end(), '\n') > 1) {
            out += "\n\n";
            column = 0;
        } else if (column != 0 && column + 1 + width > kColumns) {
            out += '\n';
            column = 0;
        } else if (column != 0) {
            out += ' ';
            ++column;
        }
        out += word;
        column += width;
        at = end;
    }
    return out;
}

/// Appends `text` with each non-empty line indented by four blanks.
void append_indented(std::string_view text, std::string& out) {
    bool at_start = true;
    for (const char c : text) {
        if (at_start && c != '\n') {
            out += "    ";
        }
        at_start = c == '\n';
        out += c;
    }
}

std::string explain(const DiagnosticInfo& row, const Explanation& explanation) {
    std::string text = fmt::format(
        "{}\n\n{}\n",
        wrapped(fmt::format("{}: {} ({})", row.name, row.meaning, severity_name(row.severity))),
        wrapped(explanation.text));
    for (const Example& example : explanation.examples) {
        text += example.is_correct ? "\nRight" : "\nWrong";
        if (!example.arguments.empty()) {
            text += fmt::format(", with `lsc {}`", example.arguments);
        }
        text += ":\n";
        for (const auto& [name, grammar] : example.files) {
            if (&name != &example.files.front().first) {
                text += fmt::format("\nand `{}`:\n", name);
            }
            text += '\n';
            append_indented(grammar, text);
        }
    }
    return text;
}

using Json = nlohmann::ordered_json;

Json row_as_json(const DiagnosticInfo& row) {
    return {
        {"code", row.name}, {"severity", severity_name(row.severity)}, {"meaning", row.meaning}};
}

/// An explanation as a JSON object. Each example has `right` and its files by name.
std::string explain_as_json(const DiagnosticInfo& row, const Explanation& explanation) {
    Json object = row_as_json(row);
    object["text"] = explanation.text;
    object["examples"] = Json::array();
    for (const Example& example : explanation.examples) {
        Json files;
        for (const auto& [name, grammar] : example.files) {
            files[name] = grammar;
        }
        object["examples"].push_back({{"right", example.is_correct},
                                      {"arguments", example.arguments},
                                      {"files", std::move(files)}});
    }
    return object.dump() + '\n';
}

std::string list_as_json() {
    std::string text;
    for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
        text += row_as_json(info(static_cast<DiagnosticCode>(i))).dump() + '\n';
    }
    return text;
}

} // namespace

ExitStatus run_command(const ExplainCommand& command, const Console& console) {
    const bool as_json = command.messages.format == MessageFormat::Json;
    std::string text;
    if (command.code.empty()) {
        text = as_json ? list_as_json() : list_all();
    } else {
        const std::optional<DiagnosticCode> code = find_diagnostic_code(command.code);
        const std::vector<Explanation> all = parse_explanations(explanations_text());
        const auto found = std::find_if(
            all.begin(), all.end(), [&](const Explanation& e) { return e.code == command.code; });
        if (!code || found == all.end()) {
            console.error(fmt::format("there is no diagnostic `{}`", command.code));
            std::vector<std::string_view> names;
            for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
                names.push_back(info(static_cast<DiagnosticCode>(i)).name);
            }
            const auto nearest = nearest_name(command.code, names);
            console.help(nearest ? fmt::format("did you mean `{}`?", *nearest)
                                 : std::string("`lsc explain` lists all of them"));
            return ExitStatus::Failure;
        }
        text = as_json ? explain_as_json(info(*code), *found) : explain(info(*code), *found);
    }
    return report_result(console.write(text), console);
}

} // namespace lsys::lsc
