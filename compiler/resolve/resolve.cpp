// SPDX-License-Identifier: MIT
#include "compiler/resolve/resolve.h"

#include "compiler/resolve/impl/attempts.h"
#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/contours.h"
#include "compiler/resolve/impl/declarations.h"
#include "compiler/resolve/impl/definitions.h"
#include "compiler/resolve/impl/environments.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/materials.h"
#include "compiler/resolve/impl/productions.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/set_statements.h"
#include "compiler/resolve/impl/splitting.h"
#include "compiler/resolve/impl/stray_comments.h"
#include "compiler/resolve/impl/symbols.h"
#include "compiler/resolve/impl/values.h"
#include "compiler/resolve/impl/words.h"
#include "compiler/resolve/known_words.h"
#include "compiler/resolve/profiles.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/synonyms.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Per NameId: whether it is a known module name (docs/language.md section 3).
std::vector<bool> known_names(const Resolution& resolution) {
    std::vector<bool> known(resolution.names.count());
    const auto add = [&](ModuleList list) {
        for (std::uint32_t i = list.first; i < list.first + list.count; ++i) {
            known[index_of(resolution.ast.modules[i].name())] = true;
        }
    };
    for (const ProductionNode& production : resolution.ast.productions) {
        add(production.predecessor);
    }
    for (const ModuleDeclarationNode& declaration : resolution.ast.module_declarations) {
        add(declaration.modules);
    }
    for (const ObjectNode& object : resolution.ast.objects) {
        add(object.name);
    }
    for (const TurtleCommand& command : turtle_commands(resolution.program.settings.turtle)) {
        known[index_of(resolution.names.find(command.name))] = true;
    }
    return known;
}

/// The paths of all files, indexed by FileId.
std::vector<std::string> paths_of(const Resolution& resolution) {
    std::vector<std::string> paths;
    for (const AstFile& file : resolution.ast.files) {
        const auto index = static_cast<std::size_t>(file.file);
        paths.resize(std::max(paths.size(), index + 1));
        paths[index] = resolution.sources.file(file.file).path();
    }
    return paths;
}

class Resolver {
public:
    explicit Resolver(Resolution& resolution)
        : resolution_(resolution), values_(resolution.program.values), constants_(resolution),
          expressions_(resolution, values_, constants_), symbols_(resolution),
          definitions_(resolution, constants_, expressions_), materials_(resolution, expressions_),
          contours_(resolution, expressions_), environments_(resolution, expressions_, symbols_),
          declarations_(resolution, symbols_, environments_) {}

    void run(SetResolver& settings) {
        const Ast& ast = resolution_.ast;
        environments_.declare_all();
        for (const ObjectNode& object : ast.objects) {
            declarations_.object(object);
        }
        const std::vector<bool> known = known_names(resolution_);
        NameSplitter splitter(resolution_, known);
        check_stray_comments(resolution_, known, splitter);
        for (const IgnoreNode& ignore : ast.ignores) {
            declarations_.ignore(ignore, splitter);
        }
        declarations_.finish_ignores();
        ModuleReading reading{resolution_,
                              symbols_,
                              splitter,
                              expressions_,
                              environments_,
                              SplitReport(resolution_),
                              std::vector<SymbolId>(resolution_.names.count(), kNoSymbol)};
        ProductionResolver productions(reading, constants_);
        // Productions may use functions that are defined after them, so a grammar with functions
        // has its productions resolved last.
        const bool has_functions = !ast.functions.empty() || !ast.curves.empty();
        expressions_.keep_expressions(has_functions);
        std::vector<std::size_t> deferred_productions;
        for (std::size_t i = 0; i < ast.statements.size(); ++i) {
            stop_if_cancelled();
            const Statement statement = ast.statements[i];
            switch (statement.kind) {
            case StatementKind::Function:
                expressions_.define_function(ast.functions[statement.index]);
                break;
            case StatementKind::Curve:
                expressions_.define_curve(ast.curves[statement.index]);
                break;
            case StatementKind::Contour:
                contours_.contour(ast.contours[statement.index]);
                break;
            case StatementKind::Material:
                materials_.material(ast.materials[statement.index], statement.span);
                break;
            case StatementKind::Sense:
                environments_.environment(statement.index);
                break;
            case StatementKind::Generations:
                definitions_.generations(ast.generations[statement.index], statement.span);
                break;
            case StatementKind::Define:
                definitions_.define(ast.defines[statement.index]);
                break;
            case StatementKind::Param:
                definitions_.param(ast.params[statement.index]);
                break;
            case StatementKind::Set:
                settings.read_number(ast.sets[statement.index], expressions_);
                break;
            case StatementKind::Module:
                declarations_.module(ast.module_declarations[statement.index], statement.span,
                                     reading);
                break;
            case StatementKind::Axiom:
                axiom(ast.axioms[statement.index], statement.span, reading);
                break;
            case StatementKind::Production:
                if (has_functions) {
                    deferred_productions.push_back(i);
                } else {
                    productions.resolve(ast.productions[statement.index], statement.span);
                    resolution_.ast.productions.release_before(statement.index);
                }
                break;
            case StatementKind::Object:
            case StatementKind::Ignore:
            case StatementKind::Include:
                break; // handled above, or by the front end
            }
        }
        expressions_.keep_expressions(false);
        for (const std::size_t i : deferred_productions) {
            stop_if_cancelled();
            constants_.visible_until(i);
            const Statement statement = ast.statements[i];
            productions.resolve(ast.productions[statement.index], statement.span);
            resolution_.ast.productions.release_before(statement.index);
        }
        productions.finish();
        check_missing();
    }

    /// Reads the numbers of `#set` statements that replace settings of the grammar, after all
    /// constants of the grammar are known.
    void replace(SetResolver& settings, Resolution& replacing) {
        ExpressionResolver expressions(replacing, values_, constants_);
        for (const Statement& statement : replacing.ast.statements) {
            if (statement.kind == StatementKind::Set) {
                settings.read_number(replacing.ast.sets[statement.index], expressions);
            }
        }
    }

    [[nodiscard]] std::vector<std::string> unknown_definitions() const {
        return definitions_.unknown_definitions();
    }

private:
    void axiom(const AxiomNode& node, SourceSpan statement, ModuleReading& reading) {
        const bool has_weight = node.probability != kNoExpression;
        std::vector<Axiom>& axioms = resolution_.program.axioms;
        if (first_axiom_ && !(has_weight && first_has_weight_)) {
            report_second_axiom(statement, has_weight);
            return;
        }
        first_axiom_ = first_axiom_.value_or(statement);
        first_has_weight_ = has_weight;
        if (node.modules.count == 0) {
            resolution_.diagnostics.add(DiagnosticCode::EmptyAxiom, statement,
                                        "the axiom holds no module");
            return;
        }
        expressions_.begin_statement();
        Axiom axiom;
        axiom.has_weight = has_weight;
        if (has_weight) {
            axiom.weight_span = resolution_.ast.expression(node.probability).span();
            const ValueId value =
                expressions_.resolve(node.probability, ExpressionPlace::AxiomProbability);
            axiom.weight = value == kPoison
                               ? std::numeric_limits<float>::quiet_NaN()
                               : checked_weight(resolution_, *expressions_.constant_value(value),
                                                axiom.weight_span);
        }
        axiom.word = resolve_word(reading, node.modules, ExpressionPlace::Axiom);
        axiom.draw_position = definitions_.draw_position();
        definitions_.advance_draw_position(axiom.word.draw_count);
        axioms.push_back(axiom);
        reading.splits.finish();
    }

    void report_second_axiom(SourceSpan statement, bool has_weight) {
        Diagnostic& error = report_duplicate(resolution_, statement, *first_axiom_, "`#w`");
        if (has_weight || first_has_weight_) {
            error.help.emplace_back("of several axioms each has its probability: "
                                    "`#w ~ 0.5 : modules;`");
        }
    }

    /// An empty place after the last character of the root file.
    [[nodiscard]] SourceSpan end_of_text() const {
        if (resolution_.ast.files.empty()) {
            return {};
        }
        const FileId root = resolution_.ast.files[0].file;
        const auto size = static_cast<std::uint32_t>(resolution_.sources.file(root).text().size());
        return {root, size, size};
    }

    /// Whether a `#set` tries to give the number of generations.
    [[nodiscard]] bool has_setting_of_generations() const {
        for (const Statement& statement : resolution_.ast.statements) {
            if (statement.kind == StatementKind::Set) {
                const std::string_view key =
                    resolution_.text(resolution_.ast.sets[statement.index].key);
                const Synonym* const synonym = find_synonym(SynonymKind::Setting, key);
                if (synonym != nullptr && synonym->spelling.starts_with("#n")) {
                    return true;
                }
            }
        }
        return false;
    }

    /// Reports a grammar without an axiom or without a number of generations.
    void check_missing() {
        if (resolution_.options.part) {
            return;
        }
        const AttemptedStatements attempted(resolution_);
        for (const IncludeNode& include : resolution_.ast.includes) {
            if (include.file == kNoFile) {
                return;
            }
        }
        if (!first_axiom_ && !attempted.has("w")) {
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::MissingAxiom, end_of_text(), "there is no axiom to begin with");
            error.help.emplace_back("add one: `#w : F(1);`");
        }
        if (resolution_.ast.generations.empty() && !resolution_.options.generations &&
            !attempted.has("n") && !has_setting_of_generations()) {
            Diagnostic& warning = resolution_.diagnostics.add(
                DiagnosticCode::MissingGenerations, end_of_text(),
                "the grammar does not say how many generations to derive");
            warning.notes.emplace_back("without it the word is the axiom");
            warning.help.emplace_back("add `#n = 5;`");
            warning.help.emplace_back("give `-n 5` on the command line");
        }
    }

    Resolution& resolution_;
    ValueBuilder values_;
    ConstantTable constants_;
    ExpressionResolver expressions_;
    SymbolTable symbols_;
    DefinitionResolver definitions_;
    MaterialResolver materials_;
    ContourResolver contours_;
    EnvironmentResolver environments_;
    DeclarationResolver declarations_;
    std::optional<SourceSpan> first_axiom_;
    bool first_has_weight_ = false; // first_axiom_ has a `~`
};

} // namespace

ResolveOutcome resolve(Ast ast,
                       Names& names,
                       const SourceMap& sources,
                       const CompileOptions& options,
                       Diagnostics& diagnostics) {
    ResolveOutcome outcome;
    Resolution resolution{ast, names, sources, options, diagnostics, outcome.program, {}};
    outcome.program.files = paths_of(resolution);
    outcome.program.written_names = ast.written_names;
    outcome.program.has_all_statements = !ast.incomplete;
    SetResolver settings(resolution, SetResolver::Origin::Grammar);
    settings.read_modes();
    std::optional<Resolution> replacing;
    std::optional<SetResolver> replacements;
    if (options.settings != nullptr) {
        options.settings->files = ast.files;
        options.settings->incomplete = ast.incomplete;
        replacing.emplace(Resolution{*options.settings, names, sources, options, diagnostics,
                                     outcome.program, std::move(resolution.letter_files)});
        replacements.emplace(*replacing, SetResolver::Origin::Options);
        replacements->read_modes();
        resolution.letter_files = replacing->letter_files;
    }
    // Tables indexed by NameId get the length of Names, so all names are interned before.
    for (const std::string_view function : function_names()) {
        static_cast<void>(names.intern(function));
    }
    for (const TurtleCommand& command : turtle_commands(outcome.program.settings.turtle)) {
        static_cast<void>(names.intern(command.name));
    }
    for (const SenseNode& node : ast.senses) {
        static_cast<void>(names.intern(sense_name(names.text(node.name))));
    }
    Resolver resolver(resolution);
    resolver.run(settings);
    if (replacing) {
        resolver.replace(*replacements, *replacing);
    }
    outcome.unknown_definitions = resolver.unknown_definitions();
    outcome.program.is_valid = !ast.incomplete && !diagnostics.has_errors() && !options.part;
    return outcome;
}

void resolve_settings(Ast& ast,
                      Names& names,
                      const SourceMap& sources,
                      Settings& settings,
                      Diagnostics& diagnostics) {
    for (const std::string_view function : function_names()) {
        static_cast<void>(names.intern(function));
    }
    Program program;
    program.settings = settings;
    const CompileOptions options;
    Resolution resolution{ast, names, sources, options, diagnostics, program, {}};
    SetResolver statements(resolution, SetResolver::Origin::Options);
    statements.read_modes();
    ValueBuilder values(program.values);
    ConstantTable constants(resolution);
    ExpressionResolver expressions(resolution, values, constants);
    for (const Statement& statement : ast.statements) {
        if (statement.kind == StatementKind::Set) {
            statements.read_number(ast.sets[statement.index], expressions);
        }
    }
    // The turtle profile of compiled code cannot change, so its traits stay.
    program.settings.traits = settings.traits;
    settings = program.settings;
}

} // namespace lsys
