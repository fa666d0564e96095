// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/number_tokens.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/lsys/impl/bracket_search.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace lsys::lsys_grammar {

namespace {

/// Whether the text has digit groups as in other languages: `1_000`.
bool has_digit_groups(std::string_view text) {
    const std::size_t group = text.find('_');
    return group != std::string_view::npos && group > 0 && group + 1 < text.size() &&
           is_digit(text[group - 1]) && is_digit(text[group + 1]);
}

/// Whether all digit groups have three digits, the first one at most three.
bool has_groups_of_three(std::string_view text) {
    std::size_t digit_count = 0;
    bool is_first = true;
    for (std::size_t i = 0; i <= text.size(); ++i) {
        if (i < text.size() && is_digit(text[i])) {
            ++digit_count;
        } else if (digit_count == 0 || digit_count > 3 || (!is_first && digit_count != 3) ||
                   (i < text.size() && text[i] != '_')) {
            return false;
        } else {
            is_first = false;
            digit_count = 0;
        }
    }
    return true;
}

} // namespace

namespace {

/// Whether the `%` at `at` ends a percentage: no operand follows it.
bool ends_percentage(std::string_view text, std::size_t at) {
    const char next = next_character(text, static_cast<std::uint32_t>(at) + 1);
    return next == '\0' || std::string_view(":;),~}&|").find(next) != std::string_view::npos;
}

/// A number as authors write it, without trailing zeros.
std::string number_text(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) {
        text.pop_back();
    }
    return text;
}

/// Reports `50%` and returns its value; nullopt if the current number is not a percentage.
std::optional<float> percentage(ParseSession& session, std::string_view text) {
    const ScanState& scan = session.scan;
    const std::string_view all = session.scanned.text;
    const std::size_t at = all.find_first_not_of(" \t", scan.end);
    const bool in_expression = scan.part == Part::Condition || scan.part == Part::Probability ||
                               scan.part == Part::Value || !scan.open.empty();
    if (!in_expression || at == std::string_view::npos || all[at] != '%' ||
        !ends_percentage(all, at)) {
        return std::nullopt;
    }
    const double value = static_cast<double>(read_literal(text).value) / 100.0;
    if (session.wants(DiagnosticCode::MalformedNumber)) {
        const SourceSpan span =
            session.scanned.span(scan.begin, static_cast<std::uint32_t>(at) + 1);
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MalformedNumber, span,
                           scan.part == Part::Condition || scan.part == Part::Probability
                               ? "there are no percentages: a probability is a number from 0 to 1"
                               : "there are no percentages");
        // If the percentage is the whole condition, its `~` is missing as well.
        const bool lacks_tilde = scan.part == Part::Condition && scan.open.empty() &&
                                 all.substr(scan.part_begin, scan.begin - scan.part_begin)
                                         .find_first_not_of(kWhitespace) == std::string_view::npos;
        const std::string replacement = (lacks_tilde ? "* ~ " : "") + number_text(value);
        add_fix(diagnostic, "write `" + replacement + "`", span, replacement, false);
    }
    return static_cast<float>(value);
}

/// A unit of measure and its length in metres; 0 for units of other quantities.
struct Unit {
    std::string_view word;
    double metres;
};
constexpr std::array<Unit, 22> kUnits{{
    {"cm", 0.01},   {"mm", 0.001},  {"km", 1000},       {"metres", 1},      {"meters", 1},
    {"metre", 1},   {"meter", 1},   {"inch", 0.0254},   {"inches", 0.0254}, {"deg", 0},
    {"degree", 0},  {"degrees", 0}, {"years", 0},       {"year", 0},        {"days", 0},
    {"weeks", 0},   {"months", 0},  {"generations", 0}, {"iterations", 0},  {"times", 0},
    {"percent", 0}, {"px", 0},
}};

const Unit* find_unit(std::string_view word) {
    const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                           [&](const Unit& unit) { return unit.word == word; });
    return found == kUnits.end() ? nullptr : found;
}

/// The number at the end of `text`, `2.5e-3` in `F(2.5e-3`; empty if there is none, as in `1..5`.
std::string_view trailing_number(std::string_view text) {
    const std::size_t before = text.find_last_not_of("0123456789.eE+-");
    for (std::size_t begin = before == std::string_view::npos ? 0 : before + 1; begin < text.size();
         ++begin) {
        const char last = begin > 0 ? text[begin - 1] : ' ';
        const std::string_view number = text.substr(begin);
        if (last != '.' && !is_word_character(last) && literal_length(number) == number.size()) {
            return number;
        }
    }
    return {};
}

/// Explains a number that a unit follows.
void explain_unit(Diagnostic& diagnostic,
                  std::string_view number,
                  const Unit& unit,
                  SourceSpan whole) {
    double value = static_cast<double>(read_literal(number).value);
    value *= unit.metres == 0 ? 1.0 : unit.metres;
    value /= unit.word == "percent" ? 100.0 : 1.0;
    const std::string text =
        unit.metres == 0 && unit.word != "percent" ? std::string(number) : number_text(value);
    if (unit.metres != 0) {
        diagnostic.help.emplace_back("lengths are in metres, or in another unit that is the same "
                                     "everywhere");
    }
    add_fix(diagnostic, "write `" + text + "`", whole, text, false);
}

} // namespace

bool is_percent_sign(const ParseSession& session) {
    const std::string_view text = session.scanned.text;
    return session.scan.value_before && is_digit(character_before(text, session.scan.begin)) &&
           ends_percentage(text, session.scan.begin);
}

bool report_unit_word(ParseSession& session, std::string_view word) {
    const ScanState& scan = session.scan;
    const std::string_view text = session.scanned.text;
    const Unit* const unit = find_unit(word);
    if (!scan.value_before || scan.name_before || unit == nullptr || scan.last_end == 0 ||
        !(is_digit(text[scan.last_end - 1]) || text[scan.last_end - 1] == '.') ||
        next_character(text, scan.end) == '(') {
        return false;
    }
    if (session.wants(DiagnosticCode::MalformedNumber)) {
        const std::string_view number = trailing_number(text.substr(0, scan.last_end));
        Diagnostic& diagnostic =
            session.report(DiagnosticCode::MalformedNumber, "numbers have no unit");
        if (!number.empty()) {
            const auto length = static_cast<std::uint32_t>(number.size());
            explain_unit(diagnostic, number, *unit,
                         session.scanned.span(scan.last_end - length, scan.end));
        }
    }
    return true;
}

Token number(ParseSession& session, std::string_view text, SourceSpan span) {
    if (const std::optional<float> value = percentage(session, text)) {
        return Token(Parser::token::TOK_NUMBER, *value, span);
    }
    const Literal literal = read_literal(text);
    if (literal.range != LiteralRange::Normal && session.wants_reports()) {
        report_literal_range(session.context.diagnostics, literal, text, span);
    }
    if (literal.range == LiteralRange::Overflow) {
        return Token(Parser::token::TOK_BAD_VALUE, span);
    }
    return Token(Parser::token::TOK_NUMBER, literal.value, span);
}

void report_malformed_number(ParseSession& session, std::string_view text, SourceSpan span) {
    if (!session.wants(DiagnosticCode::MalformedNumber)) {
        return;
    }
    Diagnostic& diagnostic = session.report(DiagnosticCode::MalformedNumber, span,
                                            "`" + shown(text) + "` is not a number");
    const std::size_t length = literal_length(text);
    const std::string_view rest = text.substr(length);
    if (const Unit* const unit = find_unit(rest)) {
        diagnostic.message = "numbers have no unit";
        explain_unit(diagnostic, text.substr(0, length), *unit, span);
        return;
    }
    if (rest == "f" || rest == "F") {
        // `2f` may be a product, `2.0f` is a number of C.
        add_fix(diagnostic, "numbers have no suffix; remove it",
                {span.file, span.end - 1, span.end}, "",
                text.substr(0, length).find('.') != std::string_view::npos);
    } else if (has_digit_groups(text)) {
        std::string digits(text);
        std::erase(digits, '_');
        if (literal_length(digits) == digits.size()) {
            add_fix(diagnostic, "numbers are written without `_`", span, digits,
                    has_groups_of_three(text));
        }
    } else if (text.starts_with("0x") || text.starts_with("0X")) {
        diagnostic.help.emplace_back("there are no hexadecimal numbers");
    }
    diagnostic.help.emplace_back("numbers are written `3`, `3.14`, `.5`, `1.` or `1e-3`");
}

std::size_t number_before_name(std::string_view text) {
    const std::size_t length = literal_length(text);
    const std::string_view name = text.substr(length);
    if (length == 0 || name.empty() || (name[0] >= '0' && name[0] <= '9') ||
        name.find('.') != std::string_view::npos) {
        return 0;
    }
    // `1e`, `1f`, `1e5F` and `0x10` are numbers of other languages.
    const bool is_suffix = name == "f" || name == "F" || name == "e" || name == "E";
    const bool is_hexadecimal =
        text.substr(0, length) == "0" && (name[0] == 'x' || name[0] == 'X') && name.size() > 1;
    const bool has_group = name.size() > 1 && name[0] == '_' && is_digit(name[1]);
    const bool has_exponent = text.substr(0, length).find_first_of("eE") != std::string_view::npos;
    return is_suffix || is_hexadecimal || has_group || has_exponent ? 0 : length;
}

} // namespace lsys::lsys_grammar
