// SPDX-License-Identifier: MIT
#include "grammar/dialects/fractint/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/number_chars.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"
#include "grammar/dialects/repeated_messages.h"

#include <array>
#include <charconv>
#include <cmath>

namespace lsys {

namespace {

constexpr double kFullTurn = 360.0;
constexpr std::uint32_t kMinAngle = 3; // parts of a full turn
constexpr std::uint32_t kMaxAngle = 50;

/// Commands that a number may follow.
constexpr std::string_view kNumbered = "@\\/C<>";
/// Symbols that no rule can replace in current versions of Fractint.
constexpr std::string_view kReserved = "+-/\\@|!C<>[]";

/// The capital letter; Fractint does not tell small letters from capitals.
char folded(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// A symbol that means something else in .lsys, and the name of its module there.
struct RenamedSymbol {
    std::string_view symbol;
    std::string_view name;
};
constexpr std::array<RenamedSymbol, 4> kRenamed{{
    {".", "dot"},
    {"%", "percent"},
    {"`", "backquote"},
    {"{", "brace"},
}};

/// A module of .lsys for the symbol.
std::string spelled(char symbol) {
    for (const RenamedSymbol& renamed : kRenamed) {
        if (renamed.symbol[0] == symbol) {
            return "`" + std::string(renamed.name) + "`";
        }
    }
    return spelled_letter(static_cast<unsigned char>(symbol));
}

} // namespace

void FractintWriter::warn_quirk(SourceSpan place, const std::string& message) {
    context_.diagnostics.add(DiagnosticCode::ForeignQuirk, place, message);
}

void FractintWriter::report_syntax(SourceSpan place, const std::string& message) {
    context_.diagnostics.add(DiagnosticCode::ForeignSyntax, place, message);
}

void FractintWriter::write(std::string_view turtle) {
    const FractintLine* angle = nullptr;
    const FractintLine* axiom = nullptr;
    std::vector<Rule> rules;
    for (const FractintLine& line : lines_) {
        if (line.kind == FractintLineKind::Rule) {
            add_rule(line, rules);
            continue;
        }
        const FractintLine*& last_line = line.kind == FractintLineKind::Angle ? angle : axiom;
        if (last_line != nullptr && !std::exchange(has_repeated_key_, true)) {
            mark_lost_statement(context_.diagnostics.add(
                DiagnosticCode::ForeignQuirk, last_line->key,
                line.kind == FractintLineKind::Angle
                    ? "there is another `Angle` below, which Fractint takes"
                    : "there is another `Axiom` below, which Fractint takes"));
        }
        last_line = &line;
    }
    if ((axiom == nullptr || angle == nullptr) && has_unknown_key_) {
        return; // the unknown key may be the missing one, misspelt
    }
    if (axiom == nullptr || axiom->texts.empty()) {
        report_syntax(axiom == nullptr ? name_ : axiom->key, "the system has no axiom");
        return;
    }
    if (angle == nullptr || angle->texts.empty()) {
        report_syntax(angle == nullptr ? name_ : angle->key,
                      "the system has no angle: `Angle 8` is an eighth of a full turn");
        return;
    }
    for (const RenamedSymbol& renamed : kRenamed) {
        translation_.replace_name(renamed.name, renamed.symbol);
    }
    translation_.put("#set turtle " + std::string(turtle) +
                     ";\n#set names letters;\n#set width_unit pixels;\n");
    write_angle(*angle);
    translation_.put("\n#w : ", axiom->key);
    write_text(*axiom);
    translation_.put(";\n\n");
    for (std::size_t i = 0; i < rules.size(); ++i) {
        write_rule(rules[i], i + 1);
    }
}

void FractintWriter::write_angle(const FractintLine& line) {
    // `=` may stand before the number.
    const bool has_equals = context_.sources.text(line.texts.front()) == "=";
    const std::size_t first = has_equals ? 1 : 0;
    const SourceSpan place = line.texts.size() > first ? line.texts[first] : line.key;
    const std::string_view text = context_.sources.text(place);
    std::uint32_t parts = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parts);
    if (line.texts.size() <= first || error != std::errc() || parts == 0) {
        context_.diagnostics.add(DiagnosticCode::ForeignValue, place,
                                 "expected the number of parts of a full turn, as in `Angle 8`");
        return;
    }
    if (end != text.data() + text.size() || line.texts.size() > first + 1) {
        warn_quirk(place, "Fractint reads the angle " + std::to_string(parts) +
                              " and rejects the text after it");
    } else if (parts < kMinAngle || parts > kMaxAngle) {
        warn_quirk(place, "Fractint takes angles from " + std::to_string(kMinAngle) + " to " +
                              std::to_string(kMaxAngle) + " only");
    }
    const auto degrees = static_cast<float>(kFullTurn / static_cast<double>(parts));
    translation_.put("#set angle ", line.key);
    translation_.put(text_of(degrees), place);
    translation_.put(";\n");
}

bool FractintWriter::check_key(const FractintLine& line) {
    const std::string_view key = context_.sources.text(line.key);
    if (key.size() != 1) {
        has_unknown_key_ = true;
        if (report_foreign_look_alike(line.key, context_)) {
            return false;
        }
        constexpr std::string_view kKeys[] = {"angle", "axiom"};
        Diagnostic& diagnostic = context_.diagnostics.add(
            DiagnosticCode::ForeignKey, line.key,
            "`" + shown(key) +
                "` is neither `Angle` nor `Axiom` nor one symbol that a rule replaces");
        suggest_key(diagnostic, line.key, key, kKeys);
        return false;
    }
    const char symbol = folded(key[0]);
    if (static_cast<unsigned char>(symbol) < 0x20 || static_cast<unsigned char>(symbol) >= 0x7F) {
        report_syntax(line.key, "this is not a symbol");
        return false;
    }
    if (symbol == '[' || symbol == ']') {
        report_syntax(line.key, "no rule can replace a bracket");
        return false;
    }
    if (is_one_of(symbol, kReserved)) {
        warn_quirk(line.key,
                   "in current versions of Fractint no rule can replace `" + shown(key) + "`");
    }
    return true;
}

void FractintWriter::check_texts(const FractintLine& line) {
    const bool is_rule = line.kind == FractintLineKind::Rule;
    bool begun = false;
    std::uint32_t word_count = 0;
    for (const SourceSpan& text : line.texts) {
        const bool equals = context_.sources.text(text) == "=";
        if (equals && begun && is_rule) {
            report_syntax(text, "a line holds one rule; this is a second `=`");
            return;
        }
        word_count += equals ? 0U : 1U;
        if (word_count == 2 && !equals && is_rule) {
            warn_quirk(text, "Fractint rejects a text with blanks; lsc ignores the blanks");
            ++word_count; // warn only once
        }
        begun = begun || !equals;
    }
}

void FractintWriter::add_rule(const FractintLine& line, std::vector<Rule>& rules) {
    if (!check_key(line)) {
        return;
    }
    check_texts(line);
    const char symbol = folded(context_.sources.text(line.key)[0]);
    for (Rule& rule : rules) {
        if (rule.symbol == symbol) {
            rule.lines.push_back(&line);
            return;
        }
    }
    rules.push_back({symbol, line.key, {&line}});
}

void FractintWriter::write_rule(const Rule& rule, std::size_t number) {
    translation_.put("#r" + std::to_string(number) + " : ", rule.key);
    translation_.put(spelled(rule.symbol), rule.key);
    if (is_one_of(rule.symbol, kNumbered)) {
        translation_.put("(n)", rule.key);
    }
    translation_.put(" : * : ", rule.key);
    for (const FractintLine* line : rule.lines) {
        write_text(*line);
    }
    translation_.put(";\n");
}

void FractintWriter::write_text(const FractintLine& line) {
    bool begun = false;
    for (const SourceSpan& text : line.texts) {
        // The first `=` of `Axiom = F` and `F = FF` separates the two sides; in an axiom, further
        // `=` are symbols.
        if (!begun && context_.sources.text(text) == "=") {
            begun = line.kind == FractintLineKind::Axiom;
            continue;
        }
        begun = true;
        write_word(text);
    }
}

void FractintWriter::write_word(SourceSpan word) {
    const std::string_view text = context_.sources.text(word);
    for (std::uint32_t at = 0; at < text.size();) {
        const SourceSpan symbol{word.file, word.begin + at, word.begin + at + 1};
        const char c = folded(text[at]);
        ++at;
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) {
            const CodePoint point = decode_utf8(text.substr(at - 1));
            at += point.length - 1;
            report_syntax({symbol.file, symbol.begin, symbol.begin + point.length},
                          "this is not a symbol of a system");
            continue;
        }
        write_symbol(symbol);
        if (is_one_of(c, kNumbered)) {
            at += write_number(symbol, text.substr(at));
        }
    }
}

void FractintWriter::write_symbol(SourceSpan symbol) {
    const char c = folded(context_.sources.text(symbol)[0]);
    const std::string text = spelled(c);
    if (text.size() == 1) {
        translation_.copy_as(text, symbol);
    } else {
        translation_.put(text, symbol);
    }
}

std::uint32_t FractintWriter::write_number(SourceSpan command, std::string_view rest) {
    bool takes_root = false;
    bool inverts = false;
    std::uint32_t at = 0;
    while (at < 2 && at < rest.size() && (folded(rest[at]) == 'Q' || folded(rest[at]) == 'I')) {
        (folded(rest[at]) == 'Q' ? takes_root : inverts) = true;
        ++at;
    }
    const std::uint32_t begin = at;
    while (at < rest.size() && ((rest[at] >= '0' && rest[at] <= '9') || rest[at] == '.')) {
        ++at;
    }
    const std::string_view digits = rest.substr(begin, at - begin);
    const SourceSpan place{command.file, command.end, command.end + at};
    const std::size_t length = literal_length(digits);
    if (length == 0) {
        warn_quirk(join(command, place), "`" + shown(context_.sources.text(command)) +
                                             "` has no number; Fractint takes 0");
        translation_.put("(0)", join(command, place));
        return at;
    }
    if (length != digits.size()) {
        warn_quirk(place, "Fractint reads this number up to its second point");
    }
    if (!takes_root && !inverts) {
        translation_.put("(", place);
        translation_.copy(
            {place.file, place.begin, place.begin + static_cast<std::uint32_t>(length)},
            context_.sources);
        translation_.put(")", place);
        return at;
    }
    double value = 0.0;
    number_from_chars(digits.data(), digits.data() + length, value);
    value = takes_root ? std::sqrt(value) : value;
    value = inverts && value > 0.0 ? 1.0 / value : value;
    translation_.put("(" + text_of(static_cast<float>(value)) + ")", place);
    return at;
}

} // namespace lsys
