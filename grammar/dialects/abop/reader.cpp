// SPDX-License-Identifier: MIT
#include "grammar/dialects/abop/reader.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/abop/text.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsys {

namespace {

constexpr std::size_t kNone = std::string_view::npos;
constexpr std::string_view kBlanks = " \t\r\n";

struct Key {
    std::string_view name; // name in lower case, with blanks as in the file
    AbopKey key;
};
constexpr std::array kKeys{
    Key{"axiom", AbopKey::Axiom},
    Key{"\u03C9", AbopKey::Axiom},
    Key{"omega", AbopKey::Axiom},
    Key{"w", AbopKey::Axiom},
    Key{"start", AbopKey::Axiom},
    Key{"n", AbopKey::Generations},
    Key{"derivation length", AbopKey::Generations},
    Key{"dlength", AbopKey::Generations},
    Key{"iterations", AbopKey::Generations},
    Key{"generations", AbopKey::Generations},
    Key{"steps", AbopKey::Generations},
    Key{"\u03B4", AbopKey::Angle},
    Key{"delta", AbopKey::Angle},
    Key{"angle", AbopKey::Angle},
    Key{"angle increment", AbopKey::Angle},
    Key{"step", AbopKey::Step},
    Key{"step size", AbopKey::Step},
    Key{"width", AbopKey::Width},
    Key{"line width", AbopKey::Width},
    Key{"stemsize", AbopKey::Width},
    Key{"seed", AbopKey::Seed},
    Key{"ignore", AbopKey::Ignore},
    Key{"#ignore", AbopKey::Ignore},
    Key{"consider", AbopKey::Consider},
    Key{"#consider", AbopKey::Consider},
};
/// Words before the `:` or `=` of a heading or a list, as in `variables: A, B`. Only lists of rules
/// are read, since the rules name all symbols.
constexpr std::array<std::string_view, 9> kHeadings{
    "variables", "constants", "alphabet", "v", "rules", "rule", "p", "productions", "lsystem"};

/// Labels of blocks of statements, in lower case.
constexpr std::array<std::string_view, 5> kBlockLabels{"start", "starteach", "end", "endeach",
                                                       "initialize"};

/// The arrows of rules beside `->` with any number of dashes.
constexpr std::array<std::string_view, 4> kArrows{"\u2192", "\u27F6", "\u21D2", "=>"};

/// The first `:` of `text` outside of parentheses from `at` on; npos if there is none.
std::size_t find_colon(std::string_view text, std::size_t at) {
    std::size_t depth = 0;
    for (; at < text.size(); ++at) {
        depth += text[at] == '(' ? 1U : 0U;
        depth -= text[at] == ')' && depth != 0 ? 1U : 0U;
        if (text[at] == ':' && depth == 0) {
            return at;
        }
    }
    return kNone;
}

/// Offsets of an arrow; kNone if the text has no arrow.
struct Found {
    std::size_t begin = kNone;
    std::size_t end = kNone;
};

/// The first arrow of `text`, outside of parentheses unless `anywhere`.
Found find_arrow(std::string_view text, bool anywhere = false) {
    std::size_t depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        depth += c == '(' ? 1U : 0U;
        depth -= c == ')' && depth != 0 ? 1U : 0U;
        if (depth != 0 && !anywhere) {
            continue;
        }
        if (c == '-') {
            const std::size_t end = text.find_first_not_of('-', at);
            if (end != kNone && text[end] == '>') {
                return {at, end + 1};
            }
            at = end == kNone ? text.size() - 1 : end - 1;
            continue;
        }
        if (c == '=' || static_cast<unsigned char>(c) >= 0x80) {
            for (const std::string_view arrow : kArrows) {
                if (text.substr(at, arrow.size()) == arrow) {
                    return {at, at + arrow.size()};
                }
            }
        }
    }
    return {};
}

/// The length of a number with a `%` or without, perhaps in parentheses or brackets.
std::size_t chance_length(std::string_view text) {
    const bool is_wrapped = !text.empty() && (text[0] == '(' || text[0] == '[');
    const std::size_t begin = is_wrapped ? 1 : 0;
    std::size_t length = literal_length(text.substr(begin));
    if (length == 0) {
        return 0;
    }
    length += begin;
    length += text.substr(length).starts_with("%") ? 1U : 0U;
    if (is_wrapped) {
        const char close = text[0] == '(' ? ')' : ']';
        return length < text.size() && text[length] == close ? length + 1 : 0;
    }
    return length;
}

bool is_chance(std::string_view text) {
    return !text.empty() && chance_length(text) == text.size();
}

/// `label`: letters and then digits, or a word of several letters.
bool is_label(std::string_view text) {
    const std::size_t word = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                                    "ABCDEFGHIJKLMNOPQRSTUVWXYZ_ ");
    const std::string_view digits = word == kNone ? std::string_view() : text.substr(word);
    const bool is_numbered = !digits.empty() && is_number(digits);
    return !text.empty() && ((word != 0 && is_numbered) || (word == kNone && text.size() > 1) ||
                             text == "p" || text == "P" || text == "r" || text == "R");
}

class AbopReader {
public:
    AbopReader(FileId file, std::string_view text, const ParseContext* context)
        : id_(file), context_(context) {
        file_.text = without_comments(file, text, context);
    }

    AbopFile read() {
        const std::string_view text = file_.text;
        for (std::size_t at = 0; at < text.size();) {
            if (const std::size_t end = end_of_statements(text, at); end != kNone) {
                end_statement();
                report_statements(at, end);
                at = end;
                continue;
            }
            const std::size_t end = std::min(text.find('\n', at), text.size());
            read_line(span(at, end));
            at = end + 1;
        }
        end_statement();
        finish();
        return std::move(file_);
    }

    /// One past the line with the `}` of a block of C statements that begins at `at`: a line `{`,
    /// or a label of cpfg and `{`. npos if there is no block.
    std::size_t end_of_statements(std::string_view text, std::size_t at) {
        const std::string_view line =
            trimmed(text.substr(at, std::min(text.find('\n', at), text.size()) - at), kBlanks);
        const std::size_t open = line.find('{');
        if (open == kNone) {
            return kNone;
        }
        const std::string label = lowered(trimmed(line.substr(0, open), " \t:"));
        const bool is_labelled = std::ranges::find(kBlockLabels, label) != kBlockLabels.end();
        if (has_open_block_ || (!is_labelled && !(label.empty() && line == "{"))) {
            return kNone;
        }
        std::size_t depth = 0;
        for (std::size_t i = text.find('{', at); i < text.size(); ++i) {
            depth += text[i] == '{' ? 1U : 0U;
            depth -= text[i] == '}' ? 1U : 0U;
            if (depth == 0) {
                return std::min(text.find('\n', i), text.size() - 1) + 1;
            }
        }
        has_open_block_ = true; // the brace is reported as a line that is no rule
        return kNone;
    }

    /// Reports the lines from `begin` to `end` as one mistake.
    void report_statements(std::size_t begin, std::size_t end) {
        Diagnostic* error = nullptr;
        for (std::size_t at = begin; at < end;) {
            const std::size_t line_end = std::min(file_.text.find('\n', at), end);
            const SourceSpan line = span(at, line_end);
            at = line_end + 1;
            if (line.begin == line.end) {
                continue;
            }
            if (error == nullptr) {
                error = report(DiagnosticCode::ForeignFeature, line,
                               "these lines are C, which lsc does not run");
                if (error == nullptr) {
                    return;
                }
                error->help.emplace_back("constants are `#define NAME value`; cpfg reads "
                                         "statements: a text with a line `Lsystem: 1`");
            } else {
                error->labels.push_back({line, "and this one"});
            }
        }
    }

    [[nodiscard]] std::size_t statements() const { return statements_; }
    [[nodiscard]] std::size_t others() const { return others_; }

private:
    enum class Open : std::uint8_t { Nothing, Axiom, Rule };

    [[nodiscard]] SourceSpan span(std::size_t begin, std::size_t end) const {
        return trimmed_span(
            file_.text, {id_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    }
    [[nodiscard]] std::string_view text(SourceSpan part) const { return file_.text_of(part); }

    Diagnostic* report(DiagnosticCode code, SourceSpan place, const std::string& message) {
        return context_ == nullptr ? nullptr : &context_->diagnostics.add(code, place, message);
    }

    void read_line(SourceSpan line) {
        if (line.begin == line.end) {
            return;
        }
        const bool is_indented = line.begin != 0 && is_one_of(file_.text[line.begin - 1], " \t");
        const std::string_view words = text(line);
        const Found arrow = find_arrow(words);
        const bool has_arrow = arrow.begin != kNone || find_arrow(words, true).begin != kNone;
        if (read_define(line) || read_keys(line, has_arrow)) {
            read_more();
            return;
        }
        if (has_arrow && arrow.begin == kNone) {
            end_statement();
            ++statements_;
            report_open_parenthesis(line);
            return;
        }
        if (arrow.begin != kNone) {
            end_statement();
            open_ = Open::Rule;
            open_span_ = line;
            return;
        }
        if (is_indented && open_ != Open::Nothing && words.find('=') == kNone) {
            open_span_.end = line.end;
            return;
        }
        if (read_constants(line)) {
            read_more();
            return;
        }
        end_statement();
        ++others_;
        // A line before the rules may be the axiom, without a keyword.
        const bool may_be_axiom = file_.rules.empty() && words.find_first_of(" \t=:") == kNone;
        (may_be_axiom ? bare_ : unread_).push_back(line);
    }

    /// Reports the first `(` of a rule that no `)` closes before the arrow.
    void report_open_parenthesis(SourceSpan line) {
        std::vector<std::size_t> open;
        const std::size_t end = line.begin + find_arrow(text(line), true).begin;
        for (std::size_t at = line.begin; at < end; ++at) {
            if (file_.text[at] == '(') {
                open.push_back(at);
            } else if (file_.text[at] == ')' && !open.empty()) {
                open.pop_back();
            }
        }
        report(DiagnosticCode::ForeignSyntax, span(open.front(), open.front() + 1),
               "`(` is never closed");
    }

    // The functions read_...() that return a bool return false for a line of another form.

    /// Reads `#define name value`.
    bool read_define(SourceSpan line) {
        const std::string_view words = text(line);
        const std::string start = lowered(words.substr(0, 8));
        const std::size_t skip = start.starts_with("#define")   ? 7
                                 : start.starts_with("define ") ? 6
                                                                : 0;
        if (skip == 0) {
            return false;
        }
        end_statement();
        const std::size_t name = words.find_first_not_of(" \t", skip);
        const std::size_t end =
            name == kNone ? kNone : std::min(words.find_first_of(" \t=", name), words.size());
        if (name == kNone || name == skip || end >= words.size()) {
            report(DiagnosticCode::ForeignSyntax, line, "a definition is `#define NAME value`");
            return true;
        }
        std::size_t value = words.find_first_not_of(" \t", end);
        value += words[value] == '=' ? 1U : 0U;
        std::size_t last = words.size();
        while (last > value && is_one_of(words[last - 1], "; \t")) {
            --last;
        }
        ++statements_;
        file_.constants.push_back({span(line.begin + name, line.begin + end),
                                   span(line.begin + value, line.begin + last)});
        return true;
    }

    /// The end of the name of a setting, a word or words before a `:` or `=`; npos if `words` does
    /// not begin with one.
    static std::size_t key_end(std::string_view words) {
        constexpr std::size_t kMaxName = 40;
        const std::size_t end = words.substr(0, kMaxName).find_first_of(":=");
        if (end == kNone || end == 0 || words.substr(end, 2) == "==" ||
            words.substr(end, 2) == "=>") {
            return kNone;
        }
        return end;
    }

    /// Reads `name: value`, or several as `n = 5, angle = 20`.
    bool read_keys(SourceSpan line, bool has_arrow) {
        std::string_view words = text(line);
        std::size_t end = key_end(words);
        constexpr std::size_t kMaxName = 40;
        std::string name = lowered(trimmed(words.substr(0, std::min(end, kMaxName))));
        const Key* key = nullptr;
        if (end == kNone && (name.starts_with("#ignore ") || name.starts_with("#consider "))) {
            end = name.find(' ');
            name.resize(end);
        }
        if (end != kNone) {
            key = find_key(name);
        }
        if (key == nullptr) {
            return end != kNone && read_heading(line, name, end, has_arrow);
        }
        if (has_arrow && key->key != AbopKey::Axiom) {
            return false; // a rule whose label or predecessor has the name of a setting
        }
        if (has_arrow && (key->name == "w" || key->name == "start")) {
            return false;
        }
        end_statement();
        ++statements_;
        const std::size_t value_end = end_of_value(words, end + 1, key->key);
        const SourceSpan rest = span(line.begin + value_end, line.end);
        add_setting(*key, span(line.begin, line.begin + end),
                    span(line.begin + end + 1, line.begin + value_end));
        more_ = rest;
        return true;
    }

    /// Reads the second and later settings of a line.
    void read_more() {
        while (more_.begin != more_.end) {
            SourceSpan rest = std::exchange(more_, SourceSpan{});
            while (rest.begin != rest.end && is_one_of(file_.text[rest.begin], ",;")) {
                rest = span(rest.begin + 1, rest.end);
            }
            if (rest.begin != rest.end && !read_keys(rest, false)) {
                read_constants(rest);
            }
        }
    }

    static const Key* find_key(std::string_view name) {
        const auto* const found = std::find_if(kKeys.begin(), kKeys.end(),
                                               [&](const Key& row) { return row.name == name; });
        return found == kKeys.end() ? nullptr : &*found;
    }

    /// One past the value that begins at `at`: a `,` or `;` before another `name =` ends it.
    static std::size_t end_of_value(std::string_view words, std::size_t at, AbopKey key) {
        if (key == AbopKey::Axiom || key == AbopKey::Ignore || key == AbopKey::Consider) {
            return words.size();
        }
        return end_of_value(words, at);
    }
    static std::size_t end_of_value(std::string_view words, std::size_t at) {
        for (; at < words.size(); ++at) {
            if (!is_one_of(words[at], ",;")) {
                continue;
            }
            const std::string_view rest = trimmed(words.substr(at + 1));
            const std::size_t next = key_end(rest);
            const std::string name =
                next == kNone ? std::string() : lowered(trimmed(rest.substr(0, next)));
            if (rest.empty() || find_key(name) != nullptr || is_name(name)) {
                return at;
            }
        }
        return words.size();
    }

    static bool is_name(std::string_view word) {
        return !word.empty() && is_letter(word[0]) &&
               std::all_of(word.begin(), word.end(), is_word_character);
    }

    void add_setting(const Key& key, SourceSpan name, SourceSpan value) {
        if (const AbopSetting* const first = file_.find(key.key)) {
            if (Diagnostic* const error =
                    report(DiagnosticCode::ForeignSyntax, name, "this setting occurs twice")) {
                error->labels.push_back({first->name, "it is here already"});
            }
            return;
        }
        file_.settings.push_back({key.key, name, value});
        if (key.key == AbopKey::Axiom) {
            open_ = Open::Axiom;
            open_span_ = value;
        }
    }

    /// Reads `rules: (A -> AB), (B -> A)`; skips lists without rules, such as `variables: A, B`.
    bool read_heading(SourceSpan line, const std::string& name, std::size_t end, bool has_arrow) {
        const auto* const found = std::find(kHeadings.begin(), kHeadings.end(), name);
        const bool is_list = found != kHeadings.end();
        if (!is_list || (has_arrow && (name == "p" || name == "v" || name == "rule"))) {
            return false;
        }
        end_statement();
        ++statements_;
        if (!has_arrow) {
            return true;
        }
        const std::string_view words = text(line);
        std::size_t begin = end + 1; // first byte of the rule
        std::size_t part = begin;    // first byte after the last comma
        std::size_t depth = 0;
        for (std::size_t at = begin; at <= words.size(); ++at) {
            const char c = at < words.size() ? words[at] : ',';
            depth += c == '(' ? 1U : 0U;
            depth -= c == ')' && depth != 0 ? 1U : 0U;
            if (at < words.size() && (depth != 0 || !is_one_of(c, ",;"))) {
                continue;
            }
            if (part != begin && has_rule(words.substr(part, at - part))) {
                read_listed_rule(span(line.begin + begin, line.begin + part - 1));
                begin = part;
            }
            part = at + 1;
        }
        read_listed_rule(span(line.begin + begin, line.end));
        return true;
    }

    static bool has_rule(std::string_view part) {
        part = trimmed(part);
        part.remove_prefix(part.starts_with("(") ? 1 : 0);
        return find_arrow(part).begin != kNone;
    }

    /// Reads a rule of a list, perhaps in parentheses.
    void read_listed_rule(SourceSpan rule) {
        while (rule.begin != rule.end && is_one_of(file_.text[rule.end - 1], ",;")) {
            rule = span(rule.begin, rule.end - 1);
        }
        if (rule.begin != rule.end && text(rule).front() == '(' && text(rule).back() == ')') {
            rule = span(rule.begin + 1, rule.end - 1);
        }
        read_rule(rule);
    }

    /// Reads `NAME = value`.
    bool read_constants(SourceSpan line) {
        const std::string_view words = text(line);
        const std::size_t end = words.find('=');
        if (end == kNone) {
            return false;
        }
        const SourceSpan name = span(line.begin, line.begin + end);
        const bool is_greek = !greek_letter(text(name)).empty();
        if (!(is_greek || is_name(text(name)))) {
            return false;
        }
        end_statement();
        ++statements_;
        const std::size_t value_end = end_of_value(words, end + 1);
        const SourceSpan value = span(line.begin + end + 1, line.begin + value_end);
        if (text(value).starts_with("{")) {
            report(DiagnosticCode::ForeignIgnored, name,
                   "`" + shown(text(name)) + "` has a value in braces, which is not read");
        } else {
            file_.constants.push_back({name, value});
        }
        more_ = span(line.begin + value_end, line.end);
        return true;
    }

    /// Ends the rule or axiom that indented lines could continue, and reads the rule.
    void end_statement() {
        if (open_ == Open::Rule) {
            read_rule(open_span_);
        } else if (open_ == Open::Axiom) {
            for (AbopSetting& setting : file_.settings) {
                if (setting.key == AbopKey::Axiom) {
                    setting.value = open_span_;
                }
            }
        }
        open_ = Open::Nothing;
    }

    void read_rule(SourceSpan rule) {
        std::string_view words = text(rule);
        while (!words.empty() && is_one_of(words.back(), ";, \t\n")) {
            words.remove_suffix(1);
        }
        const Found arrow = find_arrow(words);
        if (arrow.begin == kNone) {
            report(DiagnosticCode::ForeignSyntax, rule, "a rule has an arrow, `->`");
            return;
        }
        ++statements_;
        if (const std::size_t open = words.substr(0, arrow.begin).find('{'); open != kNone) {
            const std::size_t close = std::min(words.find('}', open), arrow.begin - 1);
            report(DiagnosticCode::ForeignFeature, span(rule.begin + open, rule.begin + close + 1),
                   "these statements are C, which lsc does not run");
            return;
        }
        AbopRule new_rule;
        new_rule.span = span(rule.begin, rule.begin + words.size());
        new_rule.arrow = span(rule.begin + arrow.begin, rule.begin + arrow.end);
        std::size_t head_end = rule.begin + arrow.begin;
        if (const std::size_t number = chance_before(words.substr(0, arrow.begin));
            number != kNone) {
            new_rule.chance = span(rule.begin + number, head_end);
            head_end = rule.begin + words.substr(0, number).find_last_not_of('-') + 1;
        }
        read_right_side(new_rule, rule.begin + arrow.end, new_rule.span.end);
        read_left_side(new_rule, span(rule.begin, head_end));
    }

    /// The start of a probability in the arrow, `-0.3->`; npos if there is none.
    static std::size_t chance_before(std::string_view words) {
        std::size_t begin = words.size();
        while (begin > 0 && is_one_of(words[begin - 1], "0123456789.%()[]")) {
            --begin;
        }
        const std::string_view number = words.substr(begin);
        const std::size_t dashes = words.substr(0, begin).find_last_not_of('-');
        if (!is_chance(number) || dashes == kNone || dashes + 1 == begin) {
            return kNone;
        }
        const std::size_t last = words.substr(0, dashes + 1).find_last_not_of(" \t\n");
        const bool is_negative = last == kNone || is_one_of(words[last], "<>=*/+(,&|!:");
        return is_negative ? kNone : begin;
    }

    void read_right_side(AbopRule& rule, std::size_t begin, std::size_t end) {
        SourceSpan right = span(begin, end);
        if (text(right).starts_with("(")) { // a module list cannot begin with a parenthesis
            if (const std::size_t length = chance_length(text(right)); length != 0) {
                rule.chance = span(right.begin, right.begin + length);
                right = span(right.begin + length, right.end);
            }
        }
        if (const std::size_t colon = find_colon(text(right), 0); colon != kNone) {
            rule.chance = span(right.begin + colon + 1, right.end);
            right = span(right.begin, right.begin + colon);
        }
        rule.successor = right;
    }

    void read_left_side(AbopRule& rule, SourceSpan left) {
        const std::string_view words = text(left);
        std::size_t first = find_colon(words, 0);
        std::size_t begin = 0;
        if (first != kNone) {
            const std::string_view label = trimmed(words.substr(0, first), kBlanks);
            const std::size_t second = find_colon(words, first + 1);
            const std::string_view rest = words.substr(first + 1);
            const bool is_plain = rest.find_first_of("<>=!*") == kNone && !rest.empty();
            if (second != kNone || is_label(label) || (is_plain && !is_chance(trimmed(rest)))) {
                rule.label = span(left.begin, left.begin + first);
                begin = first + 1;
                first = second;
            }
        }
        const std::size_t head_end = std::min(first, words.size());
        if (first != kNone) {
            const SourceSpan condition = span(left.begin + first + 1, left.end);
            const bool has_chance = !rule.chance && is_chance(text(condition));
            (has_chance ? rule.chance : rule.condition) = condition;
        }
        rule.head = span(left.begin + begin, left.begin + head_end);
        split_contexts(file_, rule);
        file_.rules.push_back(rule);
    }

    /// Takes a lone line of symbols as the axiom if no statement sets one; reports unread lines.
    void finish() {
        if (file_.find(AbopKey::Axiom) == nullptr && bare_.size() == 1) {
            file_.settings.push_back({AbopKey::Axiom, bare_[0], bare_[0]});
            bare_.clear();
            --others_;
        }
        unread_.insert(unread_.end(), bare_.begin(), bare_.end());
        std::sort(unread_.begin(), unread_.end(),
                  [](SourceSpan a, SourceSpan b) { return a.begin < b.begin; });
        for (const SourceSpan line : unread_) {
            report_unread(line);
        }
    }

    void report_unread(SourceSpan line) {
        if (context_ == nullptr) {
            return;
        }
        const std::string_view words = text(line);
        for (std::size_t at = 0; at < words.size(); ++at) {
            if (static_cast<unsigned char>(words[at]) >= 0xC0 &&
                report_foreign_look_alike(span(line.begin + at, line.end), *context_)) {
                return;
            }
        }
        const std::size_t colon = words.find_first_of(":=");
        const SourceSpan name = span(line.begin, line.begin + std::min(colon, words.size()));
        if (colon != kNone && name.begin != name.end) {
            Diagnostic& error = context_->diagnostics.add(
                DiagnosticCode::ForeignKey, name,
                "`" + shown(text(name)) + "` is not a setting, and a rule has an arrow");
            std::vector<std::string_view> names;
            for (const Key& key : kKeys) {
                if (key.name.size() > 2) {
                    names.push_back(key.name);
                }
            }
            suggest_key(error, name, text(name), names);
            return;
        }
        if (is_unread_reported_) {
            return;
        }
        is_unread_reported_ = true;
        Diagnostic& error = context_->diagnostics.add(DiagnosticCode::ForeignSyntax, line,
                                                      "this line is neither a setting nor a rule");
        error.help.emplace_back("a rule is `p1: A -> FA`, a comment `// text`");
    }

    FileId id_;
    const ParseContext* context_; // null: no mistake is reported
    AbopFile file_;
    Open open_ = Open::Nothing;       // the statement that an indented line continues
    SourceSpan open_span_;            // place of the statement of open_
    SourceSpan more_;                 // the rest of the line after a setting
    std::vector<SourceSpan> bare_;    // lines of symbols before the first rule
    std::vector<SourceSpan> unread_;  // lines without meaning
    bool is_unread_reported_ = false; // an unread line has been reported
    bool has_open_block_ = false;     // a block of statements has no end
    std::size_t statements_ = 0;      // number of statements so far
    std::size_t others_ = 0;          // number of lines that are no statements
};

} // namespace

void split_contexts(const AbopFile& file, AbopRule& rule) {
    const std::string_view words = file.text_of(rule.head);
    std::size_t depth = 0;
    std::size_t less = kNone;
    std::size_t greater = kNone;
    for (std::size_t at = 0; at < words.size(); ++at) {
        depth += words[at] == '(' ? 1U : 0U;
        depth -= words[at] == ')' && depth != 0 ? 1U : 0U;
        if (depth == 0 && words[at] == '<' && less == kNone && greater == kNone) {
            less = at;
        } else if (depth == 0 && words[at] == '>' && greater == kNone) {
            greater = at;
        }
    }
    const std::uint32_t base = rule.head.begin;
    const auto span = [&](std::size_t begin, std::size_t end) {
        return trimmed_span(file.text, {rule.head.file, static_cast<std::uint32_t>(base + begin),
                                        static_cast<std::uint32_t>(base + end)});
    };
    if (less != kNone) {
        rule.left = span(0, less);
    }
    if (greater != kNone) {
        rule.right = span(greater + 1, words.size());
    }
    rule.predecessor = span(less == kNone ? 0 : less + 1, std::min(greater, words.size()));
}

std::optional<AbopKey> abop_key(std::string_view name) {
    const auto* const found =
        std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& row) { return row.name == name; });
    return found == kKeys.end() ? std::nullopt : std::optional<AbopKey>(found->key);
}

const AbopSetting* AbopFile::find(AbopKey key) const {
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const AbopSetting& each) { return each.key == key; });
    return found == settings.end() ? nullptr : &*found;
}

AbopFile read_abop(FileId file, std::string_view text, const ParseContext* context) {
    return AbopReader(file, text, context).read();
}

bool is_abop(std::string_view text) {
    AbopReader reader(FileId{}, text, nullptr);
    const AbopFile file = reader.read();
    return !file.rules.empty() && file.find(AbopKey::Axiom) != nullptr &&
           reader.others() <= reader.statements() / 2;
}

} // namespace lsys
