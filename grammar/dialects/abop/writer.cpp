// SPDX-License-Identifier: MIT
#include "grammar/dialects/abop/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/utf8.h"
#include "grammar/dialects/abop/text.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::size_t kNone = std::string_view::npos;
constexpr std::string_view kBlanks = " \t\n";
constexpr std::string_view kSymbols = "+-/\\^&|$!\"'.[]{}%";

bool is_letter_or_digit(char c) {
    return is_word_character(c) && c != '_';
}

std::size_t word_length(std::string_view text) {
    std::size_t length = 0;
    while (length < text.size() && is_word_character(text[length])) {
        ++length;
    }
    return length;
}

/// Whether a setting is a number.
bool is_value(AbopKey key) {
    return key != AbopKey::Axiom && key != AbopKey::Ignore && key != AbopKey::Consider;
}

/// Whether a symbol asks for the state of the turtle: L-Py's `?P`.
bool is_query(std::string_view symbol) {
    return symbol.size() == 2 && symbol[0] == '?';
}

/// Whether a text denotes the empty word: no character, `*`, epsilon, lambda or capital lambda.
bool is_empty_word(std::string_view text) {
    return text.empty() || text == "*" || text == "\u03B5" || text == "\u03BB" || text == "\u039B";
}

} // namespace

AbopWriter::AbopWriter(const AbopFile& file, const ParseContext& context, Translation& out)
    : file_(file), context_(context), out_(out) {
    for (const AbopConstant& constant : file.constants) {
        constants_.insert(text(constant.name));
    }
    find_long_names();
}

SourceSpan AbopWriter::trimmed_part(std::size_t begin, std::size_t end) const {
    return trimmed_span(file_.text, {out_.file(), static_cast<std::uint32_t>(begin),
                                     static_cast<std::uint32_t>(end)});
}

void AbopWriter::report(SourceSpan place, const std::string& message) {
    if (!report_foreign_look_alike(place, context_)) {
        context_.diagnostics.add(DiagnosticCode::ForeignSyntax, place, message);
    }
}

void AbopWriter::find_long_names() {
    long_names_.insert(file_.names.begin(), file_.names.end());
    if (file_.is_lpy) {
        return;
    }
    for (const AbopRule& rule : file_.rules) {
        const std::string_view predecessor = text(rule.predecessor);
        const std::size_t length = word_length(predecessor);
        if (length > 1 && predecessor.find('_') == kNone) {
            long_names_.emplace(predecessor.substr(0, length));
        }
    }
}

std::size_t AbopWriter::long_name_length(std::string_view ahead) const {
    constexpr std::size_t kMaxLength = 16; // max bytes of a name in back quotes
    const std::size_t word = word_length(ahead.substr(0, kMaxLength));
    if (word > 2 && ahead[1] == '_' && !file_.is_lpy) { // a subscript: F_l
        std::size_t length = 3;
        while (length < word && is_digit(ahead[length])) {
            ++length;
        }
        return length;
    }
    for (std::size_t length = word; length > 1; --length) {
        if (long_names_.contains(ahead.substr(0, length))) {
            return length;
        }
    }
    return 1;
}

void AbopWriter::write(std::string_view turtle) {
    out_.put("#set turtle " + std::string(turtle) + ";\n#set names letters;\n");
    for (const AbopConstant& constant : file_.constants) {
        const std::string_view name = text(constant.name);
        const std::string_view greek = greek_letter(name);
        const bool is_identifier =
            !name.empty() && is_letter(name[0]) && word_length(name) == name.size();
        if (greek.empty() && !is_identifier) {
            report(constant.name, "`" + shown(name) + "` is not the name of a constant");
            continue;
        }
        out_.put("#define ", constant.name);
        out_.put(greek.empty() ? name : greek, constant.name);
        out_.put(" ");
        write_expression(constant.value, false);
        out_.put(";\n");
    }
    write_setting(AbopKey::Angle, "#set angle ");
    write_setting(AbopKey::Step, "#set step ");
    write_setting(AbopKey::Width, "#set width ");
    if (file_.find(AbopKey::Width) == nullptr && !sets_widths()) {
        out_.put("#set width_unit pixels;\n"); // so that curves of any size are seen
    }
    write_setting(AbopKey::Seed, "#set seed ");
    write_setting(AbopKey::Generations, "#n = ");
    for (const AbopSetting& setting : file_.settings) {
        if (setting.key == AbopKey::Ignore || setting.key == AbopKey::Consider) {
            out_.put(setting.key == AbopKey::Ignore ? "#ignore : " : "#consider : ", setting.name);
            write_modules(setting.value, Place::List);
            out_.put(";\n");
        }
    }
    const AbopSetting* const axiom = file_.find(AbopKey::Axiom);
    if (axiom == nullptr) {
        context_.diagnostics.add(DiagnosticCode::ForeignSyntax, {out_.file(), 0, 0},
                                 "the text has no axiom, a line `axiom: A`");
        return;
    }
    out_.put("\n#w : ", axiom->name);
    write_modules(axiom->value, Place::Word);
    out_.put(";\n\n");
    for (std::size_t i = 0; i < file_.rules.size(); ++i) {
        write_rule(file_.rules[i], i + 1);
    }
    write_drawings();
}

bool AbopWriter::sets_widths() const {
    const std::string_view whole = context_.sources.file(out_.file()).text();
    return whole.find('!') != kNone || whole.find("#(") != kNone || whole.find("_(") != kNone;
}

void AbopWriter::write_setting(AbopKey key, std::string_view before) {
    if (const AbopSetting* const setting = file_.find(key)) {
        const bool is_plain = literal_length(text(setting->value)) != 0 &&
                              text(setting->value).find_first_of("+-*/^(") == kNone;
        out_.put(before, setting->name);
        out_.put(is_plain ? "" : "(", setting->value);
        write_expression(setting->value, false);
        out_.put(is_plain ? "" : ")", setting->value);
        out_.put(";\n");
    }
}

std::string AbopWriter::label_of(const AbopRule& rule, std::size_t index) {
    std::string name = rule.label ? std::string(text(*rule.label)) : "";
    const bool fits = !name.empty() && is_letter(name[0]) && word_length(name) == name.size() &&
                      name != "w" && name != "ignore" && name != "consider";
    if (!fits || !labels_.insert(name).second) {
        name = "r" + std::to_string(index);
        while (!labels_.insert(name).second) {
            name += "_";
        }
    }
    return name;
}

bool AbopWriter::check_predecessor(const AbopRule& rule) {
    const SourceSpan span = rule.predecessor;
    std::size_t at = span.begin;
    Symbol symbol;
    if (span.begin != span.end && !read_symbol(span, at, symbol)) {
        return false;
    }
    const bool is_one = span.begin != span.end && at >= span.end;
    if (is_one && !is_one_of(file_.text[span.begin], "[]{}.")) {
        return true;
    }
    // Report all rules of L-Py with the same head once.
    if (!reported_head_ || reported_head_->begin != rule.head.begin) {
        reported_head_ = rule.head;
        report(span.begin == span.end ? rule.arrow : span,
               is_one ? "a rule cannot replace brackets, braces and dots"
                      : "the left side of a rule is one symbol");
    }
    return false;
}

void AbopWriter::write_rule(const AbopRule& rule, std::size_t index) {
    if (!check_predecessor(rule)) {
        return;
    }
    formals_.clear();
    const std::string_view stage = rule.stage == AbopStage::Rewrite     ? "#"
                                   : rule.stage == AbopStage::Decompose ? "#decompose "
                                                                        : "#interpret ";
    out_.put(std::string(stage) + label_of(rule, index) + " : ",
             rule.label.value_or(rule.predecessor));
    const auto is_any = [&](SourceSpan context) { return text(context) == "*"; };
    if (rule.left && !is_any(*rule.left)) {
        write_modules(*rule.left, Place::Pattern);
        out_.put(" < ");
    }
    write_modules(rule.predecessor, Place::Pattern);
    if (rule.right && !is_any(*rule.right)) {
        out_.put(" > ");
        write_modules(*rule.right, Place::Pattern);
    }
    out_.put(" : ");
    const bool is_free = !rule.condition || text(*rule.condition) == "*";
    if (!is_free) {
        write_expression(*rule.condition, true);
        out_.put(rule.chance ? " " : "");
    } else if (!rule.chance) {
        out_.put("*", rule.arrow);
    }
    if (rule.chance) {
        write_chance(*rule.chance);
    }
    out_.put(" : ", rule.arrow);
    if (!is_empty_word(text(rule.successor))) {
        write_modules(rule.successor, Place::Word);
    }
    out_.put(";\n", {out_.file(), rule.span.end, rule.span.end});
    formals_.clear();
}

void AbopWriter::write_chance(SourceSpan chance) {
    std::string_view number = text(chance);
    while (!number.empty() && is_one_of(number.front(), "([")) {
        number = text(chance = trimmed_part(chance.begin + 1, chance.end));
    }
    while (!number.empty() && is_one_of(number.back(), ")]")) {
        number = text(chance = trimmed_part(chance.begin, chance.end - 1));
    }
    out_.put("~ ", chance);
    if (!number.empty() && number.back() == '%') {
        write_expression(trimmed_part(chance.begin, chance.end - 1), false);
        out_.put("/100", chance);
    } else {
        write_expression(chance, false);
    }
}

void AbopWriter::write_drawings() {
    std::size_t index = 0;
    for (const auto& [name, span] : leaves_) {
        out_.put("#object " + name + " LEAF;\n", span);
    }
    if (sphere_) { // its centre is at the turtle; a sphere of .lsys begins at the turtle
        out_.put("#object `sphere` SPHERE;\n#interpret draw" + std::to_string(++index) +
                     " : `@O`(d) : * : " +
                     (file_.is_lpy ? "[f(-d)`sphere`(2*d)];\n" : "[f(-d/2)`sphere`(d)];\n"),
                 *sphere_);
    }
    for (const auto& [head, span] : segments_) {
        const std::size_t open = head.find('(');
        const char forward = head[1]; // the first character after the back quote
        out_.put("#interpret draw" + std::to_string(++index) + " : " + head + " : * : " + forward +
                     (open == kNone ? std::string() : head.substr(open)) + ";\n",
                 span);
    }
}

bool AbopWriter::read_symbol(SourceSpan list, std::size_t& at, Symbol& symbol) {
    const std::string_view whole = file_.text;
    const std::string_view ahead = whole.substr(at, list.end - at);
    const CodePoint point = decode_utf8(ahead);
    std::size_t length = point.length;
    if (is_letter_or_digit(ahead[0])) {
        length = long_name_length(ahead);
    } else if (ahead[0] == '@' || ahead[0] == '~') {
        const bool has_second = ahead.size() > 2 && is_one_of(ahead[1], "GCDT") &&
                                ahead[2] >= 'a' && ahead[2] <= 'z' && ahead[0] == '@';
        const bool has_letter = ahead.size() > 1 && is_letter_or_digit(ahead[1]);
        length = has_second ? 3 : has_letter ? 2 : 1;
    }
    if (file_.is_lpy && ahead.size() > 1 && ahead[0] == '?' && is_one_of(ahead[1], "PHULR")) {
        length = 2;
    }
    const bool is_known = is_letter_or_digit(ahead[0]) || is_one_of(ahead[0], kSymbols) ||
                          is_one_of(ahead[0], file_.is_lpy ? "@~;,?_" : "@~;,#?");
    symbol.span = {list.file, static_cast<std::uint32_t>(at),
                   static_cast<std::uint32_t>(at + length)};
    if (!is_known) {
        report(symbol.span,
               ahead[0] == '(' || ahead[0] == ')'
                   ? "a parenthesis follows a symbol"
                   : "`" + shown(ahead.substr(0, length)) + "` is not a symbol of a module");
        return false;
    }
    at += length;
    const std::size_t open = whole.find_first_not_of(kBlanks, at);
    if (open < list.end && whole[open] == '(') {
        const std::size_t close = closing_parenthesis(whole, open, list.end);
        if (close == kNone) {
            const auto place = static_cast<std::uint32_t>(open);
            report({list.file, place, place + 1}, "`(` is never closed");
            return false;
        }
        symbol.has_arguments = true;
        symbol.inner = trimmed_part(open + 1, close);
        at = close + 1;
    }
    return true;
}

void AbopWriter::name_symbol(Symbol& symbol, std::string_view written) {
    symbol.name = written;
    if (symbol.has_arguments && (written == ";" || written == ",")) {
        symbol.name = "'";
    } else if (symbol.has_arguments && (written == "#" || written == "_")) {
        symbol.name = "!";
    } else if (!symbol.has_arguments && written == "@v") { // a command of cpfg
        symbol.name = "$";
    } else if (is_query(written)) {
        return;
    } else if (written.size() > 1 || is_digit(written[0]) ||
               !(is_letter(written[0]) || is_one_of(written[0], kSymbols))) {
        symbol.name = "`" + std::string(written) + "`";
    }
    if (written[0] == '~' && written.size() > 1) {
        leaves_.emplace(symbol.name, symbol.span);
    } else if (written == "@O" && symbol.has_arguments && !sphere_) {
        sphere_ = symbol.span;
    }
}

/// `Place::Pattern`: parameters are names. `Place::List`: no parameters.
void AbopWriter::write_modules(SourceSpan list, Place place) {
    const std::string_view whole = file_.text;
    for (std::size_t at = list.begin; at < list.end;) {
        if (is_one_of(whole[at], kBlanks)) {
            ++at;
            continue;
        }
        if (place == Place::List && is_one_of(whole[at], ",;:")) {
            ++at; // a separator; `,` and `;` are symbols only with parameters
            continue;
        }
        Symbol symbol;
        if (!read_symbol(list, at, symbol)) {
            return;
        }
        const std::string_view written = text(symbol.span);
        name_symbol(symbol, written);
        if (symbol.name == written) {
            out_.copy(symbol.span, context_.sources);
        } else {
            out_.put(symbol.name, symbol.span);
        }
        if (symbol.has_arguments) {
            write_arguments(symbol, place);
        }
        const bool is_segment = written.size() > 1 && is_one_of(written[0], "Ff") && !file_.is_lpy;
        if (is_segment && place != Place::List) {
            std::string head = symbol.name;
            const std::string_view inner = text(symbol.inner);
            std::size_t depth = 0;
            std::size_t count = symbol.has_arguments ? 1 : 0;
            for (const char c : inner) {
                depth += c == '(' ? 1U : 0U;
                depth -= c == ')' && depth != 0 ? 1U : 0U;
                count += c == ',' && depth == 0 ? 1U : 0U;
            }
            for (std::size_t i = 1; i <= count; ++i) {
                head += (i == 1 ? "(x" : ", x") + std::to_string(i);
            }
            segments_.emplace(head + (count == 0 ? "" : ")"), symbol.span);
        }
    }
}

void AbopWriter::write_arguments(const Symbol& symbol, Place place) {
    if (place == Place::List || symbol.inner.begin == symbol.inner.end) {
        if (place == Place::List) {
            report(symbol.inner, "a list of symbols has no parameters");
        }
        return;
    }
    std::vector<SourceSpan> arguments = arguments_of(symbol);
    if (is_query(symbol.name)) {
        if (arguments.size() != 3) {
            context_.diagnostics.add(DiagnosticCode::ForeignFeature, symbol.span,
                                     "`" + symbol.name + "` with other than three parameters");
            return;
        }
        // In L-Py, plants grow along +Z and the up vector begins as +X, so coordinates x, y, z of
        // L-Py are z, x, y of .lsys.
        std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
    }
    out_.put("(", symbol.span);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (i != 0) {
            out_.put(", ");
        }
        if (place == Place::Word) {
            write_expression(arguments[i], false);
        } else if (!write_formal(arguments[i], symbol.span)) {
            return;
        }
    }
    out_.put(")", symbol.span);
}

/// The arguments of a symbol that has some, without the commas.
std::vector<SourceSpan> AbopWriter::arguments_of(const Symbol& symbol) const {
    std::vector<SourceSpan> arguments;
    std::size_t begin = symbol.inner.begin;
    std::size_t depth = 0;
    for (std::size_t at = begin; at <= symbol.inner.end; ++at) {
        const char c = at < symbol.inner.end ? file_.text[at] : ',';
        depth += is_one_of(c, "({") ? 1U : 0U;
        depth -= is_one_of(c, ")}") && depth != 0 ? 1U : 0U;
        if (c == ',' && (depth == 0 || at == symbol.inner.end)) {
            arguments.push_back(trimmed_part(begin, at));
            begin = at + 1;
        }
    }
    return arguments;
}

/// Writes a parameter of a pattern, which is a name. Returns false after a report.
bool AbopWriter::write_formal(SourceSpan formal, SourceSpan symbol) {
    const std::string_view name = text(formal);
    const std::string_view greek = greek_letter(name);
    if (!greek.empty()) {
        out_.put(greek, formal);
        formals_.emplace(greek);
    } else if (!name.empty() && is_letter(name[0]) && word_length(name) == name.size()) {
        out_.copy(formal, context_.sources);
        formals_.emplace(name);
    } else {
        report(formal.begin == formal.end ? symbol : formal,
               "a parameter on a left side is a name; a condition follows the `:`");
        return false;
    }
    return true;
}

void AbopWriter::write_expression(SourceSpan expression, bool is_condition) {
    if (expression.begin == expression.end) {
        const auto begin = expression.begin == 0 ? 0 : expression.begin - 1;
        report({expression.file, begin, expression.end}, "an expression is missing");
        return;
    }
    if (!find_parentheses(expression)) {
        return;
    }
    const std::string_view whole = file_.text;
    for (std::size_t at = expression.begin; at < expression.end;) {
        const char c = whole[at];
        if (is_one_of(c, kBlanks)) {
            at = std::min(whole.find_first_not_of(kBlanks, at), whole.size());
            out_.put(" ");
            continue;
        }
        const std::string_view ahead = whole.substr(at, expression.end - at);
        if (const std::size_t length = literal_length(ahead); length != 0) {
            out_.copy(trimmed_part(at, at + length), context_.sources);
            at += length;
            continue;
        }
        if (range_ends_.contains(at)) {
            out_.put("}", trimmed_part(at, at + 1));
            ++at;
            continue;
        }
        if (ahead.starts_with("\u00B0")) { // degrees
            at += 2;
            continue;
        }
        const bool is_name = is_letter(c) || !greek_letter(ahead).empty();
        at =
            is_name ? write_name(expression, at) : write_operator(at, expression.end, is_condition);
        if (at == kNone) {
            return;
        }
    }
}

std::size_t AbopWriter::write_name(SourceSpan expression, std::size_t at) {
    struct Word {
        std::string_view name;
        std::string_view in_lsys;
    };
    constexpr std::array<Word, 4> kWords{
        {{"and", "&&"}, {"or", "||"}, {"not", "!"}, {"degrees", ""}}};

    const std::string_view whole = file_.text;
    const std::string_view ahead = whole.substr(at, expression.end - at);
    const std::string_view greek = greek_letter(ahead);
    const std::size_t letters = greek.empty() ? 0 : 2;
    const std::size_t length = letters + word_length(ahead.substr(letters));
    const SourceSpan span = trimmed_part(at, at + length);
    const std::string name =
        std::string(greek) + std::string(ahead.substr(letters, length - letters));
    const std::size_t end = at + length;
    const std::size_t open = whole.find_first_not_of(kBlanks, end);
    const bool is_call = open < expression.end && whole[open] == '(';
    for (const Word& word : kWords) {
        if (word.name == name) {
            if (name == "not" && !is_call) {
                report(span, "write parentheses after `not`: `not (x > 1)`");
                return kNone;
            }
            out_.put(word.in_lsys, span);
            return end;
        }
    }
    constexpr std::array<std::string_view, 7> kRadians{"sin",  "cos",  "tan",  "asin",
                                                       "acos", "atan", "atan2"};
    if (is_call && file_.is_lpy &&
        std::find(kRadians.begin(), kRadians.end(), name) != kRadians.end()) {
        context_.diagnostics.add(DiagnosticCode::ForeignFeature, span,
                                 "`" + name + "` of Python has radians, that of lsc degrees");
        return kNone;
    }
    if (is_call && (name == "uniform" || name == "random" || name == "rand" || name == "ran" ||
                    name == "rnd")) {
        return write_random(span, open);
    }
    const bool is_own = formals_.contains(name) || constants_.contains(text(span));
    if (is_own || is_call) {
        out_.put(name, span);
        return end;
    }
    // An expression may also name a setting, such as the angle or the number of generations.
    const std::optional<AbopKey> key = abop_key(text(span));
    const AbopSetting* const setting = key ? file_.find(*key) : nullptr;
    if (setting != nullptr && is_value(*key) && depth_ < 2) {
        ++depth_;
        out_.put("(", span);
        write_expression(setting->value, false);
        out_.put(")", span);
        --depth_;
        return end;
    }
    out_.put(name == "pi" ? "3.1415927" : name, span);
    return end;
}

bool AbopWriter::find_parentheses(SourceSpan expression) {
    std::vector<std::size_t> open;
    for (std::size_t at = expression.begin; at < expression.end; ++at) {
        const char c = file_.text[at];
        if (!open.empty() && !is_one_of(c, kBlanks) && c != ')') {
            parentheses_[open.back()].is_empty = false;
        }
        if (c == '(') {
            parentheses_[at] = {};
            open.push_back(at);
        } else if (c == ',' && !open.empty()) {
            parentheses_[open.back()].has_comma = true;
        } else if (c == ')') {
            if (open.empty()) {
                report(trimmed_part(at, at + 1), "`)` has no `(`");
                return false;
            }
            parentheses_[open.back()].close = at;
            open.pop_back();
        }
    }
    if (!open.empty()) {
        report(trimmed_part(open.back(), open.back() + 1), "`(` is never closed");
    }
    return open.empty();
}

std::size_t AbopWriter::write_random(SourceSpan name, std::size_t open) {
    const Parentheses& found = parentheses_[open];
    range_ends_.insert(found.close);
    out_.put(found.is_empty ? "{0, 1" : found.has_comma ? "{" : "{0, ", name);
    return open + 1;
}

std::size_t AbopWriter::write_operator(std::size_t at, std::size_t end, bool is_condition) {
    struct Operator {
        std::string_view written;
        std::string_view in_lsys;
    };
    constexpr std::array<Operator, 22> kOperators{{
        {"==", "=="}, {"!=", "!="}, {"<=", "<="}, {">=", ">="}, {"<>", "!="}, {"&&", "&&"},
        {"||", "||"}, {"**", "^"},  {"&", "&&"},  {"|", "||"},  {"<", "<"},   {">", ">"},
        {"+", "+"},   {"-", "-"},   {"*", "*"},   {"/", "/"},   {"^", "^"},   {"(", "("},
        {")", ")"},   {",", ","},   {"!", "!"},   {"=", "=="},
    }};
    const std::string_view ahead = std::string_view(file_.text).substr(at, end - at);
    for (const Operator& each : kOperators) {
        if (ahead.starts_with(each.written) && (each.written != "=" || is_condition)) {
            out_.put(each.in_lsys, trimmed_part(at, at + each.written.size()));
            return at + each.written.size();
        }
    }
    const std::size_t length = decode_utf8(ahead).length;
    report(trimmed_part(at, at + length),
           "`" + shown(ahead.substr(0, length)) + "` cannot stand in an expression");
    return kNone;
}

} // namespace lsys
