// SPDX-License-Identifier: MIT
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"
#include "grammar/base/utf8.h"
#include "grammar/lsys/impl/draft_text.h"
#include "grammar/lsys/impl/lookahead.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsys::lsys_grammar {

namespace {

bool is_comment(std::string_view line) {
    return line.starts_with("//") || line.starts_with("/*");
}

/// Whether a line is foreign: it begins with neither a statement nor a comment.
bool is_foreign(std::string_view line) {
    return !line.empty() && !is_comment(line) && !is_statement_start(line, 0) && line[0] != ';';
}

// --- line ends

/// Reports CR line ends if a `//` therefore hides the statements after it; replaces them by LF.
void repair_line_ends(DraftText& draft) {
    const std::string_view text = draft.text;
    if (text.find('\n') != std::string_view::npos) {
        return;
    }
    const std::size_t slashes = text.find("//");
    const std::size_t end = slashes == std::string_view::npos ? slashes : text.find('\r', slashes);
    if (end == std::string_view::npos || text.find('#', end) == std::string_view::npos) {
        return;
    }
    Diagnostic& diagnostic = draft.report(
        DiagnosticCode::PastedText, draft.span(slashes, slashes + 2),
        "the lines end with a carriage return alone, so this comment goes on to the end of the "
        "file");
    diagnostic.help.emplace_back("save the file with the line ends of Unix (LF) or Windows (CRLF)");
    std::replace(draft.text.begin(), draft.text.end(), '\r', '\n');
    draft.mask();
    draft.is_changed = true;
    draft.has_free_lines = false;
}

// --- marks of a merge

void repair_merge(DraftText& draft) {
    std::size_t begin = std::string::npos;
    std::size_t middle = std::string::npos;
    bool is_reported = false;
    for (const FreeLine& line : draft.free_lines()) {
        if (line.text.starts_with("<<<<<<<")) {
            begin = line.begin;
            middle = std::string::npos;
        } else if (begin != std::string::npos && middle == std::string::npos &&
                   (line.text.starts_with("=======") || line.text.starts_with("|||||||"))) {
            middle = line.begin;
        } else if (middle != std::string::npos && line.text.starts_with(">>>>>>>")) {
            if (!std::exchange(is_reported, true)) {
                Diagnostic& diagnostic = draft.report(
                    DiagnosticCode::PastedText, draft.span(begin, end_of_line(draft.text, begin)),
                    "this is a mark of a merge conflict, as Git writes it");
                diagnostic.labels.push_back({draft.span(middle, end_of_line(draft.text, middle)),
                                             "the other version begins here"});
                diagnostic.labels.push_back({draft.span(line.begin, line.end), "it ends here"});
                diagnostic.help.emplace_back(
                    "keep one of the two versions, and remove the other one and the three marks");
            }
            draft.blank(begin, end_of_line(draft.text, begin));
            draft.blank(middle, line.end);
            begin = middle = std::string::npos;
        }
    }
}

// --- Markdown

void repair_fences(DraftText& draft) {
    const std::vector<FreeLine>& lines = draft.free_lines();
    std::vector<const FreeLine*> fences;
    for (const FreeLine& line : lines) {
        if (line.text.starts_with("```") && line.text.find('`', 3) == std::string_view::npos) {
            fences.push_back(&line);
        }
    }
    if (fences.empty()) {
        return;
    }
    Fix fix{fences.size() == 1 ? "remove the line" : "remove these lines", {}, false};
    std::vector<const FreeLine*> prose; // lines before the first fence and after the last
    for (const FreeLine& line : lines) {
        const bool is_outside = line.begin < fences.front()->begin ||
                                (fences.size() > 1 && line.begin > fences.back()->begin);
        if (is_outside && is_foreign(line.text)) {
            prose.push_back(&line);
        }
    }
    Diagnostic& diagnostic = draft.report(
        DiagnosticCode::PastedText, draft.span(fences.front()->begin, fences.front()->end),
        "this is the fence of a code block in Markdown, not part of a grammar");
    for (std::size_t i = 1; i < fences.size(); ++i) {
        diagnostic.labels.push_back(
            {draft.span(fences[i]->begin, fences[i]->end), "and so is this"});
    }
    if (!prose.empty()) {
        diagnostic.labels.push_back({draft.span(prose.front()->begin, prose.front()->end),
                                     "this text is not part of it either"});
    }
    std::vector<const FreeLine*> all = prose;
    all.insert(all.end(), fences.begin(), fences.end());
    std::sort(all.begin(), all.end(),
              [](const FreeLine* a, const FreeLine* b) { return a->begin < b->begin; });
    for (const FreeLine* line : all) {
        const std::size_t after = std::min(line->end + 1, draft.text.size());
        fix.edits.push_back({draft.span(line->begin, after), ""});
    }
    diagnostic.help.emplace_back(all.size() == 1 ? "remove the line"
                                                 : "remove these lines, and keep the text "
                                                   "between the fences");
    diagnostic.fixes.push_back(std::move(fix));
    for (const FreeLine* line : all) {
        draft.blank(line->begin, line->end);
    }
}

// --- line numbers

/// The length of a line number with its punctuation at the start of a line: `12`, `12:`, `12 |`; 0
/// if there is none.
std::size_t number_length(std::string_view line, std::uint32_t& number) {
    std::size_t at = 0;
    number = 0;
    while (at < line.size() && at < 6 && is_digit(line[at])) {
        number = number * 10 + static_cast<std::uint32_t>(line[at] - '0');
        ++at;
    }
    if (at == 0) {
        return 0;
    }
    const std::size_t digits = at;
    while (at < line.size() &&
           std::string_view(" \t.:|)").find(line[at]) != std::string_view::npos) {
        ++at;
    }
    return at == line.size() || at > digits ? at : 0;
}

void repair_line_numbers(DraftText& draft) {
    const std::vector<FreeLine>& lines = draft.free_lines();
    std::size_t first = std::string::npos;
    std::uint32_t number = 0;
    for (const FreeLine& line : lines) {
        const std::size_t length = number_length(line.text, number);
        if (length != 0 &&
            (is_statement_start(line.text, length) || is_comment(line.text.substr(length)))) {
            first = line.begin;
            break;
        }
        if (!line.text.empty() && length == 0 && !is_comment(line.text)) {
            return; // the first line that is not empty has no number
        }
    }
    if (first == std::string::npos) {
        return;
    }
    std::size_t count = 0;
    Fix fix{"remove the line numbers", {}, false};
    SourceSpan place;
    for (std::size_t at = first; at < draft.text.size(); at = end_of_line(draft.text, at) + 1) {
        const std::size_t end = end_of_line(draft.text, at);
        const std::size_t begin = std::min(draft.text.find_first_not_of(" \t", at), end);
        std::uint32_t here = 0;
        const std::size_t length =
            number_length(std::string_view(draft.text).substr(begin, end - begin), here);
        if (length == 0 || here != number + count) {
            continue;
        }
        if (count == 0) {
            const auto digits = draft.text.find_first_not_of("0123456789", begin);
            place = draft.span(begin, std::min(digits, end));
        }
        fix.edits.push_back({draft.span(at, begin + length), ""});
        draft.blank(at, begin + length);
        ++count;
    }
    Diagnostic& diagnostic =
        draft.report(DiagnosticCode::PastedText, place,
                     "the lines begin with their numbers, which are not part of the grammar");
    diagnostic.fixes.push_back(std::move(fix));
}

// --- differences between two versions

void repair_diff(DraftText& draft) {
    const std::vector<FreeLine>& lines = draft.free_lines();
    const auto begins_with = [](std::string_view line, std::string_view word) {
        return line.starts_with(word);
    };
    bool has_sign = false;
    bool has_header = false;
    for (const FreeLine& line : lines) {
        const bool is_signed = line.text.size() > 1 &&
                               (line.text[0] == '-' || line.text[0] == '+') &&
                               is_statement_start(line.text, 1);
        has_sign = has_sign || is_signed;
        has_header = has_header || begins_with(line.text, "@@ ") ||
                     begins_with(line.text, "diff --git ") || begins_with(line.text, "+++ ");
    }
    if (!has_sign) {
        return;
    }
    Diagnostic* diagnostic = nullptr;
    Fix fix{"keep the new version", {}, false};
    bool has_old = false;
    bool has_new = false;
    for (const FreeLine& line : lines) {
        const std::string_view text = line.text;
        const bool is_header =
            has_header &&
            (begins_with(text, "@@ ") || begins_with(text, "diff ") ||
             begins_with(text, "index ") || begins_with(text, "--- ") || begins_with(text, "+++ "));
        const bool is_old = !is_header && text.starts_with('-');
        const bool is_new = !is_header && text.starts_with('+');
        if (!is_header && !is_old && !is_new) {
            continue;
        }
        const std::size_t sign =
            line.begin + static_cast<std::size_t>(text.data() - (draft.text.data() + line.begin));
        if (diagnostic == nullptr) {
            diagnostic = &draft.report(DiagnosticCode::PastedText, draft.span(sign, sign + 1),
                                       "this is a difference between two versions, as Git shows "
                                       "it, not a grammar");
        }
        if (is_new) {
            if (!std::exchange(has_new, true)) {
                diagnostic->labels.push_back(
                    {draft.span(sign, sign + 1), "a line of the new version"});
            }
            fix.edits.push_back({draft.span(sign, sign + 1), ""});
            draft.put(sign, ' ');
        } else {
            has_old = has_old || is_old;
            fix.edits.push_back(
                {draft.span(line.begin, std::min(line.end + 1, draft.text.size())), ""});
            draft.blank(line.begin, line.end);
        }
    }
    if (diagnostic != nullptr) {
        diagnostic->help.emplace_back(
            has_old ? "remove the lines that begin with `-`, and the `+` at the start of others"
                    : "remove the `+` at the start of the lines");
        diagnostic->fixes.push_back(std::move(fix));
    }
}

// --- HTML

struct Entity {
    std::string_view name;
    char character;
};
constexpr std::array<Entity, 9> kEntities{{{"&lt;", '<'},
                                           {"&gt;", '>'},
                                           {"&amp;", '&'},
                                           {"&quot;", '"'},
                                           {"&apos;", '\''},
                                           {"&nbsp;", ' '},
                                           {"&#39;", '\''},
                                           {"&#34;", '"'},
                                           {"&#60;", '<'}}};

/// Whether a statement continues after the `;` before `at`: text other than a comment or a new
/// statement follows on the line.
bool continues_statement(std::string_view text, std::size_t at) {
    const std::string_view line = stripped(text.substr(at, end_of_line(text, at) - at));
    return !line.empty() && !is_comment(line) && !is_statement_start(line, 0);
}

/// The entity at the start of `text`; null if there is none.
const Entity* find_entity(std::string_view text) {
    const auto* const found =
        std::find_if(kEntities.begin(), kEntities.end(),
                     [&](const Entity& row) { return text.starts_with(row.name); });
    return found == kEntities.end() ? nullptr : found;
}

void repair_entities(DraftText& draft) {
    std::size_t read = 0;       // the text before it has been searched for `//`
    bool is_in_comment = false; // `//` stands before `read` in its line
    for (std::size_t at = draft.masked.find('&'); at != std::string::npos;
         at = draft.masked.find('&', at + 1)) {
        const std::string_view text = draft.text;
        if (const std::size_t newline = text.substr(read, at - read).rfind('\n');
            newline != std::string_view::npos) {
            is_in_comment = false;
            read += newline;
        }
        is_in_comment =
            is_in_comment || text.substr(read, at - read).find("//") != std::string_view::npos;
        read = at;
        std::string characters;
        std::size_t end = at;
        while (const Entity* const entity = find_entity(text.substr(end))) {
            characters += entity->character;
            end += entity->name.size();
        }
        if (characters.empty() || !continues_statement(text, end) || is_in_comment) {
            continue;
        }
        const bool is_blank = characters.find_first_not_of(' ') == std::string::npos;
        Diagnostic& diagnostic =
            draft.report(DiagnosticCode::PastedText, draft.span(at, end),
                         "`" + std::string(text.substr(at, end - at)) + "` is HTML for " +
                             (is_blank ? std::string("a blank") : "`" + characters + "`"));
        add_fix(diagnostic, is_blank ? "write a plain blank" : "write `" + characters + "`",
                draft.span(at, end), characters, true);
        static_cast<void>(draft.replace(at, end, characters));
        at = end - 1;
    }
}

// --- the same text twice

/// Whether two texts differ in blanks and line ends only.
bool are_equal_but_for_blanks(std::string_view a, std::string_view b) {
    const auto without_blanks = [](std::string_view text) {
        std::string result(text);
        std::erase_if(result, [](char c) { return kWhitespace.find(c) != std::string_view::npos; });
        return result;
    };
    return without_blanks(a) == without_blanks(b);
}

void repair_second_copy(DraftText& draft) {
    const std::string_view text = draft.text;
    const std::size_t w = text.find("#w");
    std::size_t first = text.find_first_not_of(kWhitespace);
    while (first < text.size() && !is_statement_start(text, first)) {
        first = end_of_line(text, first) + 1;
    }
    if (w == std::string_view::npos || text.find("#w", w + 2) == std::string_view::npos ||
        first >= text.size()) {
        return;
    }
    const std::string_view line = text.substr(first, end_of_line(text, first) - first);
    const std::size_t second = text.find(line, first + line.size());
    if (line.size() < 4 || second == std::string_view::npos ||
        text.substr(first, second - first).find("#n") == std::string_view::npos ||
        !are_equal_but_for_blanks(text.substr(first, second - first), text.substr(second))) {
        return;
    }
    const std::size_t end = text.find_last_not_of(kWhitespace) + 1;
    Diagnostic& diagnostic =
        draft.report(DiagnosticCode::PastedText, draft.span(second, second + line.size()),
                     "from here on the text of the file is repeated");
    diagnostic.labels.push_back({draft.span(first, first + line.size()), "the first time"});
    diagnostic.fixes.push_back({"remove the second copy", {{draft.span(second, end), ""}}, false});
    draft.blank(second, end);
}

// --- comments

void repair_comment_ends(DraftText& draft) {
    for (const FreeLine& line : draft.free_lines()) {
        if (!line.text.starts_with("*/")) {
            continue;
        }
        const std::size_t before = draft.text.rfind("*/", line.begin == 0 ? 0 : line.begin - 1);
        const std::size_t at = draft.text.find("*/", line.begin);
        Diagnostic& diagnostic = draft.report(DiagnosticCode::UnclosedComment,
                                              draft.span(at, at + 2), "this `*/` ends no comment");
        if (before != std::string::npos && before < line.begin) {
            diagnostic.labels.push_back(
                {draft.span(before, before + 2), "the comment has already ended here"});
            diagnostic.help.emplace_back("comments cannot be nested: remove this "
                                         "`*/`, or the inner comment");
        } else {
            diagnostic.help.emplace_back("remove it, or write the `/*` that it ends");
        }
        draft.blank(at, at + 2);
    }
}

// --- lines in the notation of books and other programs

/// The number at the start of `text`, with its sign; empty if there is none.
std::string_view leading_number(std::string_view text) {
    const std::size_t end =
        std::min(text.find_first_not_of("0123456789.", text.starts_with('-')), text.size());
    return text.substr(0, end);
}

std::string lowered(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return lower;
}

/// The text after `word` and one of `signs`: `6` for `n = 6`. Returns nullopt if the line does not
/// begin with `word` and a sign.
std::optional<std::string_view>
value_after(std::string_view line, std::string_view word, std::string_view signs) {
    if (!lowered(line.substr(0, word.size())).starts_with(word)) {
        return std::nullopt;
    }
    const std::string_view rest = stripped(line.substr(word.size()));
    if (rest.empty() || signs.find(rest[0]) == std::string_view::npos) {
        return std::nullopt;
    }
    return stripped(rest.substr(1));
}

struct Arrow {
    std::size_t begin = std::string_view::npos;
    std::size_t length = 0;
};

Arrow find_arrow(std::string_view text) {
    Arrow found;
    for (const std::string_view arrow :
         {"-->", "==>", "->", "=>", "\u2192", "\u27f6", "\u21d2", "\u21a6"}) {
        const std::size_t at = text.find(arrow);
        if (at < found.begin) {
            found = {at, arrow.size()};
        }
    }
    return found;
}

/// Generates names for rules without one: prefix and number.
struct RuleNames {
    std::string prefix;
    std::size_t count = 0;
};

/// Replaces the typographic characters of printed productions (logical and, minus, dashes, delta)
/// and removes degree signs.
std::string without_typography(std::string_view text) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        switch (point.value) {
        case 0x2227:
            result += '^';
            break;
        case 0x2212:
        case 0x2013:
            result += '-';
            break;
        case 0xB0:
            break; // degree sign
        case 0x3B4:
            result += "delta";
            break;
        default:
            result += text.substr(at, point.length);
            break;
        }
        at += point.length;
    }
    return result;
}

/// The statement for a rule with an arrow: `p1 : A -> B` is `#p1 : A : * : B;`.
std::optional<std::string> production_for(std::string_view line, RuleNames& names);

/// The `=` of a Houdini rule, `A(x) : x > 3 = B`.
Arrow find_equals(std::string_view line) {
    int depth = 0;
    for (std::size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        const bool compares =
            (at > 0 && std::string_view("=<>!").find(line[at - 1]) != std::string_view::npos) ||
            line.substr(at, 2) == "==";
        if (c == '=' && depth == 0 && !compares) {
            return {at, 1};
        }
    }
    return {};
}

/// The statements for `rules : (A -> B), (B -> A)`.
std::optional<std::string> productions_for(std::string_view line, RuleNames& names) {
    auto list = value_after(line, "rules", ":");
    if (!list) {
        list = value_after(line, "rule", ":");
    }
    if (!list || !list->starts_with('(')) {
        return production_for(list ? *list : line, names);
    }
    std::string statements;
    for (std::size_t at = 0; at < list->size();) {
        int depth = 0;
        std::size_t end = at;
        for (; end < list->size(); ++end) {
            depth += (*list)[end] == '(' ? 1 : (*list)[end] == ')' ? -1 : 0;
            if (depth == 0) {
                break;
            }
        }
        const std::string_view rule = list->substr(at, end - at);
        if (rule.size() > 1) {
            const auto production = production_for(rule.substr(1), names);
            if (!production) {
                return std::nullopt;
            }
            statements += (statements.empty() ? "" : " ") + *production;
        }
        at = list->find('(', end);
        if (at == std::string_view::npos) {
            break;
        }
    }
    return statements.empty() ? std::nullopt : std::optional(statements);
}

std::optional<std::string> production_for(std::string_view line, RuleNames& names) {
    Arrow arrow = find_arrow(line);
    if (arrow.begin == std::string_view::npos) {
        arrow = find_equals(line);
    }
    std::string label;
    if (arrow.begin == std::string_view::npos) {
        return std::nullopt;
    }
    const bool is_houdini = line[arrow.begin] == '=' && arrow.length == 1;
    std::string_view head = stripped(line.substr(0, arrow.begin));
    if (head.empty()) {
        return std::nullopt;
    }
    ++names.count;
    const std::size_t colon = head.find(':');
    const std::string_view first = head.substr(0, std::min(colon, head.size()));
    std::string condition = "*";
    const bool has_label = colon != std::string_view::npos && !leading_word(first).empty() &&
                           stripped(first) == leading_word(first) &&
                           first.find('(') == std::string_view::npos;
    if (has_label) {
        label = stripped(first);
        head = stripped(head.substr(colon + 1));
    } else {
        label = names.prefix + std::to_string(names.count);
    }
    if (const std::size_t second = head.find(':'); second != std::string_view::npos) {
        condition = stripped(head.substr(second + 1));
        head = stripped(head.substr(0, second));
    }
    std::string successor(stripped(line.substr(arrow.begin + arrow.length)));
    while (successor.ends_with(';') || successor.ends_with(',')) {
        successor.pop_back();
    }
    if (is_houdini) {
        // `A = B : 0.5` gives a probability; a number alone is not a successor.
        const std::size_t last = successor.rfind(':');
        if (last != std::string::npos &&
            !leading_number(stripped(std::string_view(successor).substr(last + 1))).empty()) {
            condition +=
                " ~ " + std::string(stripped(std::string_view(successor).substr(last + 1)));
            successor = stripped(std::string_view(successor).substr(0, last));
        }
        const std::string_view name = leading_word(head);
        if (name.empty() || successor.empty() || !leading_number(successor).empty() ||
            stripped(head.substr(name.size())).substr(0, 1).find_first_not_of('(') !=
                std::string_view::npos) {
            return std::nullopt;
        }
    }
    if (successor == "\u03b5") {
        successor.clear();
    }
    return "#" + label + " : " + std::string(head) + " : " + condition + " : " +
           without_typography(successor) + ";";
}

/// The .lsys text of a line in another notation, with the name of that notation.
struct Meaning {
    std::string source;      // the notation's name
    std::string replacement; // .lsys statements; empty: drop the line
};

/// Recognises lines that are no rules: a function, the number of generations, the angle, the axiom.
std::optional<Meaning> header_meaning(std::string_view line) {
    constexpr std::string_view kDef = "def ";
    if (line.starts_with(kDef)) {
        const std::size_t close = line.find("):");
        const std::size_t body = line.find("return ");
        return Meaning{"Python",
                       close == std::string_view::npos || body == std::string_view::npos
                           ? ""
                           : "#function " +
                                 std::string(line.substr(kDef.size(), close + 1 - kDef.size())) +
                                 " " + std::string(stripped(line.substr(body + 7))) + ";"};
    }
    for (const std::string_view word : {"derivation length", "derivation_length"}) {
        if (const auto value = value_after(line, word, ":=")) {
            const std::string_view number = leading_number(*value);
            return Meaning{"cpfg and L-Py",
                           number.empty() ? "" : "#n = " + std::string(number) + ";"};
        }
    }
    for (const std::string_view word :
         {"iterations", "generations", "generation", "recursion", "depth", "order", "steps", "n"}) {
        const auto value = value_after(line, word, word == "n" ? "=" : ":=");
        if (!value || leading_number(*value).empty()) {
            continue;
        }
        std::string statements = "#n = " + std::string(leading_number(*value)) + ";";
        const std::string_view rest = value->substr(leading_number(*value).size());
        if (word == "n" && stripped(rest) == ";") {
            return std::nullopt; // a statement that lacks only its `#`
        }
        const std::size_t sign = rest.find('=');
        if (sign != std::string_view::npos &&
            (rest.find("\u03b4") < sign || rest.find("angle") < sign ||
             rest.find("delta") < sign)) {
            const std::string_view angle = leading_number(stripped(rest.substr(sign + 1)));
            if (!angle.empty()) {
                statements += " #set angle " + std::string(angle) + ";";
            }
        }
        return Meaning{"papers", statements};
    }
    for (const std::string_view word : {"\u03b4", "delta", "angle", "turn", "angle increment"}) {
        const auto value = value_after(line, word, ":=");
        if (value && !leading_number(*value).empty()) {
            return Meaning{"papers", "#set angle " + std::string(leading_number(*value)) + ";"};
        }
    }
    for (const std::string_view word : {"\u03c9", "axiom", "start", "initiator", "premise"}) {
        const auto value = value_after(line, word, ":=");
        if (value && !value->empty()) {
            std::string modules(*value);
            while (modules.ends_with(';')) {
                modules.pop_back();
            }
            if (modules.size() > 2 && modules.front() == '"' && modules.back() == '"') {
                modules = modules.substr(1, modules.size() - 2);
            }
            return Meaning{"papers", "#w : " + without_typography(modules) + ";"};
        }
    }
    return std::nullopt;
}

/// Recognises lines without an equivalent in .lsys.
std::optional<Meaning> line_without_equivalent(std::string_view line) {
    const std::string lower = lowered(line);
    for (const std::string_view word :
         {"lsystem:", "endlsystem", "production:", "interpretation:", "homomorphism",
          "decomposition", "variables", "constants", "alphabet", "productions:"}) {
        if (lower.starts_with(word)) {
            return Meaning{word.starts_with("var") || word.starts_with("const") ||
                                   word.starts_with("alph") || word == "productions:"
                               ? "papers"
                               : "cpfg and L-Py",
                           ""};
        }
    }
    const bool is_python = (line.starts_with("import ") || line.starts_with("from ")) &&
                           line.find(';') == std::string_view::npos;
    if (is_python) {
        return Meaning{"Python", ""};
    }
    return std::nullopt;
}

/// The offset of a `//` comment in a line in the notation of a paper; npos if there is none.
/// Slashes between modules roll the turtle.
std::size_t comment_in(std::string_view line) {
    for (std::size_t at = line.find("//"); at != std::string_view::npos;
         at = line.find("//", line.find_first_not_of('/', at))) {
        const std::size_t end = std::min(line.find_first_not_of('/', at), line.size());
        if (end == at + 2 && (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t')) {
            return at;
        }
        if (end == line.size()) {
            break;
        }
    }
    return std::string_view::npos;
}

void repair_foreign_lines(DraftText& draft) {
    Diagnostic* diagnostic = nullptr;
    std::string source;
    Fix fix{"", {}, false};
    // Rules without a name get a name that no other rule has.
    const bool has_names =
        draft.text.find("p1") != std::string::npos || draft.text.find("p2") != std::string::npos;
    RuleNames names{has_names ? "rule" : "p", 0};
    bool has_statement = false;
    for (FreeLine line : draft.free_lines()) {
        line.text = stripped(line.text.substr(0, comment_in(line.text)));
        if (!is_foreign(line.text)) {
            has_statement = has_statement || is_statement_start(line.text, 0);
            continue;
        }
        // A line that nothing below recognises stays; the scanner reports statements without `#`.
        std::optional<Meaning> meaning = header_meaning(line.text);
        if (!meaning) {
            meaning = line_without_equivalent(line.text);
        }
        if (!meaning) {
            if (const auto production = productions_for(line.text, names)) {
                meaning = Meaning{"papers and other programs", *production};
            }
        }
        if (!meaning) {
            continue;
        }
        const auto begin = static_cast<std::size_t>(line.text.data() - draft.text.data());
        const std::size_t end = begin + line.text.size();
        if (diagnostic == nullptr) {
            source = meaning->source;
            diagnostic = &draft.report(DiagnosticCode::ForeignLine, draft.span(begin, end),
                                       "this line is in the notation of " + source +
                                           ", not a statement of a grammar");
        } else if (diagnostic->labels.size() < 8) {
            diagnostic->labels.push_back({draft.span(begin, end), "and this one"});
        }
        if (fix.edits.size() < 16) {
            fix.edits.push_back({draft.span(begin, end), meaning->replacement});
            if (meaning->replacement.empty() && diagnostic->help.size() < 4) {
                diagnostic->help.push_back("`" + std::string(line.text.substr(0, 40)) +
                                           "` has no counterpart here; leave it out");
            }
        }
        if (meaning->replacement.empty() || !draft.replace(begin, end, meaning->replacement)) {
            draft.blank(begin, end);
            draft.is_incomplete = draft.is_incomplete || !meaning->replacement.empty();
        }
    }
    if (diagnostic != nullptr) {
        if (names.count > 1 && !has_statement && draft.text.find("names") == std::string::npos) {
            diagnostic->help.emplace_back("if each letter is a module, `#set names letters;` reads "
                                          "them so; otherwise put blanks between names");
        }
        fix.title = fix.edits.size() == 1 ? "write the line in this language"
                                          : "write these lines in this language";
        diagnostic->fixes.push_back(std::move(fix));
    }
}

} // namespace

void repair_pasted_text(DraftText& draft) {
    repair_line_ends(draft);
    repair_merge(draft);
    repair_fences(draft);
    repair_line_numbers(draft);
    repair_diff(draft);
    repair_second_copy(draft);
    repair_entities(draft);
    repair_comment_ends(draft);
    repair_foreign_lines(draft);
}

} // namespace lsys::lsys_grammar
