// SPDX-License-Identifier: MIT
// The rule texts of Houdini's L-system node: settings, the premise, then one rule
// `left<symbol>right:condition=replacement:probability` per line. The turtle is the profile
// `sidefx`.
#include "grammar/dialects/houdini/session.h"
#include "grammar/dialects/houdini/writer.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"
#include "houdini/parser.h"

#include <algorithm>

namespace lsys {

namespace {

/// Nothing: blank or a comment. NamedPremise: with the label `Premise`.
enum class LineKind : std::uint8_t { Nothing, Setting, NamedPremise, Premise, Rule, Other };

/// The line without a leading label, `Rule 2:`.
std::string_view without_label(std::string_view line) {
    constexpr std::string_view kRule = "rule";
    if (houdini_key(line.substr(0, kRule.size())) != kRule) {
        return line;
    }
    const std::size_t end = line.find_first_not_of("# \t0123456789", kRule.size());
    return end != std::string_view::npos && (line[end] == ':' || line[end] == '=')
               ? trimmed(line.substr(end + 1))
               : line;
}

bool is_premise(std::string_view line) {
    const std::size_t end = line.find_first_of(":=");
    return end != std::string_view::npos && houdini_key(line.substr(0, end)) == "premise";
}

bool is_setting(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || colon == 0 || line.find('=') != std::string_view::npos) {
        return false;
    }
    const std::string key = houdini_key(line.substr(0, colon));
    return find_houdini_setting(key) != nullptr;
}

/// The kind of a line with a `=`: Rule if a symbol, perhaps with contexts, parameters and a
/// condition, stands before the `=` and the line has no arrow; else Other.
LineKind rule_kind(std::string_view line, std::size_t equals) {
    std::string_view head = trimmed(line.substr(0, equals));
    head = trimmed(head.substr(0, head.find(':')));
    const bool has_context = head.find_first_of("<>") != std::string_view::npos;
    const std::size_t symbol = head.find('(');
    const std::size_t length = trimmed(head.substr(0, symbol)).size();
    const bool fits = length == 1 || (has_context && length != 0);
    return fits && line.find("->") == std::string_view::npos ? LineKind::Rule : LineKind::Other;
}

LineKind kind_of(std::string_view line) {
    line = trimmed(line);
    if (line.empty() || line.starts_with("# ") || line.starts_with("// ")) {
        return LineKind::Nothing;
    }
    if (is_premise(line)) {
        return LineKind::NamedPremise;
    }
    if (is_setting(line)) {
        return LineKind::Setting;
    }
    line = without_label(line);
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
        return rule_kind(line, equals);
    }
    // A premise has a letter; blanks, colons, `@`, braces and back quotes show another format.
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    const bool fits = line.find_first_of(kLetters) != std::string_view::npos &&
                      line.find(' ') == std::string_view::npos &&
                      line.find_first_of(":@{}`") == std::string_view::npos;
    return fits ? LineKind::Premise : LineKind::Other;
}

} // namespace

std::string_view recognise_houdini(std::string_view text) {
    bool has_premise = false;
    bool is_named = false;
    std::uint32_t rules = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = text.substr(at, end - at);
        at = end + 1;
        switch (kind_of(line)) {
        case LineKind::Nothing:
            break;
        case LineKind::Setting:
            break;
        case LineKind::NamedPremise:
            has_premise = is_named = true;
            break;
        case LineKind::Premise:
            if (has_premise || rules != 0) {
                return {};
            }
            has_premise = true;
            break;
        case LineKind::Rule:
            if (!has_premise) {
                return {};
            }
            ++rules;
            break;
        case LineKind::Other:
            return {};
        }
    }
    if (is_named) {
        return "its line `premise:`";
    }
    return has_premise && rules != 0 ? "a premise before rules `A=...`" : std::string_view();
}

namespace {

/// Reports `b = 0.7`, a value of the node with `=` instead of `:`, which would be read as a rule.
void report_values(FileId root, const ParseContext& context) {
    const std::string_view text = context.sources.file(root).text();
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view line = trimmed(text.substr(at, end - at));
        at = end + 1;
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) {
            continue;
        }
        const std::string name(trimmed(line.substr(0, equals)));
        const std::string number(trimmed(line.substr(equals + 1)));
        if (name.size() != 1 || name[0] < 'a' || name[0] > 'z' || !is_number(number)) {
            continue;
        }
        const auto begin = static_cast<std::uint32_t>(line.data() - text.data());
        const SourceSpan span{root, begin, begin + static_cast<std::uint32_t>(line.size())};
        Diagnostic& diagnostic = context.diagnostics.add(
            DiagnosticCode::ForeignFeature, span,
            "`" + name + "` is a value of the node, and this line would be a rule");
        diagnostic.help.push_back(
            "remove the line, and give the value on the command line: `-D value_" + name + "=" +
            number + "`");
    }
}

} // namespace

void translate_houdini(const DialectRow& row,
                       const ParseContext& context,
                       Translation& translation) {
    const FileId root = translation.file();
    report_values(root, context);
    if (context.diagnostics.has_errors()) {
        return;
    }
    HoudiniSession session(root, context);
    {
        const HoudiniScanning scanning(session, context.sources.file(root).text());
        houdini_grammar::Parser parser(session, scanning.scanner());
        static_cast<void>(parser.parse()); // errors have been reported
    }
    if (!context.diagnostics.has_errors()) {
        HoudiniWriter(session, translation).write(row.turtle);
    }
}

} // namespace lsys
