// SPDX-License-Identifier: MIT
// .sys: the grammars of a forest program of 2005. A header `LSYSTEM`, the number of rules, the
// axiom, then a line `A R p` for each rule: symbol, replacement, probability. Its turtle is the
// profile `sys`.
#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/dialects/impl/frontends.h"
#include "grammar/dialects/impl/letter_modules.h"
#include "grammar/dialects/impl/line_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// A line `A R p` of the file.
struct SysRule {
    SourceSpan symbol;
    SourceSpan replacement;
    SourceSpan probability;
};

struct SysFile {
    std::optional<SourceSpan> count; // number of rules, as written
    std::optional<SourceSpan> axiom;
    std::vector<SysRule> rules;
};

constexpr std::string_view kHeader = "LSYSTEM";

/// Length in bytes of the word at the start of `ahead`. Parentheses of a word may hold blanks.
std::size_t word_length(std::string_view ahead) {
    std::size_t at = 0;
    while (at < ahead.size() && kWhitespace.find(ahead[at]) == std::string_view::npos) {
        if (ahead[at] == '(') {
            const std::size_t close = ahead.find_first_of("()\n", at + 1);
            if (close == std::string_view::npos || ahead[close] != ')') {
                break;
            }
            at = close;
        }
        ++at;
    }
    return at;
}

bool is_word(const LinePiece& piece) {
    return piece.kind == LinePieceKind::Text && piece.text != kHeader && piece.text != "(";
}

/// Reads the lines of a file; stops at a mistake before the rules.
SysFile read_file(FileId root, const ParseContext& context) {
    LineReader reader(whole_file(root, context), {" \t\r"}, context);
    const auto next = [&] { return reader.next(word_length); };
    SysFile file;
    LinePiece piece = next();
    const bool is_first = piece.kind != LinePieceKind::LineEnd;
    piece = is_first ? piece : next();
    const bool has_header = piece.text == kHeader;
    if (is_first ? !reader.expect(has_header, piece, {"the end of the line", "`LSYSTEM`"})
                 : !reader.expect(has_header, piece, {"`LSYSTEM`"})) {
        return file;
    }
    for (std::optional<SourceSpan>* const word : {&file.count, &file.axiom}) {
        if (!reader.expect_line_end(word_length)) {
            return file;
        }
        piece = next();
        if (!reader.expect(is_word(piece), piece, {"a word"})) {
            return file;
        }
        *word = piece.span;
    }
    if (!reader.expect_line_end(word_length)) {
        return file;
    }
    while ((piece = next()).kind != LinePieceKind::TextEnd) {
        std::array<SourceSpan, 3> words;
        std::size_t count = 0;
        for (; count < words.size() && is_word(piece); piece = next()) {
            words[count++] = piece.span;
        }
        const bool ends = piece.kind == LinePieceKind::LineEnd;
        bool fits = false;
        if (count == 0) {
            fits = reader.expect(ends, piece,
                                 {"the end of the file", "the end of the line", "a word"});
        } else if (count < words.size()) {
            fits = reader.expect(false, piece, {"a word"});
        } else {
            fits = reader.expect(ends, piece, {"the end of the line"});
        }
        if (fits && count != 0) {
            file.rules.push_back({words[0], words[1], words[2]});
        }
    }
    return file;
}

bool has_arguments(const LetterModule& module) {
    return module.arguments.begin != module.arguments.end;
}

/// Number of parameters of a module, counted by commas without parsing.
std::size_t count_parameters(const LetterModule& module, const ParseContext& context) {
    const std::string_view text = context.sources.text(module.arguments);
    return has_arguments(module)
               ? 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ','))
               : 0;
}

/// The formals `(p1, p2, p3)` of `count` parameters; empty if `count` is 0.
std::string formals(std::size_t count) {
    std::string text;
    for (std::size_t i = 1; i <= count; ++i) {
        text += (i == 1 ? "(p" : ", p") + std::to_string(i);
    }
    return count == 0 ? text : text + ")";
}

/// A symbol that is replaced, and the number of its parameters.
struct Replaced {
    char32_t character = 0;
    std::size_t parameters = 0;
};

/// Writes the modules of a word. If the symbol of `replaced` has no parameters in the word, it gets
/// the parameters of the module that the rule replaces.
void write_modules(SourceSpan text,
                   const Replaced& replaced,
                   const ParseContext& context,
                   Translation& translation) {
    read_letter_modules(text, context, [&](const LetterModule& module) {
        write_letter(module, context, translation);
        if (has_arguments(module)) {
            write_plain_arguments(module.arguments, context, translation);
        } else if (module.character == replaced.character) {
            translation.put(formals(replaced.parameters), module.span);
        }
    });
}

/// Parameter counts of each symbol. A symbol without parameters in its own successor is not
/// counted, because it gets the parameters of the module that the rule replaces.
using Arities = std::map<char32_t, std::set<std::size_t>>;

/// The symbol that a rule replaces, the last one if it has several; nullopt if it has none.
std::optional<char32_t> symbol_of(const SysRule& rule, const ParseContext& context) {
    Diagnostics ignored;
    const ParseContext quiet{context.sources, context.names, ignored, context.load};
    std::optional<char32_t> symbol;
    read_letter_modules(rule.symbol, quiet,
                        [&](const LetterModule& module) { symbol = module.character; });
    return symbol;
}

Arities find_arities(const SysFile& file, const ParseContext& context) {
    Diagnostics ignored; // mistakes are reported when the rules are written
    const ParseContext quiet{context.sources, context.names, ignored, context.load};
    Arities arities;
    const auto add = [&](SourceSpan text, std::optional<char32_t> replaced) {
        read_letter_modules(text, quiet, [&](const LetterModule& module) {
            if (has_arguments(module) || module.character != replaced) {
                arities[module.character].insert(count_parameters(module, quiet));
            }
        });
    };
    add(*file.axiom, std::nullopt);
    for (const SysRule& rule : file.rules) {
        add(rule.replacement, symbol_of(rule, context));
    }
    return arities;
}

/// Reports a stated number of rules that differs from the number of rules in the file.
void check_count(const SysFile& file, const ParseContext& context) {
    if (!file.count) {
        return;
    }
    const std::string_view text = context.sources.text(*file.count);
    std::uint32_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size()) {
        context.diagnostics.add(DiagnosticCode::ForeignValue, *file.count,
                                "expected the number of rules, found `" + shown(text) + "`");
    } else if (count != file.rules.size() && !context.diagnostics.has_errors()) {
        context.diagnostics.add(DiagnosticCode::ForeignValue, *file.count,
                                "the file states " + std::string(text) +
                                    " as its number of rules, but has " +
                                    std::to_string(file.rules.size()));
    }
}

/// Writes a rule as a production for its symbol with `parameters` parameters. `certain`: the rule
/// needs no probability.
void write_rule(const SysRule& rule,
                const std::string& name,
                std::size_t parameters,
                bool certain,
                const ParseContext& context,
                Translation& translation) {
    const SourceSpan whole = join(rule.symbol, rule.probability);
    int modules = 0;
    SourceSpan second;
    Replaced replaced{0, parameters};
    translation.put("#" + name + " : ", whole);
    read_letter_modules(rule.symbol, context, [&](const LetterModule& module) {
        second = ++modules == 2 ? module.span : second;
        if (module.arguments.begin != module.arguments.end) {
            context.diagnostics.add(DiagnosticCode::ForeignSyntax, module.arguments,
                                    "the symbol that a rule replaces has no parameters");
        }
        write_letter(module, context, translation);
        translation.put(formals(parameters), module.span);
        replaced.character = module.character;
    });
    if (modules > 1) {
        context.diagnostics.add(DiagnosticCode::ForeignSyntax, second,
                                "a rule replaces one symbol");
    }
    translation.put(" : ", rule.symbol);
    const std::string_view probability = context.sources.text(rule.probability);
    if (literal_length(probability) != probability.size()) {
        context.diagnostics.add(DiagnosticCode::ForeignValue, rule.probability,
                                "`" + shown(probability) + "` is not a probability");
    }
    if (certain) {
        translation.put("*", rule.probability);
    } else {
        translation.put("~ ", rule.probability);
        translation.copy(rule.probability, context.sources);
    }
    translation.put(" : ", rule.replacement);
    write_modules(rule.replacement, replaced, context, translation);
    translation.put(";\n", {whole.file, whole.end, whole.end});
}

/// Reports, as a note, that a rule without parameters is applied to its symbol with parameters.
void note_reading(const SysRule& rule, std::size_t parameters, const ParseContext& context) {
    const std::string symbol(context.sources.text(rule.symbol));
    Diagnostic note =
        make_diagnostic(DiagnosticCode::ForeignQuirk, rule.symbol,
                        "`" + symbol + "` with " + std::to_string(parameters) +
                            (parameters == 1 ? " parameter" : " parameters") +
                            " is replaced too: the format does not say whether a rule meets it");
    note.severity = Severity::Note;
    note.help.push_back("each `" + symbol +
                        "` without parameters in its successor keeps those of "
                        "the module that it replaces");
    context.diagnostics.add(std::move(note));
}

} // namespace

std::string_view recognise_sys(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kWhitespace);
    if (begin == std::string_view::npos || text.substr(begin, kHeader.size()) != kHeader) {
        return {};
    }
    const std::string_view rest = text.substr(begin + kHeader.size());
    return rest.empty() || rest.find_first_of(kWhitespace) == 0 ? "its first word, `LSYSTEM`"
                                                                : std::string_view();
}

void translate_sys(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const SysFile file = read_file(translation.file(), context);
    check_count(file, context);
    if (!file.axiom) {
        return;
    }
    translation.put("#set turtle " + std::string(row.turtle) + ";\n#set names letters;\n\n#w : ");
    write_modules(*file.axiom, {}, context, translation);
    translation.put(";\n\n");
    std::map<std::string_view, std::size_t> alternatives;
    for (const SysRule& rule : file.rules) {
        ++alternatives[context.sources.text(rule.symbol)];
    }
    const Arities arities = find_arities(file, context);
    std::set<std::pair<char32_t, std::size_t>> noted;
    for (std::size_t i = 0; i < file.rules.size(); ++i) {
        const SysRule& rule = file.rules[i];
        const std::string_view probability = context.sources.text(rule.probability);
        const bool certain = alternatives[context.sources.text(rule.symbol)] == 1 &&
                             literal_length(probability) == probability.size() &&
                             read_literal(probability).value == 1.0F;
        const std::optional<char32_t> symbol = symbol_of(rule, context);
        const auto found = symbol ? arities.find(*symbol) : arities.end();
        const std::set<std::size_t> counts =
            found == arities.end() ? std::set<std::size_t>{0} : found->second;
        const std::string name = "r" + std::to_string(i + 1);
        for (const std::size_t count : counts) {
            const bool is_first = count == *counts.begin();
            write_rule(rule, is_first ? name : name + "_" + std::to_string(count), count, certain,
                       context, translation);
            if (count != 0 && noted.insert({*symbol, count}).second) {
                note_reading(rule, count, context);
            }
        }
    }
}

} // namespace lsys
