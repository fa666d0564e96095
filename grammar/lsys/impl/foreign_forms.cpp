// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/draft_text.h"
#include "grammar/lsys/impl/lookahead.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

constexpr std::size_t kMaxStatement = 4096; // bytes; longer statements are not searched

/// Bytes [begin, end) of the draft, without blanks at their ends.
struct Piece {
    std::size_t begin = 0;
    std::size_t end = 0;

    [[nodiscard]] bool empty() const { return begin >= end; }
};

Piece trimmed(std::string_view text, std::size_t begin, std::size_t end) {
    const auto is_blank = [&](std::size_t at) {
        return kWhitespace.find(text[at]) != std::string_view::npos;
    };
    while (begin < end && is_blank(begin)) {
        ++begin;
    }
    while (end > begin && is_blank(end - 1)) {
        --end;
    }
    return {begin, end};
}

std::string_view text_of(std::string_view text, Piece piece) {
    return text.substr(piece.begin, piece.end - piece.begin);
}

std::string copy_of(std::string_view text, Piece piece) {
    return std::string(text_of(text, piece));
}

bool is_opening(char c) {
    return c == '(' || c == '[' || c == '{';
}
bool is_closing(char c) {
    return c == ')' || c == ']' || c == '}';
}

/// The offset of the bracket that closes the one at `at`, before `end`; npos if there is none.
std::size_t closing_of(std::string_view text, std::size_t at, std::size_t end) {
    std::size_t depth = 0;
    for (; at < end; ++at) {
        depth += is_opening(text[at]) ? 1U : 0U;
        if (is_closing(text[at]) && --depth == 0) {
            return at;
        }
    }
    return std::string_view::npos;
}

/// The parts of [begin, end) between occurrences of `separator` outside of parentheses.
/// `with_brackets`: also outside of square brackets and braces, which among modules are modules.
std::vector<Piece> split(
    std::string_view text, std::size_t begin, std::size_t end, char separator, bool with_brackets) {
    std::vector<Piece> pieces;
    int depth = 0;
    std::size_t first = begin;
    for (std::size_t at = begin; at < end; ++at) {
        const char c = text[at];
        if (c == '`') {
            at = std::min(text.find_first_of("`\n", at + 1), end);
        } else if (c == '(' || (with_brackets && is_opening(c))) {
            ++depth;
        } else if (c == ')' || (with_brackets && is_closing(c))) {
            --depth;
        } else if (c == separator && depth <= 0) {
            pieces.push_back(trimmed(text, first, at));
            first = at + 1;
        }
    }
    pieces.push_back(trimmed(text, first, end));
    return pieces;
}

bool is_word(std::string_view text) {
    return !text.empty() && leading_word(text).size() == text.size();
}

bool is_number_text(std::string_view text) {
    const std::size_t first = text.starts_with('-') ? 1 : 0;
    return text.size() > first &&
           text.substr(first).find_first_not_of("0123456789.") == std::string_view::npos;
}

/// Whether a word is the name of a type in other languages.
bool is_type(std::string_view word) {
    constexpr std::array<std::string_view, 11> kTypes{"float",  "int",  "double", "var",
                                                      "real",   "auto", "number", "const",
                                                      "vector", "let",  "bool"};
    return std::find(kTypes.begin(), kTypes.end(), word) != kTypes.end();
}

/// Searches one statement for forms of other languages and repairs them.
class StatementRepair {
public:
    StatementRepair(DraftText& draft, StatementText statement)
        : draft_(draft), statement_(statement) {
        const std::size_t word = text().find_first_not_of(" \t", statement.begin + 1);
        word_ = leading_word(text().substr(word));
        body_ = word + word_.size();
        keyword_ = find_keyword(word_);
        // Before a `:`, a keyword is the name of a production, except in `#w :` and lists of names.
        const bool takes_colon = keyword_ == Keyword::Axiom || keyword_ == Keyword::Ignore ||
                                 keyword_ == Keyword::Consider;
        const std::size_t next = skip_gaps(text(), body_);
        if (!takes_colon && next < statement_.end && char_at(next) == ':') {
            keyword_ = Keyword::Label;
        }
    }

    /// Repairs the statement; returns the offset from which the search continues.
    std::size_t repair() {
        const bool has_ended = statement_.end < text().size() && char_at(statement_.end) == ';';
        const std::size_t next = statement_.end + (has_ended ? 1 : 0);
        if (statement_.end - statement_.begin > kMaxStatement) {
            return next;
        }
        switch (keyword_) {
        case Keyword::Function:
            return repair_function();
        case Keyword::Curve:
        case Keyword::Contour:
            repair_curve();
            break;
        case Keyword::Set:
            repair_setting();
            break;
        case Keyword::Object:
            repair_object();
            break;
        case Keyword::Include:
            repair_include();
            break;
        case Keyword::Define:
        case Keyword::Param:
            constant();
            break;
        case Keyword::Axiom:
            choices();
            timed_modules();
            break;
        case Keyword::Label:
        case Keyword::Decompose:
        case Keyword::Interpret:
        case Keyword::Down:
        case Keyword::Up:
            return production();
        default:
            break;
        }
        return next;
    }

private:
    /// The text that is searched: comments and names in back quotes are masked.
    [[nodiscard]] std::string_view text() const { return draft_.masked; }
    [[nodiscard]] char char_at(std::size_t at) const {
        return at < draft_.masked.size() ? draft_.masked[at] : '\0';
    }
    /// The offset of `what` in the statement from `from` on; npos if there is none.
    template <typename Text>
    [[nodiscard]] std::size_t find(Text what, std::size_t from) const {
        return text().substr(0, statement_.end).find(what, from);
    }
    Diagnostic& report(Piece piece, std::string message) {
        return draft_.report(DiagnosticCode::ForeignForm, draft_.span(piece.begin, piece.end),
                             std::move(message));
    }
    /// The offset after the statement and its `;`.
    [[nodiscard]] std::size_t after() const {
        return statement_.end + (statement_.end < text().size() && char_at(statement_.end) == ';');
    }

    // --- functions

    /// Repairs `#function f(x) { return x; }` and `#function f(x): return x;`.
    std::size_t repair_function() {
        const std::size_t open = find('(', body_);
        if (open == std::string_view::npos) {
            return after();
        }
        const std::size_t close = closing_of(text(), open, statement_.end);
        if (close == std::string_view::npos) {
            return after();
        }
        formals(open, close);
        std::size_t at = skip_gaps(text(), close + 1);
        const std::size_t first = at;
        std::vector<Piece> needless;
        const auto take = [&](std::size_t length) {
            needless.push_back({at, at + length});
            at = skip_gaps(text(), at + length);
        };
        if (text().substr(at, 2) == "->" || text().substr(at, 2) == "=>") {
            take(2);
        } else if (at < text().size() && char_at(at) == ':') {
            take(1);
        }
        const bool has_brace = at < text().size() && char_at(at) == '{';
        const bool has_return = [&] {
            const std::size_t word = has_brace ? skip_gaps(text(), at + 1) : at;
            return leading_word(text().substr(word)) == "return";
        }();
        const bool is_block = has_brace && (has_return || is_braced_expression(at));
        if (is_block) {
            take(1);
        }
        if (has_return) {
            take(6);
        }
        if (needless.empty()) {
            choices();
            return after();
        }
        std::size_t end = after();
        if (is_block) {
            std::size_t brace = skip_gaps(text(), end);
            if (statement_.end < text().size() && brace < text().size() && char_at(brace) == '}') {
                needless.push_back({brace, brace + 1});
                end = brace + 1;
                const std::size_t second = skip_gaps(text(), end);
                if (second < text().size() && char_at(second) == ';') {
                    needless.push_back({second, second + 1});
                    end = second + 1;
                }
            } else {
                brace = text().rfind('}', statement_.end);
                if (brace != std::string_view::npos && brace > at) {
                    needless.push_back({brace, brace + 1});
                }
            }
        }
        const Piece expression = trimmed(text(), at,
                                         text().find_first_of(";}", at) == std::string_view::npos
                                             ? statement_.end
                                             : text().find_first_of(";}", at));
        Diagnostic& diagnostic = report(
            {first,
             at == first
                 ? at + 1
                 : needless[is_block && has_return && needless.size() > 1 ? 1 : needless.size() - 1]
                       .end},
            "a function is a name, its parameters and one expression");
        const Piece head = trimmed(text(), statement_.begin, close + 1);
        Fix fix{"write `" + copy_of(draft_.text, head) + " " + copy_of(draft_.text, expression) +
                    ";`",
                {},
                false};
        for (const Piece& piece : needless) {
            fix.edits.push_back({draft_.span(piece.begin, piece.end), ""});
            draft_.blank(piece.begin, piece.end);
        }
        diagnostic.fixes.push_back(std::move(fix));
        choices();
        return end;
    }

    /// Whether the braces at `at` enclose one expression and are not a random range.
    [[nodiscard]] bool is_braced_expression(std::size_t at) const {
        const std::size_t close = closing_of(text(), at, text().size());
        return close != std::string_view::npos && close - at < 256 &&
               skip_gaps(text(), close + 1) == statement_.end &&
               split(text(), at + 1, close, ',', true).size() == 1 && close > at + 1;
    }

    /// Repairs `A(float x)` and `A(x, w = 1)`: parameters with a type or a default value.
    void formals(std::size_t open, std::size_t close) {
        std::size_t index = 0; // index of the formal
        for (const Piece& formal : split(text(), open + 1, close, ',', true)) {
            const std::size_t number = index++;
            const std::string_view first = leading_word(text_of(text(), formal));
            const Piece rest = trimmed(text(), formal.begin + first.size(), formal.end);
            if (first.empty() || rest.empty()) {
                continue;
            }
            const std::string_view name = leading_word(text_of(text(), rest));
            if (is_type(first) && !name.empty()) {
                Diagnostic& diagnostic =
                    report({formal.begin, formal.begin + first.size()},
                           "parameters have no types: every value is a number");
                add_fix(diagnostic, "write `" + std::string(name) + "`",
                        draft_.span(formal.begin, rest.begin), "", false);
                draft_.blank(formal.begin, rest.begin);
            } else if (char_at(rest.begin) == '=' && text().substr(rest.begin, 2) != "==") {
                const Piece value = trimmed(text(), rest.begin + 1, rest.end);
                Diagnostic& diagnostic = report(rest, "parameters have no default values");
                const std::string use = first_use(open, copy_of(draft_.text, value), number);
                diagnostic.help.push_back("a module has all its parameters at every place" +
                                          (use.empty() ? "" : ": write `" + use + "`"));
                add_fix(diagnostic, "write `" + std::string(first) + "`",
                        draft_.span(formal.begin + first.size(), rest.end), "", false);
                draft_.blank(rest.begin, rest.end);
            } else if (char_at(rest.begin) == ':' &&
                       is_type(
                           stripped(text().substr(rest.begin + 1, rest.end - rest.begin - 1)))) {
                Diagnostic& diagnostic =
                    report(rest, "parameters have no types: every value is a number");
                add_fix(diagnostic, "write `" + std::string(first) + "`",
                        draft_.span(rest.begin, rest.end), "", false);
                draft_.blank(rest.begin, rest.end);
            }
        }
    }

    /// The first call, `A(1)`, of the module whose parenthesis is at `open`, with `value` added:
    /// `A(1, 0.1)`. Empty if that call does not have `count` parameters.
    [[nodiscard]] std::string
    first_use(std::size_t open, const std::string& value, std::size_t count) const {
        std::size_t begin = open;
        while (begin > 0 && is_word_character(char_at(begin - 1))) {
            --begin;
        }
        const std::string name(text().substr(begin, open - begin));
        const std::size_t at = text().find(name + "(");
        if (name.empty() || at == std::string_view::npos || at == begin ||
            (at > 0 && is_word_character(char_at(at - 1)))) {
            return {};
        }
        const std::size_t close = closing_of(text(), at + name.size(), text().size());
        const bool fits = close != std::string_view::npos && close - at <= 64 &&
                          split(text(), at + name.size() + 1, close, ',', true).size() == count;
        return !fits ? std::string()
                     : std::string(text().substr(at, close - at)) + ", " + value + ")";
    }

    // --- curves

    /// Repairs points in parentheses, `(0, 1), (1, 2)`, and coordinates with commas, `0,1 1,2`.
    void repair_curve() {
        const std::size_t name = skip_gaps(text(), body_);
        std::size_t begin = name + leading_word(text().substr(name)).size();
        begin = skip_gaps(text(), begin);
        if (begin < statement_.end && (char_at(begin) == '=' || char_at(begin) == ':')) {
            begin = skip_gaps(text(), begin + 1);
        }
        const Piece all = trimmed(text(), begin, statement_.end);
        const std::string_view written = text_of(text(), all);
        std::vector<std::string> numbers;
        std::size_t commas = 0;
        std::size_t brackets = 0;
        for (std::size_t at = 0; at < written.size();) {
            const char c = written[at];
            if (is_digit(c) || c == '.' || c == '-') {
                const std::size_t end =
                    std::min(written.find_first_not_of("0123456789.eE", at + 1), written.size());
                numbers.emplace_back(written.substr(at, end - at));
                at = end;
                continue;
            }
            brackets += is_opening(c) ? 1U : 0U;
            commas += c == ',' ? 1U : 0U;
            if (!is_opening(c) && !is_closing(c) && c != ',' && c != ' ' && c != '\n' &&
                c != '\r' && c != '\t') {
                return; // an expression
            }
            ++at;
        }
        const std::size_t points = numbers.size() / 2;
        const bool is_pairs = numbers.size() % 2 == 0 && points >= 2;
        // The correct form, `0 1, 1 2`, has one comma fewer than points.
        if (!is_pairs || (brackets == 0 && commas + 1 == points) ||
            (brackets == 0 && commas < points) || (brackets != 0 && commas < points)) {
            return;
        }
        std::string plain;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            plain += i == 0 ? "" : i % 2 == 0 ? ", " : " ";
            plain += numbers[i];
        }
        Diagnostic& diagnostic =
            report(all, fmt::format("a point of a {} is two numbers, `x y`, without parentheses, "
                                    "and commas stand between points",
                                    keyword_ == Keyword::Curve ? "curve" : "contour"));
        add_fix(diagnostic, "write `" + plain + "`", draft_.span(all.begin, all.end), plain, false);
        if (!draft_.replace(all.begin, all.end, plain)) {
            leave_out();
        }
    }

    // --- settings

    /// Repairs `#set tropism (0, -1, 0) 0.2;`.
    void repair_setting() {
        const std::size_t key = skip_gaps(text(), body_);
        const std::string_view word = leading_word(text().substr(key));
        Piece all = trimmed(text(), key + word.size(), statement_.end);
        const std::string_view written = text_of(text(), all);
        if (word != "tropism" || written.find_first_of("([{,\"") == std::string_view::npos) {
            return;
        }
        std::vector<std::string> numbers;
        for (std::size_t at = written.find_first_not_of("()[]{}, \"\t\r\n=:");
             at != std::string_view::npos;) {
            const std::size_t end =
                std::min(written.find_first_of("()[]{}, \"\t\r\n", at), written.size());
            numbers.emplace_back(written.substr(at, end - at));
            if (!is_number_text(numbers.back()) && !is_word(numbers.back())) {
                return;
            }
            at = written.find_first_not_of("()[]{}, \"\t\r\n", end);
        }
        if (numbers.size() < 2) {
            return;
        }
        std::string plain;
        for (const std::string& number : numbers) {
            plain += (plain.empty() ? "" : " ") + number;
        }
        Diagnostic& diagnostic = report(
            all, "the numbers of a setting are written side by side, without parentheses and "
                 "commas");
        add_fix(diagnostic, "write `#set tropism " + plain + ";`", draft_.span(all.begin, all.end),
                plain, false);
        static_cast<void>(draft_.replace(all.begin, all.end, plain));
    }

    // --- objects and files

    /// Repairs `#object L LEAF scale 0.4;`.
    void repair_object() {
        const std::size_t name = skip_gaps(text(), body_);
        const std::string_view module = leading_word(text().substr(name));
        const std::size_t object =
            skip_gaps(text(), name + std::max<std::size_t>(module.size(), 1));
        if (object >= statement_.end || module.empty()) {
            return;
        }
        std::size_t end = object + leading_word(text().substr(object)).size();
        if (char_at(object) == '"') {
            end = text().find('"', object + 1);
            end = end == std::string_view::npos ? statement_.end : end + 1;
        }
        if (end == object || end >= statement_.end) {
            return;
        }
        const Piece rest = trimmed(text(), end, statement_.end);
        const std::string_view extra = text_of(text(), rest);
        if (extra.empty() || rest.begin == end || !(is_letter(extra[0]) || is_digit(extra[0]))) {
            return;
        }
        const bool has_contour =
            text().substr(object, end - object) == "CONTOUR" && is_letter(extra[0]);
        if (has_contour) {
            return;
        }
        const std::size_t digit = extra.find_first_of("0123456789.");
        Diagnostic& diagnostic =
            report(rest, "nothing follows the object: it has no size or colour of its own");
        if (digit != std::string_view::npos) {
            const std::string size(extra.substr(
                digit,
                std::min(extra.find_first_not_of("0123456789.", digit), extra.size()) - digit));
            diagnostic.help.push_back("the size is the first parameter of the module: write `" +
                                      std::string(module) + "(" + size + ")` where it stands");
        }
        add_fix(diagnostic, "leave it out", draft_.span(end, rest.end), "", false);
        draft_.blank(rest.begin, rest.end);
    }

    /// Repairs `#include <file.lsys>;`.
    void repair_include() {
        const Piece all = trimmed(text(), body_, statement_.end);
        const std::string_view written = text_of(text(), all);
        const bool is_angled = written.starts_with('<') && written.ends_with('>');
        const bool is_single = written.starts_with('\'') && written.ends_with('\'');
        if (written.size() < 3 || (!is_angled && !is_single)) {
            return;
        }
        const std::string quoted = '"' + std::string(written.substr(1, written.size() - 2)) + '"';
        Diagnostic& diagnostic =
            report(all, is_angled ? "the name of a file is in quotes, not between `<` and `>`"
                                  : "the name of a file is in double quotes");
        add_fix(diagnostic, "write `#include " + quoted + ";`", draft_.span(all.begin, all.end),
                quoted, false);
        static_cast<void>(draft_.replace(all.begin, all.end, quoted));
    }

    // --- constants

    /// Repairs `#define ANGLES [20, 35, 50];`, and `ANGLES[k]` in the rest of the text.
    void constant() {
        choices();
        const std::size_t name = skip_gaps(text(), body_);
        const std::string word(leading_word(text().substr(name)));
        std::size_t begin = skip_gaps(text(), name + word.size());
        if (begin < statement_.end && char_at(begin) == '=') {
            begin = skip_gaps(text(), begin + 1);
        }
        if (word.empty() || begin >= statement_.end || char_at(begin) != '[') {
            return;
        }
        const std::size_t close = closing_of(text(), begin, statement_.end);
        if (close == std::string_view::npos) {
            return;
        }
        const std::vector<Piece> items = split(text(), begin + 1, close, ',', true);
        std::string points;
        std::string first;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const std::string item = copy_of(draft_.text, items[i]);
            if (!is_number_text(item)) {
                first.clear();
                break;
            }
            first = i == 0 ? item : first;
            points += (i == 0 ? "" : ", ") + std::to_string(i) + " " + item;
        }
        Diagnostic& diagnostic =
            report({begin, close + 1}, "there are no lists: a constant is one number");
        if (!first.empty()) {
            const std::size_t use = text().find(word + "[", close);
            const std::size_t last = use == std::string_view::npos
                                         ? use
                                         : closing_of(text(), use + word.size(), text().size());
            std::string index = "k";
            if (last != std::string_view::npos && last - use < 64) {
                index = text().substr(use + word.size() + 1, last - use - word.size() - 1);
            }
            diagnostic.help.push_back("a table of numbers is a curve: `#curve " + word + " " +
                                      points + ";`, and its value there is `" + word + "(" + index +
                                      ")`");
        }
        static_cast<void>(draft_.replace(begin, close + 1, first.empty() ? "1" : first));
        // Removes the index from each use of the table, which would cause further errors.
        for (std::size_t at = text().find(word + "["); at != std::string_view::npos;
             at = text().find(word + "[", at + 1)) {
            const std::size_t open = at + word.size();
            const std::size_t end = closing_of(text(), open, text().size());
            if ((at == 0 || !is_word_character(char_at(at - 1))) && end != std::string_view::npos &&
                end - open < 256) {
                draft_.blank(open, end + 1);
            }
        }
    }

    // --- productions

    /// Repairs the parts of a production; returns the offset from which the search continues.
    std::size_t production() {
        const std::size_t colon = find(':', body_);
        if (colon == std::string_view::npos) {
            return after();
        }
        choices();
        local_values();
        arrow(colon);
        const std::vector<Piece> parts = split(text(), colon + 1, statement_.end, ':', false);
        if (parts.size() >= 2) {
            const std::size_t open = text().find('(', parts[0].begin);
            if (open != std::string_view::npos && open < parts[0].end) {
                const std::size_t close = closing_of(text(), open, parts[0].end);
                if (close != std::string_view::npos) {
                    formals(open, close);
                }
            }
        }
        timed_modules();
        if (parts.size() == 3) {
            conditional_successor(colon, parts);
        }
        return after();
    }

    /// Repairs the local values after `let`.
    void local_values() {
        std::size_t let = find("let", body_);
        while (let != std::string_view::npos &&
               (is_word_character(char_at(let + 3)) || is_word_character(char_at(let - 1)) ||
                char_at(std::min(text().find_last_not_of(kWhitespace, let - 1), let)) != ':')) {
            let = find("let", let + 3);
        }
        if (let == std::string_view::npos) {
            return;
        }
        // `let a = 1; b = 2 :`
        for (int i = 0; i < 16 && statement_.end < text().size() && char_at(statement_.end) == ';';
             ++i) {
            const bool has_colon =
                text().substr(let, statement_.end - let).find(':') != std::string_view::npos;
            std::size_t next = skip_gaps(text(), statement_.end + 1);
            const std::string_view first = leading_word(text().substr(next));
            if (is_type(first)) {
                next = skip_gaps(text(), next + first.size());
            }
            const std::string_view name = leading_word(text().substr(next));
            const std::size_t sign = skip_gaps(text(), next + name.size());
            const bool is_local =
                !name.empty() && text().substr(sign, 1) == "=" && text().substr(sign, 2) != "==";
            const bool is_end = text().substr(next, 1) == ":";
            if (has_colon || (!is_local && !is_end)) {
                break;
            }
            Diagnostic& diagnostic =
                report({statement_.end, statement_.end + 1},
                       is_end ? "there is no `;` after local values"
                              : "local values are separated by `,`, not by `;`, which ends the "
                                "statement");
            add_fix(diagnostic, is_end ? "remove it" : "write `,`",
                    draft_.span(statement_.end, statement_.end + 1), is_end ? "" : ",", false);
            draft_.put(statement_.end, is_end ? ' ' : ',');
            statement_ = statement_at(text(), statement_.begin);
        }
        const std::size_t end = std::min(find(':', let), statement_.end);
        const std::vector<Piece> locals = split(text(), let + 3, end, ',', true);
        unpacked(let, end);
        for (const Piece& local : locals) {
            const std::string_view first = leading_word(text_of(text(), local));
            const std::size_t name = skip_gaps(text(), local.begin + first.size());
            if (name >= local.end || !is_type(first) || !is_letter(char_at(name))) {
                continue;
            }
            Diagnostic& diagnostic = report({local.begin, local.begin + first.size()},
                                            "values have no types: every value is a number");
            add_fix(diagnostic,
                    "write `" + std::string(leading_word(text().substr(name))) + " = ...`",
                    draft_.span(local.begin, name), "", false);
            diagnostic.fixes.back().title = "leave the type out";
            draft_.blank(local.begin, name);
        }
    }

    /// Repairs `let a, b = x, y`.
    void unpacked(std::size_t let, std::size_t end) {
        const std::size_t sign = find('=', let);
        if (sign >= end) {
            return;
        }
        const std::vector<Piece> names = split(text(), let + 3, sign, ',', true);
        const std::vector<Piece> values = split(text(), sign + 1, end, ',', true);
        if (names.size() < 2 || names.size() != values.size()) {
            return;
        }
        std::string plain; // the text that the fix offers
        std::string dense; // the same values without blanks, which fit into their place
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (!is_word(text_of(text(), names[i])) ||
                text_of(text(), values[i]).find('=') != std::string_view::npos) {
                return;
            }
            plain += (i == 0 ? "" : ", ") + copy_of(draft_.text, names[i]) + " = " +
                     copy_of(draft_.text, values[i]);
            dense += (i == 0 ? " " : ",") + copy_of(draft_.text, names[i]) + "=" +
                     copy_of(draft_.text, values[i]);
        }
        const Piece all = trimmed(text(), let + 3, end);
        Diagnostic& diagnostic = report(all, "each local value has its own `=`");
        add_fix(diagnostic, "write `let " + plain + "`", draft_.span(all.begin, all.end), plain,
                false);
        static_cast<void>(draft_.replace(let + 3, end, dense));
    }

    /// Repairs `A(x) : x > 1 --> B`, and Houdini's `A(x) : x > 1 = B`.
    void arrow(std::size_t colon) {
        const std::vector<Piece> parts = split(text(), colon + 1, statement_.end, ':', false);
        if (parts.size() != 2) {
            return;
        }
        int depth = 0;
        for (std::size_t at = parts[1].begin; at < parts[1].end; ++at) {
            const char c = char_at(at);
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (depth != 0) {
                continue;
            }
            std::size_t length = 0;
            for (const std::string_view sign : {"-->", "==>", "->", "=>"}) {
                length = length == 0 && text().substr(at).starts_with(sign) ? sign.size() : length;
            }
            if (length == 0 && c == '=' && char_at(at + 1) != '=' &&
                std::string_view("=<>!").find(char_at(at - 1)) == std::string_view::npos) {
                length = 1;
            }
            if (length == 0) {
                continue;
            }
            const Piece successor = trimmed(text(), at + length, statement_.end);
            const std::string_view before =
                stripped(text().substr(parts[1].begin, at - parts[1].begin));
            // `t = 1` in a production of three parts is a comparison rather than an arrow.
            if (length == 1 && (successor.empty() || is_digit(char_at(successor.begin)) ||
                                before.find_first_of("<>=") == std::string_view::npos)) {
                continue;
            }
            const std::string sign(text().substr(at, length));
            const std::string replacement = before.empty() ? "* :" : ":";
            Diagnostic& diagnostic =
                report({at, at + length}, "`" + sign + "` of " +
                                              (length == 1 ? "Houdini" : "cpfg and L-Py") +
                                              " is `:` here");
            add_fix(diagnostic, "write `" + replacement + "`", draft_.span(at, at + length),
                    replacement, false);
            static_cast<void>(draft_.replace(at, at + length, ":"));
            return;
        }
    }

    /// Repairs `(a, 4)`, modules of papers on timed systems.
    void timed_modules() {
        const std::size_t colon = text().find(':', body_);
        if (colon == std::string_view::npos || colon >= statement_.end) {
            return;
        }
        Diagnostic* diagnostic = nullptr;
        Fix fix{"", {}, false};
        std::optional<Edit> value_edit; // edit of the condition
        const bool is_production = keyword_ != Keyword::Axiom;
        std::size_t colons = 1;
        bool begins_part = true; // after a `:`, `<`, `>` or repaired module
        for (std::size_t at = colon + 1; at < statement_.end; ++at) {
            const char c = char_at(at);
            if (kWhitespace.find(c) != std::string_view::npos) {
                continue;
            }
            if (c == ':') {
                ++colons;
                begins_part = true;
                continue;
            }
            const bool in_condition = is_production && colons == 2;
            if (c != '(' || !begins_part || in_condition) {
                if (c == '(') {
                    const std::size_t close = closing_of(text(), at, statement_.end);
                    at = close == std::string_view::npos ? statement_.end : close;
                }
                begins_part = c == '<' || c == '>';
                continue;
            }
            const std::size_t close = closing_of(text(), at, statement_.end);
            if (close == std::string_view::npos) {
                return;
            }
            const std::size_t name = skip_gaps(text(), at + 1);
            const std::string word(leading_word(text().substr(name)));
            const std::size_t comma = skip_gaps(text(), name + word.size());
            if (word.empty() || comma == close || char_at(comma) != ',') {
                return;
            }
            const Piece arguments = comma == close ? Piece{} : trimmed(text(), comma + 1, close);
            const std::string inside = copy_of(draft_.text, arguments);
            const std::string module = inside.empty() ? word : word + "(" + inside + ")";
            if (diagnostic == nullptr) {
                diagnostic =
                    &report({at, close + 1}, "the name of a module comes before its parentheses");
            }
            const bool is_head = is_production && colons == 1;
            const bool is_value = is_head && is_number_text(inside);
            fix.edits.push_back({draft_.span(at, close + 1), is_value ? word + "(t)" : module});
            if (is_value) {
                diagnostic->help.push_back("parameters of a predecessor are names, and their value "
                                           "is a condition: `" +
                                           word + "(t) : t >= " + inside + "`");
                diagnostic->help.push_back("ages do not grow by themselves: add `#age_" + word +
                                           " : " + word + "(t) : t < " + inside + " : " + word +
                                           "(t + 1);`");
                const std::size_t star = text().find_first_not_of(
                    kWhitespace, std::min(text().find(':', close), statement_.end) + 1);
                if (star < statement_.end && char_at(star) == '*') {
                    value_edit = Edit{draft_.span(star, star + 1), "t >= " + inside};
                }
            }
            if (value_edit) {
                fix.edits.push_back(*std::exchange(value_edit, std::nullopt));
            }
            static_cast<void>(draft_.replace(at, close + 1, is_value ? word + "(t)" : module));
            at = close;
            begins_part = true;
        }
        if (diagnostic != nullptr) {
            fix.title = "write `" + fix.edits.front().replacement + "`";
            diagnostic->fixes.push_back(std::move(fix));
        }
    }

    /// Repairs a successor `if (c) { A } else { B }`.
    void conditional_successor(std::size_t colon, const std::vector<Piece>& parts) {
        const std::size_t at = parts[2].begin;
        if (leading_word(text().substr(at)) != "if" || at + 2 >= statement_.end) {
            return;
        }
        const std::size_t open = skip_gaps(text(), at + 2);
        const std::size_t close = char_at(open) == '(' ? closing_of(text(), open, statement_.end)
                                                       : std::string_view::npos;
        if (close == std::string_view::npos) {
            return;
        }
        const std::size_t brace = skip_gaps(text(), close + 1);
        const bool has_brace = char_at(brace) == '{';
        std::size_t end =
            has_brace ? closing_of(text(), brace, statement_.end) : std::string_view::npos;
        if (end == std::string_view::npos) {
            return;
        }
        const std::string label(
            stripped(text().substr(statement_.begin, colon - statement_.begin)));
        const std::string head = copy_of(draft_.text, parts[0]);
        const std::string condition = copy_of(draft_.text, trimmed(text(), open + 1, close));
        const auto production = [&](const std::string& suffix, const std::string& test,
                                    Piece body) {
            return label + suffix + " : " + head + " : " + test + " : " +
                   copy_of(draft_.text, body) + ";";
        };
        Diagnostic& diagnostic =
            report({at, at + 2}, "a successor holds modules and no `if`: the condition of a "
                                 "production chooses");
        std::string first = production("a", condition, trimmed(text(), brace + 1, end));
        std::size_t next = skip_gaps(text(), end + 1);
        std::string second;
        if (leading_word(text().substr(next)) == "else") {
            next = skip_gaps(text(), next + 4);
            const std::size_t last = next < statement_.end && char_at(next) == '{'
                                         ? closing_of(text(), next, statement_.end)
                                         : std::string_view::npos;
            if (last != std::string_view::npos) {
                second = production("b", "*", trimmed(text(), next + 1, last));
            }
        }
        if (second.empty()) {
            second = production("b", "*", {});
        }
        const std::size_t after_all = after();
        add_fix(diagnostic, "write two productions", draft_.span(statement_.begin, after_all),
                first + "\n" + second, false);
        leave_out();
    }

    // --- expressions

    /// Repairs `c ? a : b`.
    void choices() {
        const auto question = find('?', body_);
        if (question == std::string_view::npos) {
            return;
        }
        std::size_t begin = question;
        int depth = 0;
        std::size_t min_begin = body_;
        if (keyword_ == Keyword::Function) {
            min_begin = text().find(')', body_) + 1;
        } else if (keyword_ == Keyword::Define) {
            min_begin = skip_gaps(text(), body_);
            min_begin += leading_word(text().substr(min_begin)).size();
        }
        bool is_inside = false;
        std::size_t range = std::string_view::npos; // begin of the innermost `{` around the `?`
        while (begin > min_begin) {
            const char c = char_at(begin - 1);
            if (c == ')' || c == '}') {
                ++depth;
            } else if (depth > 0 && (c == '(' || c == '{')) {
                --depth;
            } else if (c == '(') {
                is_inside = true;
                break;
            } else if (c == '{') { // a range, if it is inside something; else a polygon
                range = range == std::string_view::npos ? begin : range;
            } else if (depth == 0 && (c == ',' || c == ':' || c == '=')) {
                const bool compares =
                    c == '=' && begin >= 2 &&
                    std::string_view("=<>!").find(char_at(begin - 2)) != std::string_view::npos;
                const bool is_first = c == '=' && begin < text().size() && char_at(begin) == '=';
                if (!compares && !is_first) {
                    is_inside = c != ':';
                    break;
                }
            }
            --begin;
        }
        const bool has_value = keyword_ == Keyword::Function || keyword_ == Keyword::Define;
        if (!is_inside && !has_value) {
            return;
        }
        begin = range != std::string_view::npos ? range : begin;
        std::size_t end = question + 1;
        depth = 0;
        int pending = 1; // count of `:` to come
        for (; end < statement_.end; ++end) {
            const char c = char_at(end);
            if (is_opening(c)) {
                ++depth;
            } else if (is_closing(c) && depth-- == 0) {
                break;
            } else if (depth == 0 && c == '?') {
                ++pending;
            } else if (depth == 0 && c == ':') {
                if (pending-- == 0) {
                    break;
                }
            } else if (depth == 0 && c == ',') {
                break;
            }
        }
        const Piece all = trimmed(text(), begin, end);
        const std::string call = choice_text(all);
        if (call.empty()) {
            return;
        }
        Diagnostic& diagnostic = report({question, question + 1},
                                        "there is no operator `? :`: a choice is `if(condition, "
                                        "a, b)`");
        add_fix(diagnostic, "write `" + call + "`", draft_.span(all.begin, all.end), call, false);
        // Any value serves, since the statement has an error.
        draft_.blank(all.begin, all.end);
        draft_.put(all.begin, '1');
        choices();
    }

    /// The text `if(c, a, b)` for `c ? a : b`; empty for other texts.
    [[nodiscard]] std::string choice_text(Piece piece) const {
        std::string result;
        std::string closing;
        for (int i = 0; i < 16; ++i) {
            const std::vector<Piece> sides = split(text(), piece.begin, piece.end, '?', true);
            if (sides.size() < 2) {
                return result.empty() ? result : result + copy_of(draft_.text, piece) + closing;
            }
            std::size_t colon = sides[0].end;
            int pending = 0;
            int depth = 0;
            for (; colon < piece.end; ++colon) {
                const char c = char_at(colon);
                depth += is_opening(c) ? 1 : is_closing(c) ? -1 : 0;
                pending += depth == 0 && c == '?' ? 1 : 0;
                if (depth == 0 && c == ':' && --pending == 0) {
                    break;
                }
            }
            if (colon >= piece.end) {
                return {};
            }
            Piece condition = sides[0];
            const std::size_t question = text().find('?', condition.end);
            const Piece chosen = trimmed(text(), question + 1, colon);
            if (text_of(text(), chosen).find('?') != std::string_view::npos) {
                return {};
            }
            if (char_at(condition.begin) == '(' &&
                closing_of(text(), condition.begin, condition.end) + 1 == condition.end) {
                condition = trimmed(text(), condition.begin + 1, condition.end - 1);
            }
            result += "if(" + copy_of(draft_.text, condition) + ", " +
                      copy_of(draft_.text, chosen) + ", ";
            closing += ')';
            piece = trimmed(text(), colon + 1, piece.end);
        }
        return {};
    }

    /// Blanks the statement, whose repair does not fit into its place.
    void leave_out() {
        draft_.blank(statement_.begin, after());
        draft_.is_incomplete = true;
    }

    DraftText& draft_;
    StatementText statement_;
    std::string_view word_; // word after the `#`
    std::size_t body_ = 0;  // offset after `#word`
    Keyword keyword_ = Keyword::Label;
};

/// Repairs `#6b4423` at `at` after the key `colour`: three numbers from 0 to 1 are meant.
void repair_hexadecimal_colour(DraftText& draft, std::size_t at) {
    constexpr std::size_t kDigits = 6;
    // Searches backwards from `at`: the masked comments before the first statement may be long.
    const std::size_t last =
        at == 0 ? std::string::npos : draft.masked.find_last_not_of(kWhitespace, at - 1);
    const std::string_view before =
        std::string_view(draft.masked).substr(0, last == std::string::npos ? 0 : last + 1);
    const std::string_view digits = std::string_view(draft.masked).substr(at + 1, kDigits);
    const std::size_t end = at + 1 + kDigits;
    unsigned value = 0;
    const auto [stop, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (!(before.ends_with("colour") || before.ends_with("color")) || digits.size() < kDigits ||
        error != std::errc() || stop != digits.data() + kDigits ||
        (end < draft.masked.size() && is_word_character(draft.masked[end]))) {
        return;
    }
    const auto part = [value](unsigned shift) { return (value >> shift & 0xFFU) / 255.0; };
    const std::string numbers = fmt::format("{:.2g} {:.2g} {:.2g}", part(16), part(8), part(0));
    const SourceSpan place = draft.span(at, end);
    Diagnostic& diagnostic = draft.report(DiagnosticCode::ForeignForm, place,
                                          "a colour is three numbers from 0 to 1, not hexadecimal");
    add_fix(diagnostic, "write `" + numbers + "`", place, numbers, false);
    draft.replace(at, end, "0 0 0");
}

} // namespace

void repair_foreign_forms(DraftText& draft) {
    if (draft.is_changed) {
        draft.mask();
    }
    for (std::size_t at = draft.masked.find('#'); at != std::string::npos;
         at = draft.masked.find('#', at + 1)) {
        repair_hexadecimal_colour(draft, at);
    }
    for (std::size_t at = draft.masked.find('#'); at != std::string::npos;
         at = draft.masked.find('#', at)) {
        const std::string_view text = draft.masked;
        at = is_statement_start(text, at)
                 ? std::max(at + 1, StatementRepair(draft, statement_at(text, at)).repair())
                 : at + 1;
    }
}

} // namespace lsys::lsys_grammar
