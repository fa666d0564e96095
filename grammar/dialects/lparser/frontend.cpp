// SPDX-License-Identifier: MIT
// .ls: the files of Lparser (Laurens Lapre). Recursion depth, basic angle and thickness, the axiom,
// rules `A=...` of one symbol, and a line `@`; or the same as lines with keywords, `recursion 12`
// and `rule A = ...`. The turtle is the profile `houdini`, which scales step, width and angle; each
// command of Lparser becomes modules of this profile.
//
// Lparser draws a segment as thick as its length times the thickness. Here the width is that of a
// segment of the current step, so what scales the step scales the width, too.
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/line_reader.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r";

/// A command of Lparser as modules of the profile `houdini`. In `with`, `#` stands for the
/// parameter.
struct Command {
    char symbol;
    std::string_view bare;
    std::string_view with;
};
constexpr std::array kCommands{
    Command{'+', "-", "-#"},
    Command{'-', "+", "+#"},
    Command{'&', "^", "^#"},
    Command{'^', "&", "&#"},
    Command{'<', "\\", "\\#"},
    Command{'>', "/", "/#"},
    Command{'|', "|", "|"},
    Command{'%', "`*`", "`*`"},
    Command{'$', "$", "$"},
    Command{'!', "!(0.7)", "!#"},
    Command{'?', "!(1/0.7)", "!#"},
    Command{':', "`;`(0.9)", "`;`#"},
    Command{';', "`;`(1/0.9)", "`;`#"},
    Command{'\'', "\"(0.9)!(0.9)", "\"#!#"},
    Command{'"', "\"(1/0.9)!(1/0.9)", "\"#!#"},
    Command{'F', "F", "F#"},
    Command{'f', "f", "f#"},
    Command{'g', "G", "G#"},
    Command{'Z', "!(0.5)H!(2)", "F#"},
    Command{'z', "h", "f#"},
    Command{'c', "'", "'#"},
    Command{'[', "[", "["},
    Command{']', "]", "]"},
    Command{'{', "{", "{"},
    Command{'}', "}", "}"},
    Command{'.', ".", "."},
    Command{'~', "+({-6, 6})^({-6, 6})/({-6, 6})", "+({-#, #})^({-#, #})/({-#, #})"},
};
/// Symbols that are commands only in the profile `houdini`.
constexpr std::string_view kRenamed = "GHJKMh*";

/// The colours of Lparser from index 2 on.
constexpr std::array<std::string_view, 14> kColours{
    "0.8 0.4 0.4", "0.8 0.8 0.4", "0.4 0.8 0.4",    "0.4 0.8 0.8", "0.4 0.4 0.8",
    "0.8 0.4 0.8", "0.2 0.5 0.2", "0.2 0.5 0.5",    "0.2 0.2 0.5", "0.5 0.2 0.5",
    "0.6 0.2 0.2", "0.5 0.5 0.5", "0.75 0.75 0.75", "1 1 1"};

/// Keywords of the newer format; `lsys` is empty if lsc ignores the value.
struct Keyword {
    std::string_view name;
    std::string_view lsys;
};
constexpr std::array kKeywords{
    Keyword{"recursion", "#n = "}, Keyword{"angle", "#set angle "},
    Keyword{"thickness", "width"}, Keyword{"axiom", "axiom"},
    Keyword{"rule", "rule"},       Keyword{"color", "colour"},
    Keyword{"min_thickness", ""},  Keyword{"mutation", ""},
    Keyword{"shape", ""},          Keyword{"switch_yz", ""},
    Keyword{"poly_limit", ""},     Keyword{"trace", ""},
    Keyword{"no_wait", ""},        Keyword{"trope", ""},
    Keyword{"rand", ""},
};
constexpr auto kKeywordNames = [] {
    std::array<std::string_view, kKeywords.size()> names;
    std::transform(kKeywords.begin(), kKeywords.end(), names.begin(),
                   [](const Keyword& keyword) { return keyword.name; });
    return names;
}();

const Command* find_command(char32_t symbol) {
    const auto* const found =
        std::find_if(kCommands.begin(), kCommands.end(), [&](const Command& command) {
            return static_cast<unsigned char>(command.symbol) == symbol;
        });
    return found == kCommands.end() ? nullptr : &*found;
}

/// Whether a command is one module, which a rule can replace.
bool is_single(const Command& command) {
    return command.symbol == '%' || (command.bare.size() == 1 && command.symbol != 'z');
}

const Keyword* find_keyword(std::string_view line) {
    const std::size_t end = length_up_to(line, kBlanks);
    const auto* const found =
        std::find_if(kKeywords.begin(), kKeywords.end(),
                     [&](const Keyword& keyword) { return keyword.name == line.substr(0, end); });
    return found == kKeywords.end() || end == line.size() ? nullptr : &*found;
}

struct Rule {
    SourceSpan left;
    SourceSpan right;
};

struct LparserFile {
    std::optional<SourceSpan> recursion;
    std::optional<SourceSpan> angle;
    std::optional<SourceSpan> thickness;
    std::optional<SourceSpan> axiom;
    std::vector<Rule> rules;
    std::vector<SourceSpan> colours; // index and three parts
};

/// The lines of a file up to `@`, without comments and blanks at their ends.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        line = trimmed(line.substr(0, length_up_to(line, "#")));
        at = end + 1;
        if (line == "@") {
            break;
        }
        if (!line.empty()) {
            lines.push_back(line);
        }
    }
    return lines;
}

class LparserReader {
public:
    LparserReader(FileId root, const ParseContext& context)
        : root_(root), context_(context), text_(context.sources.file(root).text()) {}

    LparserFile read() {
        const std::vector<std::string_view> lines = lines_of(text_);
        const bool has_keywords = !lines.empty() && find_keyword(lines.front()) != nullptr;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            has_keywords ? read_keyword(lines[i]) : read_plain(lines[i], i);
        }
        if (!file_.axiom && !context_.diagnostics.has_errors()) {
            context_.diagnostics.add(DiagnosticCode::ForeignSyntax, {root_, 0, 0},
                                     "the file has no axiom");
        }
        return std::move(file_);
    }

private:
    [[nodiscard]] SourceSpan span(std::string_view part) const {
        const auto begin = static_cast<std::uint32_t>(part.data() - text_.data());
        return {root_, begin, begin + static_cast<std::uint32_t>(part.size())};
    }

    void
    read_number(std::string_view value, std::string_view what, std::optional<SourceSpan>& setting) {
        const SourceSpan place = span(value);
        if (is_number(value, "-")) {
            setting = place;
        } else if (!report_foreign_look_alike(place, context_)) {
            context_.diagnostics.add(DiagnosticCode::ForeignValue, place,
                                     "`" + shown(value) + "` is not a number, the " +
                                         std::string(what));
        }
    }

    void read_plain(std::string_view line, std::size_t index) {
        switch (index) {
        case 0:
            read_number(line, "recursion depth", file_.recursion);
            break;
        case 1:
            read_number(line, "basic angle", file_.angle);
            break;
        case 2:
            read_number(line, "thickness", file_.thickness);
            break;
        case 3:
            file_.axiom = span(line);
            break;
        default:
            read_rule(line);
        }
    }

    void read_rule(std::string_view line) {
        const std::size_t equals = line.find('=', 1);
        const std::string_view left = trimmed(line.substr(0, std::min(equals, line.size())));
        if (equals == std::string_view::npos || left.size() != 1) {
            const std::string_view place = equals == std::string_view::npos ? line : left;
            if (!std::exchange(has_other_, true) &&
                !report_foreign_look_alike(span(place), context_)) {
                context_.diagnostics.add(DiagnosticCode::ForeignSyntax, span(place),
                                         "a rule is one symbol, `=` and its replacement");
            }
            return;
        }
        file_.rules.push_back({span(left), span(trimmed(line.substr(equals + 1)))});
    }

    void read_keyword(std::string_view line) {
        const Keyword* const keyword = find_keyword(line);
        const std::size_t end = length_up_to(line, kBlanks);
        const std::string_view value = trimmed(line.substr(end));
        if (keyword == nullptr) {
            const SourceSpan place = span(line.substr(0, end));
            Diagnostic& error = context_.diagnostics.add(
                DiagnosticCode::ForeignKey, place,
                "`" + shown(line.substr(0, end)) + "` is not a keyword of Lparser with a value");
            suggest_key(error, place, line.substr(0, end), kKeywordNames);
        } else if (keyword->name == "recursion") {
            read_number(value, "recursion depth", file_.recursion);
        } else if (keyword->name == "angle") {
            read_number(value, "basic angle", file_.angle);
        } else if (keyword->name == "thickness") {
            read_number(value, "thickness", file_.thickness);
        } else if (keyword->name == "axiom") {
            file_.axiom = span(value);
        } else if (keyword->name == "rule") {
            read_rule(value);
        } else if (keyword->name == "color") {
            file_.colours.push_back(span(value));
        } else if (keyword->name == "mutation" || keyword->name == "min_thickness" ||
                   keyword->name == "trope" || keyword->name == "rand") {
            context_.diagnostics.add(DiagnosticCode::ForeignIgnored, span(line.substr(0, end)),
                                     "`" + std::string(keyword->name) + "` has no effect here");
        }
    }

    FileId root_;
    const ParseContext& context_;
    std::string_view text_;
    LparserFile file_;
    bool has_other_ = false; // one line that is no rule is reported
};

class LparserWriter {
public:
    LparserWriter(const LparserFile& file, const ParseContext& context, Translation& out)
        : file_(file), context_(context), out_(out) {
        for (const Rule& rule : file.rules) {
            const auto symbol = static_cast<unsigned char>(text(rule.left)[0]);
            rewritten_.insert({symbol, rule.left});
        }
        find_parameters();
    }

    void write(std::string_view turtle) {
        out_.put("#set turtle " + std::string(turtle) + ";\n#set names letters;\n");
        write_value("#n = ", file_.recursion, "");
        write_value("#set angle ", file_.angle, "");
        write_value("#set width (", file_.thickness, "/100)");
        write_colours();
        out_.put("\n#w : ", *file_.axiom);
        write_modules(*file_.axiom);
        out_.put(";\n\n");
        std::size_t index = 0;
        for (const Rule& rule : file_.rules) {
            ++index;
            if (rewritten_.at(static_cast<unsigned char>(text(rule.left)[0])).begin !=
                rule.left.begin) {
                context_.diagnostics.add(DiagnosticCode::ForeignQuirk, rule.left,
                                         "Lparser takes the first of two rules for a symbol");
                continue;
            }
            const bool has_parameter = with_parameter_.contains(text(rule.left)[0]);
            if (!has_parameter || without_.contains(text(rule.left)[0])) {
                write_rule(rule, "#r" + std::to_string(index), {});
            }
            if (has_parameter) {
                write_rule(rule, "#r" + std::to_string(index) + "p", "x");
            }
        }
        write_drawings();
        for (const auto& [name, span] : idle_) {
            out_.put("#module " + name + ";\n", span);
        }
    }

private:
    [[nodiscard]] std::string_view text(SourceSpan span) const {
        return context_.sources.text(span);
    }

    void write_value(std::string_view before,
                     const std::optional<SourceSpan>& value,
                     std::string_view after) {
        if (value) {
            out_.put(before, *value);
            out_.copy(*value, context_.sources);
            out_.put(after, *value);
            out_.put(";\n");
        }
    }

    /// Writes the colours of the file, or those of Lparser, if the file uses colours.
    void write_colours() {
        std::map<std::string, bool> own;
        for (const SourceSpan span : file_.colours) {
            std::vector<std::string> numbers;
            std::string_view rest = text(span);
            while (!rest.empty()) {
                const std::size_t end = length_up_to(rest, kBlanks);
                numbers.emplace_back(rest.substr(0, end));
                rest = trimmed(rest.substr(end));
            }
            const bool fits = numbers.size() == 4 &&
                              std::all_of(numbers.begin(), numbers.end(),
                                          [](const std::string& each) { return is_number(each); });
            if (!fits) {
                context_.diagnostics.add(DiagnosticCode::ForeignSyntax, span,
                                         "a colour is an index, red, green and blue");
            } else if (own.emplace(numbers[0], true).second) {
                std::string parts;
                for (std::size_t i = 1; i < 4; ++i) {
                    parts += " (" + numbers[i] + "/255)";
                }
                out_.put("#material " + numbers[0] + " colour" + parts, span);
                out_.put(";\n");
            }
        }
        bool uses_colours = text(*file_.axiom).find('c') != std::string_view::npos;
        for (const Rule& rule : file_.rules) {
            uses_colours = uses_colours || text(rule.right).find('c') != std::string_view::npos;
        }
        for (std::size_t i = 0; i < kColours.size() && uses_colours; ++i) {
            const std::string index = std::to_string(i + 2);
            if (!own.contains(index)) {
                out_.put("#material " + index + " colour " + std::string(kColours[i]) + ";\n",
                         *file_.axiom);
            }
        }
    }

    /// The name of a symbol without a command, or of a rewritten command, in .lsys.
    std::string name_of(char32_t symbol) {
        const std::string spelled = spelled_letter(symbol);
        const bool is_renamed = symbol < 0x80 && is_one_of(static_cast<char>(symbol), kRenamed);
        const bool is_letter_name = spelled.size() == 1 && is_letter(spelled[0]);
        if (is_renamed) {
            const std::string letter(1, static_cast<char>(symbol));
            out_.replace_name("_" + letter, letter);
            return "`_" + letter + "`";
        }
        return is_letter_name || spelled[0] == '`' ? spelled : "`_" + spelled + "`";
    }

    /// Finds the symbols that occur with and without a parameter. Lparser replaces text, so the
    /// parameter of a symbol becomes one of the last symbol of its replacement.
    void find_parameters() {
        std::map<char, std::string_view> right_sides;
        for (const Rule& rule : file_.rules) {
            right_sides.emplace(text(rule.left)[0], text(rule.right));
        }
        std::vector<std::pair<char, bool>> open; // symbols, with a parameter or without
        const auto add = [&](char symbol, bool has_parameter) {
            if ((has_parameter ? with_parameter_ : without_).insert(symbol).second) {
                open.emplace_back(symbol, has_parameter);
            }
        };
        // `last_has`: whether the last symbol gets a parameter.
        const auto add_all = [&](std::string_view list, bool last_has) {
            for (std::size_t at = 0; at < list.size();) {
                const std::size_t next = list.find_first_not_of(kBlanks, at + 1);
                const bool is_last = next == std::string_view::npos;
                const bool has_own = !is_last && list[next] == '(';
                add(list[at], has_own || (is_last && last_has));
                const std::size_t close = has_own ? list.find(')', next) : next;
                at = close == std::string_view::npos ? list.size() : has_own ? close + 1 : next;
                at = std::min(list.find_first_not_of(kBlanks, at), list.size());
            }
        };
        if (file_.axiom) {
            add_all(text(*file_.axiom), false);
        }
        while (!open.empty()) {
            const auto [symbol, has_parameter] = open.back();
            open.pop_back();
            if (const auto rule = right_sides.find(symbol); rule != right_sides.end()) {
                add_all(rule->second, has_parameter);
            }
        }
    }

    /// Writes a production for a symbol without a parameter, or with the parameter `parameter`.
    void write_rule(const Rule& rule, const std::string& label, std::string_view parameter) {
        const auto symbol = static_cast<unsigned char>(text(rule.left)[0]);
        const Command* const command = find_command(symbol);
        if (is_one_of(static_cast<char>(symbol), "[]{}.()")) {
            context_.diagnostics.add(DiagnosticCode::ForeignFeature, rule.left,
                                     "a rule for a bracket, a dot or a parenthesis");
            return;
        }
        out_.put(label + " : ", rule.left);
        out_.put(command != nullptr && is_single(*command) ? std::string(command->bare)
                                                           : name_of(symbol),
                 rule.left);
        out_.put(parameter.empty() ? "" : "(" + std::string(parameter) + ")", rule.left);
        out_.put(" : * : ", rule.left);
        write_modules(rule.right, parameter);
        out_.put(";\n", {out_.file(), rule.right.end, rule.right.end});
    }

    /// Whether a command stays a module of its own, which an `#interpret` production draws.
    [[nodiscard]] bool is_deferred(const Command& command) const {
        const auto has_rule = [&](char symbol) {
            return rewritten_.contains(static_cast<unsigned char>(symbol));
        };
        return (has_rule(command.symbol) && !is_single(command)) ||
               (command.symbol == 'z' && has_rule('f')) || (command.symbol == 'Z' && has_rule('F'));
    }

    /// Writes a command, whose parameter is `argument`, as modules of the turtle.
    static std::string modules_of(const Command& command, std::string_view argument) {
        if (argument.empty()) {
            return std::string(command.bare);
        }
        std::string modules;
        const bool is_random = command.symbol == '~';
        for (const char c : command.with) {
            if (c == '#') {
                modules += is_random ? std::string(trimmed(argument, "-"))
                                     : "(" + std::string(argument) + ")";
            } else {
                modules += c;
            }
        }
        return modules;
    }

    /// `tail`: parameter of the last module, if it has none of its own and is no bracket.
    void write_modules(SourceSpan list, std::string_view tail = {}) {
        std::size_t polygons = 0; // open `{`
        read_letter_modules(list, context_, [&](const LetterModule& module) {
            polygons += module.character == '{' ? 1U : 0U;
            polygons -= module.character == '}' && polygons != 0 ? 1U : 0U;
            const bool is_last = module.arguments.end == list.end;
            write_module(module, polygons != 0, is_last ? tail : std::string_view());
        });
    }

    void write_module(const LetterModule& module, bool in_polygon, std::string_view tail) {
        const bool has_argument = module.arguments.begin != module.arguments.end;
        const std::string_view symbol = text(module.span);
        if (symbol == "(" || symbol == ")") {
            if (has_stray_ && symbol == ")") {
                return; // of the `(` that has been reported
            }
            has_stray_ = true;
            context_.diagnostics.add(DiagnosticCode::ForeignFeature, module.span,
                                     "a parameter without a symbol: Lparser replaces text, and "
                                     "gives it to the symbol before");
            return;
        }
        std::string_view argument = is_one_of(symbol[0], "[]{}.|$%") ? std::string_view() : tail;
        if (has_argument) {
            const std::string_view inner = text(module.arguments);
            argument = trimmed(inner.substr(1, inner.size() - 2));
            if (!is_number(argument, "-")) {
                context_.diagnostics.add(DiagnosticCode::ForeignValue, module.arguments,
                                         "`" + shown(argument) + "` is not a number");
                return;
            }
        }
        const Command* const command = find_command(module.character);
        const bool is_rewritten = module.character < 0x100 &&
                                  rewritten_.contains(static_cast<unsigned char>(module.character));
        if (command == nullptr) {
            write_symbol(module, argument, is_rewritten);
            return;
        }
        if (is_deferred(*command)) {
            drawn_.insert_or_assign(command->symbol, module.span);
            out_.put(name_of(module.character) +
                         (argument.empty() ? "" : "(" + std::string(argument) + ")"),
                     module.span);
        } else {
            out_.put(modules_of(*command, argument), module.span);
        }
        // Only `f`, `z` and `.` are corners of a polygon, and the start is none.
        out_.put(in_polygon && (symbol == "f" || symbol == "z") ? "." : "", module.span);
    }

    void write_symbol(const LetterModule& module, std::string_view argument, bool is_rewritten) {
        const std::string name = name_of(module.character);
        out_.put(name, module.span);
        if (!argument.empty()) {
            out_.put("(" + std::string(argument) + ")", module.span);
        }
        if (module.character == 't' && !is_rewritten && !has_warned_) {
            has_warned_ = true;
            context_.diagnostics.add(DiagnosticCode::ForeignLoss, module.span,
                                     "`t` does not bend the plant here; `#set tropism` of an "
                                     "imported file bends all segments");
        }
        if (!is_rewritten) {
            idle_.emplace(name + (argument.empty() ? "" : "(x)"), module.span);
        }
    }

    /// Writes how commands that are several modules, and that rules replace, draw.
    void write_drawings() {
        std::size_t index = 0;
        for (const auto& [symbol, span] : drawn_) {
            const Command& command = *find_command(static_cast<unsigned char>(symbol));
            for (const std::string_view parameter : {"", "x"}) {
                if (!(parameter.empty() ? without_ : with_parameter_).contains(symbol)) {
                    continue;
                }
                out_.put("#interpret draw" + std::to_string(++index) + " : " +
                             name_of(static_cast<unsigned char>(symbol)) +
                             (parameter.empty() ? "" : "(x)") +
                             " : * : " + modules_of(command, parameter) + ";\n",
                         span);
            }
        }
    }

    const LparserFile& file_;
    const ParseContext& context_;
    Translation& out_;
    std::map<unsigned char, SourceSpan> rewritten_; // symbols with a rule: the first
    std::set<char> without_;                        // symbols that occur without a parameter
    std::set<char> with_parameter_;                 // symbols that can have a parameter
    std::map<char, SourceSpan> drawn_;              // rewritten commands of several modules
    std::map<std::string, SourceSpan> idle_;        // symbols that do nothing
    bool has_warned_ = false;
    bool has_stray_ = false; // a `(` without a symbol has been reported
};

} // namespace

std::string_view recognise_lparser(std::string_view text) {
    const std::vector<std::string_view> lines = lines_of(text);
    if (lines.size() < 4) {
        return {};
    }
    const bool has_keywords = std::any_of(lines.begin(), lines.end(), [](std::string_view line) {
        return line.starts_with("recursion ") || line.starts_with("rule ");
    });
    if (find_keyword(lines.front()) != nullptr && has_keywords) {
        return "its lines `recursion` and `rule`";
    }
    const auto numbers = std::count_if(lines.begin(), lines.begin() + 3,
                                       [](std::string_view line) { return is_number(line, "-"); });
    const auto rules = std::count_if(lines.begin() + 4, lines.end(), [](std::string_view line) {
        return line.size() > 1 && trimmed(line.substr(1)).starts_with('=');
    });
    // One line of each may have a mistake.
    const bool has_numbers = numbers >= 2;
    const bool has_rules = rules + 1 >= static_cast<std::ptrdiff_t>(lines.size()) - 4;
    return has_numbers && has_rules ? "its beginning, a line for each of three numbers,"
                                    : std::string_view();
}

void translate_lparser(const DialectRow& row,
                       const ParseContext& context,
                       Translation& translation) {
    const LparserFile file = LparserReader(translation.file(), context).read();
    if (!context.diagnostics.has_errors()) {
        LparserWriter(file, context, translation).write(row.turtle);
    }
}

} // namespace lsys
