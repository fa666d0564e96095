// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/lsys/impl/statement_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace lsys::lsys_grammar {

void StatementRepair::repair_curve() {
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
        if (!is_opening(c) && !is_closing(c) && c != ',' && c != ' ' && c != '\n' && c != '\r' &&
            c != '\t') {
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

void StatementRepair::repair_setting() {
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
    Diagnostic& diagnostic =
        report(all, "the numbers of a setting are written side by side, without parentheses and "
                    "commas");
    add_fix(diagnostic, "write `#set tropism " + plain + ";`", draft_.span(all.begin, all.end),
            plain, false);
    static_cast<void>(draft_.replace(all.begin, all.end, plain));
}

void StatementRepair::repair_object() {
    const std::size_t name = skip_gaps(text(), body_);
    const std::string_view module = leading_word(text().substr(name));
    const std::size_t object = skip_gaps(text(), name + std::max<std::size_t>(module.size(), 1));
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
            digit, std::min(extra.find_first_not_of("0123456789.", digit), extra.size()) - digit));
        diagnostic.help.push_back("the size is the first parameter of the module: write `" +
                                  std::string(module) + "(" + size + ")` where it stands");
    }
    add_fix(diagnostic, "leave it out", draft_.span(end, rest.end), "", false);
    draft_.blank(rest.begin, rest.end);
}

void StatementRepair::repair_include() {
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
    add_fix(diagnostic, "write `#include " + quoted + ";`", draft_.span(all.begin, all.end), quoted,
            false);
    static_cast<void>(draft_.replace(all.begin, all.end, quoted));
}

void StatementRepair::constant() {
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
        diagnostic.help.push_back("a table of numbers is a curve: `#curve " + word + " " + points +
                                  ";`, and its value there is `" + word + "(" + index + ")`");
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

} // namespace lsys::lsys_grammar
