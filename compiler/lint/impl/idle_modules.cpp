// SPDX-License-Identifier: MIT
// Modules that are never rewritten and never drawn, and objects for modules that never occur.
#include "compiler/lint/impl/module_use.h"
#include "compiler/lint/impl/places.h"
#include "grammar/base/synonyms.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace lsys {

namespace {

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

} // namespace

void check_unused_objects(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    const Program& program = input.program;
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
        for (std::uint32_t s = 0; s < program.symbols.size(); ++s) {
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
    }
}

void check_idle_modules(const CheckInput& input, ModuleUse& use, Diagnostics& diagnostics) {
    // A grammar that draws nothing is used for its word: no module is idle by mistake.
    if (!use.draws) {
        return;
    }
    std::vector<std::string_view> candidates;
    for (std::uint32_t s = 0; s < input.program.symbols.size(); ++s) {
        const auto symbol = SymbolId{s};
        if (!is_idle(input, use, symbol) || use.reported[s]) {
            continue;
        }
        if (candidates.empty()) {
            candidates = working_names(input, use);
        }
        const std::string_view name = input.name(symbol);
        const ModuleMention place = use.first_place[s];
        const SourceSpan span = module_name_span(input, *place.word, place.index);
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::IdleModule, span,
            fmt::format("module {} is never rewritten and never drawn", quoted(name)));
        diagnostic.label = "stays in the word and does nothing";
        const Synonym* const synonym = find_synonym(SynonymKind::Module, name);
        const bool is_houdini_object =
            name.size() == 1 && std::string_view("JKM").find(name[0]) != std::string_view::npos &&
            input.program.settings.turtle != TurtleProfile::Houdini;
        if (synonym != nullptr) {
            diagnostic.help.push_back(help_for(*synonym, name));
            add_fix(diagnostic, fmt::format("write `{}`", synonym->spelling), span,
                    std::string(synonym->spelling), false);
        } else if (is_houdini_object) {
            diagnostic.help.push_back(
                fmt::format("{} of Houdini draws an object with `#set turtle houdini;` alone; "
                            "otherwise bind one: `#object {} {};`",
                            quoted(name), name, name == "J" ? "LEAF" : "SPHERE"));
        } else if (const auto nearest = nearest_name(name, candidates)) {
            Fix fix;
            fix.title = fmt::format("did you mean {}?", quoted(*nearest));
            fix.edits = {{span, std::string(*nearest)}};
            fix.machine_applicable = false;
            diagnostic.fixes.push_back(std::move(fix));
        }
        const std::string_view text = input.sources.text(span);
        const std::string formals = formals_text(input.program.symbols[s].parameter_count);
        const bool is_explained = synonym != nullptr || is_houdini_object;
        diagnostic.help.push_back(
            is_explained ? fmt::format("if it is to do nothing, declare it with `#module {}{};`",
                                       text, formals)
                         : fmt::format("draw it with `#object {0} SPHERE;`, or, if it is to do "
                                       "nothing, declare it with `#module {0}{1};`",
                                       text, formals));
        for (const SymbolId other : use.same_name(input.program, symbol)) {
            use.reported[static_cast<std::size_t>(other)] = true;
        }
    }
}

} // namespace lsys
