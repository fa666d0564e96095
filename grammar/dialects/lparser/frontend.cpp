// SPDX-License-Identifier: MIT
// .ls: the files of Lparser (Laurens Lapre). Recursion depth, basic angle and thickness, the axiom,
// rules `A=...` of one symbol, and a line `@`; or the same values as lines with keywords,
// `recursion 12` and `rule A = ...`. The turtle is the profile `houdini`, which scales step, width
// and angle; each command of Lparser becomes modules of this profile.
//
// Lparser draws a segment as thick as its length times the thickness. Here the width is that of a
// segment of the current step, so a command that scales the step scales the width, too.
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/text.h"
#include "grammar/dialects/lparser/reader.h"
#include "grammar/dialects/repeated_messages.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::string_view kBlanks = " \t\r";

/// A command of Lparser as modules of the profile `houdini`. `bare`: without a parameter; `with`:
/// with a parameter, for which `#` stands.
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
    Command{'t', "`bend`(0.2)", "`bend`#"},
    Command{'~', "+({-6, 6})^({-6, 6})/({-6, 6})", "+({-#, #})^({-#, #})/({-#, #})"},
};
/// Symbols that are commands only in the profile `houdini`.
constexpr std::string_view kRenamed = "GHJKMh*";

/// The colours of Lparser from index 2 on.
constexpr std::array<std::string_view, 14> kColours{
    "0.8 0.4 0.4", "0.8 0.8 0.4", "0.4 0.8 0.4",    "0.4 0.8 0.8", "0.4 0.4 0.8",
    "0.8 0.4 0.8", "0.2 0.5 0.2", "0.2 0.5 0.5",    "0.2 0.2 0.5", "0.5 0.2 0.5",
    "0.6 0.2 0.2", "0.5 0.5 0.5", "0.75 0.75 0.75", "1 1 1"};

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

class LparserWriter {
public:
    LparserWriter(const LparserFile& file, const ParseContext& context, Translation& out)
        : file_(file), context_(context), out_(out) {
        for (const LparserRule& rule : file.rules) {
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
        for (const LparserRule& rule : file_.rules) {
            ++index;
            if (rewritten_.at(static_cast<unsigned char>(text(rule.left)[0])).begin !=
                rule.left.begin) {
                mark_lost_statement(
                    context_.diagnostics.add(DiagnosticCode::ForeignQuirk, rule.left,
                                             "Lparser takes the first of two rules for a symbol"));
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
        if (bend_) {
            out_.put("#object `bend` BEND;\n", *bend_);
        }
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
        std::map<std::string, bool> file_colours;
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
            } else if (file_colours.emplace(numbers[0], true).second) {
                std::string parts;
                for (std::size_t i = 1; i < 4; ++i) {
                    parts += " (" + numbers[i] + "/255)";
                }
                out_.put("#material " + numbers[0] + " colour" + parts, span);
                out_.put(";\n");
            }
        }
        bool uses_colours = text(*file_.axiom).find('c') != std::string_view::npos;
        for (const LparserRule& rule : file_.rules) {
            uses_colours = uses_colours || text(rule.right).find('c') != std::string_view::npos;
        }
        for (std::size_t i = 0; i < kColours.size() && uses_colours; ++i) {
            const std::string index = std::to_string(i + 2);
            if (!file_colours.contains(index)) {
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
        for (const LparserRule& rule : file_.rules) {
            right_sides.emplace(text(rule.left)[0], text(rule.right));
        }
        std::vector<std::pair<char, bool>> open; // to visit: symbol, whether it has a parameter
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
    void write_rule(const LparserRule& rule, const std::string& label, std::string_view parameter) {
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
    [[nodiscard]] std::string modules_of(const Command& command, std::string_view argument) const {
        if (argument.empty() && command.symbol == 't' && file_.trope) {
            argument = text(*file_.trope);
        }
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

    /// `tail`: parameter for the last module of the list, if that module has none of its own and is
    /// no bracket.
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
                return; // the stray `(` has been reported
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
        if (command == nullptr) {
            write_symbol(module, argument);
            return;
        }
        if (command->symbol == 't' && !bend_) {
            bend_ = module.span;
        }
        if (is_deferred(*command)) {
            drawn_.insert_or_assign(command->symbol, module.span);
            out_.put(name_of(module.character) +
                         (argument.empty() ? "" : "(" + std::string(argument) + ")"),
                     module.span);
        } else {
            out_.put(modules_of(*command, argument), module.span);
        }
        // The corners of a polygon are the ends of `f` and `z` and the places of `.`, without the
        // start.
        out_.put(in_polygon && (symbol == "f" || symbol == "z") ? "." : "", module.span);
    }

    void write_symbol(const LetterModule& module, std::string_view argument) {
        const bool is_rewritten = module.character < 0x100 &&
                                  rewritten_.contains(static_cast<unsigned char>(module.character));
        const std::string name = name_of(module.character);
        out_.put(name, module.span);
        if (!argument.empty()) {
            out_.put("(" + std::string(argument) + ")", module.span);
        }
        if (!is_rewritten) {
            idle_.emplace(name + (argument.empty() ? "" : "(x)"), module.span);
        }
    }

    /// Writes the `#interpret` productions of the commands that rules replace and that several
    /// modules draw.
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
    std::map<unsigned char, SourceSpan> rewritten_; // the first rule of each symbol with rules
    std::set<char> without_;                        // symbols that occur without a parameter
    std::set<char> with_parameter_;                 // symbols that can have a parameter
    std::map<char, SourceSpan> drawn_;              // rewritten commands of several modules
    std::map<std::string, SourceSpan> idle_;        // symbols that do nothing
    std::optional<SourceSpan> bend_;                // the first `t`
    bool has_stray_ = false;                        // a `(` without a symbol has been reported
};

} // namespace

void translate_lparser(const DialectRow& row,
                       const ParseContext& context,
                       Translation& translation) {
    const LparserFile file = read_lparser(translation.file(), context);
    if (!context.diagnostics.has_errors()) {
        LparserWriter(file, context, translation).write(row.turtle);
    }
}

} // namespace lsys
