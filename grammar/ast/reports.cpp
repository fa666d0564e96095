// SPDX-License-Identifier: MIT
#include "grammar/ast/reports.h"

#include "grammar/base/text_form.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace lsys {

std::string shown(std::string_view text) {
    constexpr std::size_t kMaxLength = 40; // bytes
    constexpr char kDigits[] = "0123456789ABCDEF";
    std::string out;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<unsigned char>(text[at]);
        if (at >= kMaxLength && (byte & 0xC0u) != 0x80) {
            return out + "...";
        }
        if (byte < 0x20 || byte == 0x7F) {
            out += "\\x";
            out += kDigits[byte >> 4];
            out += kDigits[byte & 15u];
        } else {
            out += text[at];
        }
    }
    return out;
}

void report_chained_comparison(Diagnostics& diagnostics,
                               const Ast& ast,
                               ExpressionId first,
                               SourceSpan span,
                               const SourceMap& sources) {
    if (!diagnostics.admits(DiagnosticCode::ChainedComparison)) {
        return;
    }
    const Expression& inner = ast.expression(first);
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::ChainedComparison, span, "comparisons do not chain");
    const SourceSpan middle = ast.expression(inner.right).span();
    const std::string shared(sources.text(middle));
    // `a < {0, 1} < c` gets no fix: `a < {0, 1} && {0, 1} < c` would draw two numbers.
    if (shared.empty() || shared.find_first_of("{\n") != std::string::npos) {
        diagnostic.help.emplace_back("write both comparisons, as in `a < b && b < c`");
        return;
    }
    const std::string both(sources.text({span.file, span.begin, middle.end}));
    const std::string rest(sources.text({span.file, middle.end, span.end}));
    add_fix(diagnostic, "write `" + shown(both + " && " + shared + rest) + "`",
            {span.file, middle.end, middle.end}, " && " + shared, false);
}

namespace {

/// The bounds of `{35-50}`, written with a `-` in place of the comma; nullopt for other texts.
std::optional<std::pair<std::string, std::string>> bounds_with_minus(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789.";
    text = text.substr(0, text.find_last_not_of(" \t}") + 1);
    text.remove_prefix(std::min(text.find_first_not_of(" \t{"), text.size()));
    const std::string_view low = text.substr(0, text.find_first_not_of(kDigits));
    text.remove_prefix(low.size());
    const std::size_t begin = std::min(text.find_first_not_of(" \t-"), text.size());
    const std::string_view between = text.substr(0, begin);
    const std::string_view high = text.substr(begin);
    const bool fits = !low.empty() && !high.empty() &&
                      high.find_first_not_of(kDigits) == std::string_view::npos &&
                      std::count(between.begin(), between.end(), '-') == 1;
    return fits ? std::optional(std::pair(std::string(low), std::string(high))) : std::nullopt;
}

} // namespace

void report_bad_range(Diagnostics& diagnostics,
                      std::uint32_t count,
                      SourceSpan span,
                      const SourceMap& sources) {
    if (!diagnostics.admits(DiagnosticCode::BadRange)) {
        return;
    }
    const std::string found = count == 0   ? "nothing"
                              : count == 1 ? "one value"
                                           : std::to_string(count) + " values";
    const std::string_view text = sources.file(span.file).text();
    const bool is_colour = count == 3 && span.begin > 1 && text[span.begin - 1] == '(' &&
                           text[span.begin - 2] == '\'' && text.substr(span.end, 1) == ")" &&
                           span.end - span.begin > 2;
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::BadRange, span,
        is_colour ? "the values of a colour stand in `( )` alone; `{ }` is a random range"
                  : "a range has two values, `{min, max}`; this has " + found);
    if (is_colour) {
        const std::string inside(text.substr(span.begin + 1, span.end - span.begin - 2));
        add_fix(diagnostic, "write `'(" + inside + ")`", span, inside, false);
        return;
    }
    if (const auto bounds = bounds_with_minus(sources.text(span)); bounds && count == 1) {
        const std::string range = "{" + bounds->first + ", " + bounds->second + "}";
        add_fix(diagnostic,
                "a comma separates the bounds of a range, and `-` is a difference: write `" +
                    range + "`",
                span, range, false);
        return;
    }
    diagnostic.help.emplace_back(
        "inside parentheses braces are a random range; around modules they are a polygon");
}

void report_not_a_letter(Diagnostics& diagnostics, SourceSpan span, char c) {
    if (!diagnostics.admits(DiagnosticCode::LetterName)) {
        return;
    }
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::LetterName, span,
        std::string("`") + c + "` cannot be in a module name with `#set names letters`");
    diagnostic.help.emplace_back("there every letter is a module of its own; for names of several "
                                 "characters leave out `#set names letters`");
}

void report_literal_range(Diagnostics& diagnostics,
                          const Literal& literal,
                          std::string_view text,
                          SourceSpan span) {
    if (literal.range == LiteralRange::Overflow &&
        diagnostics.admits(DiagnosticCode::NumberOverflow)) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::NumberOverflow, span,
                            "`" + shown(text) + "` is too large for a binary32 number");
        diagnostic.help.emplace_back("the largest is about 3.4e38");
    }
    if (literal.range == LiteralRange::Underflow &&
        diagnostics.admits(DiagnosticCode::NumberUnderflow)) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::NumberUnderflow, span,
                            "`" + shown(text) + "` is too small for a normal binary32 number and " +
                                (literal.value > 0.0F ? "loses digits" : "becomes 0"));
        diagnostic.help.emplace_back("the smallest is about 1.2e-38");
    }
}

void report_stray_comment(Diagnostics& diagnostics,
                          std::string_view line,
                          SourceSpan slashes,
                          bool may_be_rolls) {
    if (!diagnostics.admits(DiagnosticCode::StrayComment)) {
        return;
    }
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::StrayComment, slashes,
                        "inside a statement `//` is two modules, not a comment");
    if (line.find("*/") != std::string_view::npos || line.find("/*") != std::string_view::npos) {
        diagnostic.help.emplace_back("write `/* ... */` here, or put the comment after the `;`");
        return;
    }
    // Text with brackets or with several rolls, `////`, is probably modules and not a comment. A
    // `;` at the end may end the statement.
    const bool has_modules =
        line.starts_with("////") || line.find_first_of("[]{}") != std::string_view::npos;
    const std::size_t semicolon = line.find(';');
    const std::size_t last = line.find_last_not_of(
        " \t\r", semicolon == std::string_view::npos ? line.size() - 1 : semicolon - 1);
    const std::uint32_t end = slashes.begin + static_cast<std::uint32_t>(last) + 1;
    diagnostic.fixes.push_back(
        {"write `/* ... */`",
         {{slashes, "/*"}, {{slashes.file, end, end}, " */"}},
         semicolon == std::string_view::npos && !may_be_rolls && !has_modules});
}

bool check_is_text(FileId file, const SourceMap& sources, Diagnostics& diagnostics) {
    const std::optional<NonText> non_text = recognise_non_text(sources.file(file).text());
    if (non_text) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::OtherLanguage, {file, 0, 0},
                            "this file is " + non_text->what + ", not a grammar");
        diagnostic.help.push_back(non_text->help);
    }
    return !non_text;
}

void report_too_deep(Diagnostics& diagnostics, SourceSpan span, std::string_view what) {
    if (diagnostics.admits(DiagnosticCode::NestingTooDeep)) {
        diagnostics.add(DiagnosticCode::NestingTooDeep, span,
                        std::string(what) + " are nested more than 10,000 deep");
    }
}

} // namespace lsys
