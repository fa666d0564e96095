// SPDX-License-Identifier: MIT
// .l, .l3d and .l++: the texts of L3D and its L+System. Three numbers (generations, angle,
// thickness in percent), an axiom, lines `key=value`, and a line `@`. Rewriting replaces text, key
// after key; each generation takes one of the values of a key. L3D stores the derived word as text
// too, so each character is a module, and the turtle reads parameters from characters.
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/text.h"
#include "grammar/dialects/l3d/reader.h"
#include "grammar/dialects/l3d/rule_order.h"
#include "grammar/dialects/l3d/writer.h"
#include "grammar/dialects/repeated_messages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace lsys {

namespace {

constexpr float kMaxGenerations = 1e9F;

/// A number of the header.
float value_of(SourceSpan span, const ParseContext& context) {
    std::string_view text = context.sources.text(span);
    const bool negative = text[0] == '-';
    text.remove_prefix(text[0] == '-' || text[0] == '+' ? 1 : 0);
    const Literal literal = read_literal(text);
    report_literal_range(context.diagnostics, literal, text, span);
    return negative ? -literal.value : literal.value;
}

/// Writes the three numbers of the header; returns the number of generations.
std::uint32_t
write_header(const L3dFile& file, const ParseContext& context, Translation& translation) {
    const float generations = value_of(file.numbers[0], context);
    if (!(generations >= 0.0F && generations < kMaxGenerations)) {
        context.diagnostics.add(DiagnosticCode::ForeignValue, file.numbers[0],
                                "`" + shown(context.sources.text(file.numbers[0])) +
                                    "` is not a number of generations");
        return 0;
    }
    if (generations != std::trunc(generations)) {
        context.diagnostics.add(DiagnosticCode::ForeignQuirk, file.numbers[0],
                                "the number of generations is rounded down to a whole number");
    }
    translation.put("#n = " + std::to_string(static_cast<std::uint32_t>(generations)) + ";\n",
                    file.numbers[0]);
    translation.put("#set angle " + text_of(value_of(file.numbers[1], context)) + ";\n",
                    file.numbers[1]);
    const float thickness = value_of(file.numbers[2], context) / 100.0F;
    translation.put("#set width " + text_of(thickness) + ";\n", file.numbers[2]);
    return static_cast<std::uint32_t>(generations);
}

/// Returns the axiom: the last line without a `=`. Without such a line and unless bug-compatible,
/// the first rule is the axiom if its `=` can be the command for the thickness, as in `fA=(5)A`.
std::optional<SourceSpan> take_axiom(L3dFile& file, const ParseContext& context) {
    Diagnostics& diagnostics = context.diagnostics;
    for (std::size_t i = 0; i + 1 < file.axioms.size(); ++i) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::ForeignQuirk, file.axioms[i],
                            "this is not the axiom: a later line without `=` replaces it");
        diagnostic.labels.push_back({file.axioms.back(), "the axiom"});
        mark_lost_statement(diagnostic);
    }
    if (!file.axioms.empty()) {
        return file.axioms.back();
    }
    const auto first = file.rules.begin();
    if (first == file.rules.end() || context.bug_compatible ||
        !context.sources.text(first->value).starts_with('(')) {
        return std::nullopt;
    }
    const SourceSpan whole{first->key.file, first->key.begin, first->value.end};
    diagnostics.add(DiagnosticCode::ForeignQuirk, whole,
                    "L3D reads this as a rule; lsc takes it as the axiom, since there is no other");
    file.rules.erase(first);
    return whole;
}

/// Reports a missing `@` at the end of the file.
void report_missing_mark(FileId root, const ParseContext& context) {
    const std::string_view text = context.sources.file(root).text();
    const bool ends_line = text.ends_with('\n');
    if (context.bug_compatible && !ends_line) {
        return;
    }
    const auto end = static_cast<std::uint32_t>(text.size());
    const bool error = context.bug_compatible;
    mark_lost_statement(context.diagnostics.add(
        error ? DiagnosticCode::ForeignSyntax : DiagnosticCode::ForeignQuirk, {root, end, end},
        ends_line ? "a line `@` is missing at the end, without which L3D never stops reading"
                  : "a line `@` is missing at the end: the file may be cut off"));
}

void write_rules(const std::vector<L3dRule>& rules,
                 const std::map<std::string_view, std::size_t>& alternatives,
                 const ParseContext& context,
                 L3dWriter& writer,
                 Translation& translation) {
    for (std::size_t i = 0; i < rules.size(); ++i) {
        const L3dRule& rule = rules[i];
        translation.put("#r" + std::to_string(i + 1) + " : ", rule.key);
        writer.write_key(rule.key);
        const bool chosen = alternatives.at(context.sources.text(rule.key)) > 1;
        translation.put(chosen ? " : ~ 1 : " : " : * : ", rule.key);
        if (rule.value.begin != rule.value.end) {
            writer.write(rule.value);
        }
        translation.put(";\n", {rule.value.file, rule.value.end, rule.value.end});
    }
}

} // namespace

std::string_view recognise_l3d(std::string_view text) {
    int number_count = 0;
    std::size_t at = 0;
    while (at < text.size()) {
        if (is_one_of(text[at], kL3dBlanks)) {
            ++at;
        } else if (text[at] == '#') {
            at = std::min(text.find('\n', at), text.size());
        } else if (number_count == 3) {
            return "its beginning, three numbers,";
        } else {
            at += text[at] == '-' || text[at] == '+' ? 1U : 0U;
            const std::size_t length = literal_length(text.substr(at));
            at += length;
            if (length == 0 ||
                (at < text.size() && !is_one_of(text[at], kL3dBlanks) && text[at] != '#')) {
                return {};
            }
            ++number_count;
        }
    }
    return {};
}

void translate_l3d(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const FileId root = translation.file();
    L3dFile file = read_l3d(root, context);
    if (context.diagnostics.has_errors()) {
        return;
    }
    L3dWriter writer(context, translation);
    std::optional<SourceSpan> axiom = take_axiom(file, context);
    std::vector<L3dRule> rules;
    for (const L3dRule& line : file.rules) {
        const L3dRule rule{writer.key(line.key), writer.line(line.value)};
        if (rule.key.begin == rule.key.end) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, rule.key,
                                    "the left side of the rule is missing");
        } else {
            rules.push_back(rule);
        }
    }
    const std::vector<L3dRule> by_line = rules;
    // L3D sorts its rules by the bytes of their left sides.
    const auto text_of_key = [&](const L3dRule& rule) { return context.sources.text(rule.key); };
    std::stable_sort(rules.begin(), rules.end(), [&](const L3dRule& a, const L3dRule& b) {
        return text_of_key(a) < text_of_key(b);
    });
    std::map<std::string_view, std::size_t> alternatives;
    bool any_choice = false;
    for (const L3dRule& rule : rules) {
        any_choice = ++alternatives[text_of_key(rule)] > 1 || any_choice;
    }
    translation.put("#set turtle " + std::string(row.turtle) +
                    (context.bug_compatible ? "_program" : "") +
                    ";\n#set names characters;\n#set rewriting sequential;\n");
    if (any_choice) {
        translation.put("#set choice generation;\n#set weights any;\n");
        translation.put(context.bug_compatible ? "#set random glibc;\n" : "");
    }
    const std::uint32_t generations = write_header(file, context, translation);
    const bool is_replaced = file.axioms.size() > 1; // the axiom, perhaps by a broken rule
    if (!file.has_end_mark && (!is_replaced || context.bug_compatible)) {
        report_missing_mark(root, context);
    }
    writer.set_quiet(is_replaced && !context.bug_compatible);
    if (axiom) {
        axiom = writer.line(*axiom);
    }
    if (!axiom || axiom->begin == axiom->end) {
        const SourceSpan after = file.numbers[2];
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, {after.file, after.end, after.end},
                                "an axiom is missing: a line without `=`");
        return;
    }
    translation.put("\n#w : ", *axiom);
    writer.write(*axiom);
    writer.set_quiet(false);
    translation.put(";\n\n");
    write_rules(rules, alternatives, context, writer, translation);
    if (!context.bug_compatible && !context.diagnostics.has_errors()) {
        report_rule_order(by_line, context.sources.text(*axiom), generations, context);
    }
}

} // namespace lsys
