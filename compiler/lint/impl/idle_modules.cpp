// SPDX-License-Identifier: MIT
// Modules that are never rewritten and never drawn, and objects for modules that never occur.
#include "compiler/lint/impl/module_use.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/suggestions.h"
#include "grammar/base/synonyms.h"
#include "grammar/base/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr const char* kIdleLabel = "stays in the word and does nothing";

/// Names of modules that are rewritten or drawn, in order of appearance.
std::vector<std::string_view> working_names(const CheckInput& input, const ModuleUse& use) {
    std::vector<std::string_view> names;
    for (std::uint32_t s = 0; s < input.program.symbols.size(); ++s) {
        const Symbol& row = input.program.symbols[s];
        if (row.kind == SymbolKind::Plain &&
            (use.first_production[s] != kNone || row.turtle != TurtleOperation::Nothing)) {
            names.push_back(input.name(SymbolId{s}));
        }
    }
    for (const ObjectBinding& object : input.program.objects) {
        names.push_back(input.name(object.name));
    }
    return names;
}

/// Formals of `#module` for a module of `count` parameters: `(a, b)`; nothing for 0.
std::string formals_text(std::uint32_t count) {
    std::string text;
    for (std::uint32_t i = 0; i < count; ++i) {
        constexpr std::uint32_t kLetters = 26;
        const std::string name =
            i < kLetters ? std::string(1, static_cast<char>('a' + i)) : fmt::format("x{}", i);
        text += (i == 0 ? "(" : ", ") + name;
    }
    return count == 0 ? text : text + ")";
}

/// Whether only the turtle profile `houdini` draws modules of this name.
bool is_houdini_object(const CheckInput& input, std::string_view name) {
    return name.size() == 1 && std::string_view("JKM").find(name[0]) != std::string_view::npos &&
           input.program.settings.turtle != TurtleProfile::Houdini;
}

/// Whether the name is one character that no other program explains.
bool is_unexplained_letter(const CheckInput& input, SymbolId symbol) {
    const std::string_view name = input.name(symbol);
    return decode_utf8(name).length == name.size() &&
           find_synonym(SynonymKind::Module, name) == nullptr && !is_houdini_object(input, name);
}

std::string declaration_help(const CheckInput& input, SymbolId symbol, SourceSpan span) {
    return fmt::format("draw it with `#object {0} SPHERE;`, or, if it is to do nothing, declare it "
                       "with `#module {0}{1};`",
                       input.sources.text(span),
                       formals_text(input.program.symbol(symbol).parameter_count));
}

/// The names to suggest in place of names of idle modules.
struct WorkingNames {
    std::vector<std::string_view> names;
    Suggestions suggestions;
};

void report_idle_name(const CheckInput& input,
                      const ModuleUse& use,
                      SymbolId symbol,
                      WorkingNames& working,
                      Diagnostics& diagnostics) {
    const std::string_view name = input.name(symbol);
    const ModuleMention place = use.first_place[static_cast<std::size_t>(symbol)];
    const SourceSpan span = module_name_span(input, *place.word, place.index);
    Diagnostic& diagnostic =
        diagnostics.add(DiagnosticCode::IdleModule, span,
                        fmt::format("module {} is never rewritten and never drawn", quoted(name)));
    diagnostic.label = kIdleLabel;
    const Synonym* const synonym = find_synonym(SynonymKind::Module, name);
    if (synonym != nullptr) {
        diagnostic.help.push_back(help_for(*synonym, name));
        add_fix(diagnostic, fmt::format("write `{}`", synonym->spelling), span,
                std::string(synonym->spelling), false);
    } else if (is_houdini_object(input, name)) {
        diagnostic.help.push_back(
            fmt::format("{} of Houdini draws an object with `#set turtle houdini;` alone; "
                        "otherwise bind one: `#object {} {};`",
                        quoted(name), name, name == "J" ? "LEAF" : "SPHERE"));
    } else {
        const std::string nearest = working.suggestions.nearest(name, working.names);
        if (!nearest.empty()) {
            Fix fix;
            fix.title = fmt::format("did you mean {}?", quoted(nearest));
            fix.edits = {{span, nearest}};
            fix.machine_applicable = false;
            diagnostic.fixes.push_back(std::move(fix));
        }
        diagnostic.help.push_back(declaration_help(input, symbol, span));
        return;
    }
    diagnostic.help.push_back(fmt::format(
        "if it is to do nothing, declare it with `#module {}{};`", input.sources.text(span),
        formals_text(input.program.symbol(symbol).parameter_count)));
}

/// "modules `a`, `b` and 7 more are"
std::string letters_text(const CheckInput& input, const std::vector<SymbolId>& symbols) {
    if (symbols.size() == 1) {
        return fmt::format("module {} is", quoted(input.name(symbols.front())));
    }
    constexpr std::size_t kMaxNamed = 5;
    const std::size_t named = symbols.size() > kMaxNamed + 1 ? kMaxNamed : symbols.size();
    std::string text = "modules ";
    for (std::size_t i = 0; i < named; ++i) {
        if (i != 0) {
            text += i + 1 == symbols.size() ? " and " : ", ";
        }
        text += quoted(input.name(symbols[i]));
    }
    return named == symbols.size()
               ? text + " are"
               : fmt::format("{} and {} more are", text, symbols.size() - named);
}

/// Labels at the places; places that touch get one label.
std::vector<Label> neighbours_joined(const std::vector<SourceSpan>& spans) {
    std::vector<Label> labels;
    for (const SourceSpan& span : spans) {
        if (!labels.empty() && labels.back().span.file == span.file &&
            labels.back().span.end == span.begin) {
            labels.back().span.end = span.end;
        } else {
            labels.push_back({span, ""});
        }
    }
    return labels;
}

/// Reports idle modules of one character, and longer ones beside them, in one message: each letter
/// of a misspelt keyword is a module in the formats of many programs.
void report_idle_letters(const CheckInput& input,
                         const ModuleUse& use,
                         const std::vector<SymbolId>& symbols,
                         Diagnostics& diagnostics) {
    std::vector<SourceSpan> spans;
    for (const SymbolId symbol : symbols) {
        const ModuleMention place = use.first_place[static_cast<std::size_t>(symbol)];
        spans.push_back(module_name_span(input, *place.word, place.index));
    }
    std::vector<Label> labels = neighbours_joined(spans);
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::IdleModule, labels.front().span,
        fmt::format("{} never rewritten and never drawn", letters_text(input, symbols)));
    labels.erase(labels.begin());
    diagnostic.labels = std::move(labels);
    if (spans.size() == 1) {
        diagnostic.label = kIdleLabel;
        diagnostic.help.push_back(declaration_help(input, symbols.front(), spans.front()));
    } else {
        diagnostic.help.emplace_back("draw a module with `#object`, or declare modules that are to "
                                     "do nothing with `#module`");
    }
}

/// The modules to report, those of one character in `letters`.
struct IdleModules {
    std::vector<SymbolId> letters;
    std::vector<SymbolId> names;
};

IdleModules find_idle_modules(const CheckInput& input, ModuleUse& use) {
    IdleModules idle;
    std::vector<const ProgramWord*> words; // words that contain the modules in idle.letters
    for (std::uint32_t s = 0; s < input.program.symbols.size(); ++s) {
        const auto symbol = SymbolId{s};
        if (!is_idle(input, use, symbol) || use.reported[s]) {
            continue;
        }
        for (const SymbolId other : use.same_name(input.program, symbol)) {
            use.reported[static_cast<std::size_t>(other)] = true;
        }
        const ModuleMention place = use.first_place[s];
        if (!is_unexplained_letter(input, symbol)) {
            idle.names.push_back(symbol);
        } else if (!input.sources.allows(module_name_span(input, *place.word, place.index),
                                         info(DiagnosticCode::IdleModule).name)) {
            idle.letters.push_back(symbol);
            words.push_back(place.word);
        }
    }
    // Report a longer name in a word with several idle letters as one of these letters.
    if (idle.letters.size() > 1) {
        std::erase_if(idle.names, [&](SymbolId symbol) {
            const ModuleMention place = use.first_place[static_cast<std::size_t>(symbol)];
            const bool is_letter =
                find_synonym(SynonymKind::Module, input.name(symbol)) == nullptr &&
                std::ranges::find(words, place.word) != words.end();
            if (is_letter) {
                idle.letters.push_back(symbol);
            }
            return is_letter;
        });
        std::ranges::sort(idle.letters);
    }
    return idle;
}

} // namespace

void check_unused_objects(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    const Program& program = input.program;
    Suggestions suggestions;
    for (const ObjectBinding& object : program.objects) {
        if (object.name_span.file != program.axiom_span().file) {
            continue; // an included file may bind more objects than this grammar uses
        }
        const auto named = use.by_name.find(static_cast<std::uint32_t>(object.name));
        bool occurs = false;
        if (named != use.by_name.end()) {
            for (const SymbolId symbol : named->second) {
                occurs = occurs || use.any_place[static_cast<std::size_t>(symbol)].word != nullptr;
            }
        }
        if (occurs) {
            continue;
        }
        const std::string_view name = input.name(object.name);
        Diagnostic diagnostic = make_diagnostic(
            DiagnosticCode::UnusedObject, object.name_span,
            fmt::format("module {} never occurs, so this object is never drawn", quoted(name)));
        // The author most likely means a module that occurs and is not drawn.
        std::vector<SymbolId> idle;
        std::vector<std::string_view> idle_names;
        const bool may_suggest = suggestions.claim(program.symbols.size());
        for (std::uint32_t s = 0; may_suggest && s < program.symbols.size(); ++s) {
            if (is_idle(input, use, SymbolId{s}) && !use.reported[s]) {
                idle.push_back(SymbolId{s});
                idle_names.push_back(input.name(SymbolId{s}));
            }
        }
        SymbolId meant = idle.size() == 1 ? idle.front() : kNoSymbol;
        if (const auto nearest = nearest_name(name, idle_names)) {
            for (const SymbolId symbol : idle) {
                meant = input.name(symbol) == *nearest ? symbol : meant;
            }
        }
        if (meant != kNoSymbol) {
            const auto m = static_cast<std::size_t>(meant);
            const std::string_view target = input.name(meant);
            const ModuleMention place = use.first_place[m];
            diagnostic.labels.push_back({module_span(input, *place.word, place.index),
                                         fmt::format("{} is never drawn", quoted(target))});
            Fix fix;
            fix.title = fmt::format("did you mean `#object {} {}`?", target,
                                    input.sources.text(object.object_span));
            fix.edits = {{object.name_span, std::string(target)}};
            fix.machine_applicable = false;
            diagnostic.fixes.push_back(std::move(fix));
            for (const SymbolId symbol : use.same_name(program, meant)) {
                use.reported[static_cast<std::size_t>(symbol)] = true;
            }
        } else {
            diagnostic.help.push_back(fmt::format(
                "write {} in a successor or in the axiom, or remove the statement", quoted(name)));
        }
        diagnostics.add(std::move(diagnostic));
        if (named != use.by_name.end()) { // a production of the module gives no second message
            for (const SymbolId symbol : named->second) {
                use.reported[static_cast<std::size_t>(symbol)] = true;
            }
        }
    }
}

void check_idle_modules(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    // A grammar that draws nothing is used for its word: no module is idle by mistake.
    if (!use.draws) {
        return;
    }
    const IdleModules idle = find_idle_modules(input, use);
    WorkingNames working;
    if (!idle.names.empty()) {
        working.names = working_names(input, use);
    }
    for (const SymbolId symbol : idle.names) {
        report_idle_name(input, use, symbol, working, diagnostics);
    }
    if (!idle.letters.empty()) {
        report_idle_letters(input, use, idle.letters, diagnostics);
    }
}

} // namespace lsys
