// SPDX-License-Identifier: MIT
// Inlay hints and code lenses.
#include "compiler/bytecode/distributions.h"
#include "compiler/resolve/profiles.h"
#include "grammar/ast/include_chain.h"
#include "grammar/base/characters.h"
#include "runtime/languageserver/impl/predictions.h"
#include "runtime/languageserver/impl/vocabulary.h"
#include "runtime/languageserver/impl/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// The parts of "length, spring constant" without blanks around them.
std::vector<std::string> parts_of(std::string_view list) {
    std::vector<std::string> parts;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        std::string_view part = list.substr(0, comma);
        part.remove_prefix(std::min(part.find_first_not_of(kWhitespace), part.size()));
        parts.emplace_back(part);
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return parts;
}

class HintWriter {
public:
    HintWriter(TextPlace range, const IndexedGrammar& grammar, Places& at)
        : range_(std::move(range)), parsed_(grammar.parsed), ast_(grammar.parsed.ast), at_(at),
          profile_(grammar.index.profile) {
        find_formals();
    }

    /// Adds hints with the names of arguments, and with the number of parameters of modules whose
    /// name occurs with several numbers.
    void add_calls() {
        for (const Statement& statement : ast_.statements) {
            const std::uint32_t i = statement.index;
            if (statement.kind == StatementKind::Axiom) {
                add_modules(ast_.axioms[i].modules);
            } else if (statement.kind == StatementKind::Production) {
                add_modules(ast_.productions[i].predecessor, false);
                add_modules(ast_.productions[i].successor, true);
            }
        }
        for (std::size_t i = 0; i < ast_.expressions.size(); ++i) {
            const Expression& expression = ast_.expressions[i];
            if (expression.kind == ExpressionKind::Call) {
                const auto formals = functions_.find(parsed_.names.text(expression.name));
                add_arguments(ast_.argument_lists[expression.arguments],
                              formals != functions_.end() ? formals->second
                                                          : std::vector<std::string>());
            }
        }
    }

    /// Adds hints with the numbers of random draws, and with the ages from which productions apply.
    void add_program(const Program& program, const SourceMap& sources) {
        const std::vector<std::optional<std::uint32_t>> ages = first_ages(program);
        for (std::size_t i = 0; i < program.productions.size(); ++i) {
            const Production& production = program.productions[i];
            if (ages[i]) {
                add(sources, production.name_span.file, production.name_span.end,
                    fmt::format("from age {}", *ages[i]), false);
            }
            const bool draws_choice =
                production.stochastic && program.settings.choice != ChoiceScope::Generation;
            if (draws_choice) {
                add(sources, production.weight_span.file, production.weight_span.end, "draw 0",
                    false);
            }
            add_draws(program, expressions_of(program, production), draws_choice ? 1 : 0, sources);
        }
        for (const Global& global : program.globals) {
            add_draws(program, {global.value}, global.draw_position, sources);
        }
        for (const Axiom& axiom : program.axioms) {
            std::vector<ValueId> arguments;
            for_each_module(program, axiom.word,
                            [&](std::size_t /*index*/, std::size_t first, ProgramModule module) {
                                const std::uint32_t count =
                                    program.symbol(module.symbol).parameter_count;
                                for (std::uint32_t i = 0; i < count; ++i) {
                                    arguments.push_back(program.arguments[first + i]);
                                }
                            });
            add_draws(program, arguments, axiom.draw_position, sources);
        }
    }

    Json take() {
        std::sort(hints_.begin(), hints_.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        Json all = Json::array();
        for (auto& [offset, hint] : hints_) {
            all.push_back(std::move(hint));
        }
        return all;
    }

private:
    using ModuleKey = std::pair<std::string_view, std::uint32_t>; // name, count of parameters

    void find_formals() {
        const auto add_list = [&](ModuleList list) {
            for (ModuleCursor cursor(ast_, parsed_.names, parsed_.sources, list); !cursor.done();
                 cursor.next()) {
                const ModuleView module = cursor.view();
                const std::string_view name = parsed_.names.text(module.name);
                modules_.try_emplace({name, module.arguments.count}, texts_of(module.arguments));
                counts_[name].insert(module.arguments.count);
            }
        };
        for (const Statement& statement : ast_.statements) {
            const std::uint32_t i = statement.index;
            if (statement.kind == StatementKind::Production) {
                add_list(ast_.productions[i].predecessor);
            } else if (statement.kind == StatementKind::Module) {
                add_list(ast_.module_declarations[i].modules);
            } else if (statement.kind == StatementKind::Function) {
                functions_.insert_or_assign(parsed_.names.text(ast_.functions[i].name),
                                            texts_of(ast_.functions[i].formals));
            }
        }
        for (const FunctionHelp& row : function_helps()) {
            functions_.try_emplace(row.name, parts_of(row.parameters));
        }
    }

    [[nodiscard]] std::string_view text(SourceSpan span) const {
        return span.file == kNoFile ? std::string_view() : parsed_.sources.text(span);
    }
    [[nodiscard]] std::vector<std::string> texts_of(ListRange expressions) const {
        std::vector<std::string> texts;
        for (std::uint32_t i = 0; i < expressions.count; ++i) {
            const ExpressionId id = ast_.expression_lists[expressions.first + i];
            texts.emplace_back(text(ast_.expression(id).span()));
        }
        return texts;
    }

    void add_modules(ModuleList list, bool has_values = true) {
        for (ModuleCursor cursor(ast_, parsed_.names, parsed_.sources, list); !cursor.done();
             cursor.next()) {
            const std::string_view name = parsed_.names.text(cursor.name());
            const ModuleView module = cursor.view();
            const auto counts = counts_.find(name);
            if (counts != counts_.end() && counts->second.size() > 1) {
                add(parsed_.sources, module.name_span.file, module.name_span.end,
                    fmt::format("/{}", module.arguments.count), false);
            }
            if (!has_values || module.arguments.count == 0) {
                continue;
            }
            const auto formals = modules_.find({name, module.arguments.count});
            if (formals != modules_.end()) {
                add_arguments(module.arguments, formals->second);
            } else if (const TurtleCommand* command = find_turtle_command(profile_, name)) {
                add_arguments(module.arguments, parts_of(command->parameters));
            }
        }
    }

    /// A single argument needs no name.
    void add_arguments(ListRange arguments, const std::vector<std::string>& formals) {
        if (arguments.count < 2 || formals.size() < arguments.count) {
            return;
        }
        for (std::uint32_t i = 0; i < arguments.count; ++i) {
            const ExpressionId id = ast_.expression_lists[arguments.first + i];
            const SourceSpan span = ast_.expression(id).span();
            if (!formals[i].empty() && text(span) != formals[i]) {
                add(parsed_.sources, span.file, span.begin, formals[i] + ":", true);
            }
        }
    }

    void add_draws(const Program& program,
                   const std::vector<ValueId>& roots,
                   std::uint32_t first,
                   const SourceMap& sources) {
        std::set<ValueId> seen; // a local value is read by several expressions
        for_each_value(program, roots, [&](ValueId id, const Value& value) {
            if (is_draw(value.opcode) && seen.insert(id).second) {
                add(sources, value.span.file, value.span.end,
                    fmt::format("draw {}", first + value.index), false);
            }
        });
    }

    void add(const SourceMap& sources,
             FileId file,
             std::uint32_t offset,
             const std::string& label,
             bool is_parameter) {
        if (file == kNoFile || offset < range_.begin || offset > range_.end ||
            normalised_path(sources.file(file).path()) != range_.path) {
            return;
        }
        const TextPosition position = at_.position(range_.path, offset);
        Json hint{{"position", {{"line", position.line}, {"character", position.character}}},
                  {"label", label}};
        if (is_parameter) {
            hint["kind"] = 2;
        }
        hint[is_parameter ? "paddingRight" : "paddingLeft"] = true;
        hints_.emplace_back(std::pair(offset, label), std::move(hint));
    }

    TextPlace range_;
    const ParsedGrammar& parsed_;
    const Ast& ast_;
    Places& at_;
    TurtleProfile profile_;
    std::map<ModuleKey, std::vector<std::string>> modules_; // formals by module
    /// By name of a module: the counts of parameters with which the name occurs.
    std::map<std::string_view, std::set<std::uint32_t>> counts_;
    std::map<std::string_view, std::vector<std::string>> functions_; // formals by function
    /// Hints by offset and label.
    std::vector<std::pair<std::pair<std::uint32_t, std::string>, Json>> hints_;
};

std::string use_count_text(std::size_t count) {
    return count == 0 ? "not used" : count == 1 ? "used once" : fmt::format("used {} times", count);
}

} // namespace

Json inlay_hints(Workspace& workspace, const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    const Json& range = params.at("range");
    Places at(workspace);
    const TextPlace place{document.path, at.offset(document.path, range.at("start")),
                          at.offset(document.path, range.at("end"))};
    const std::shared_ptr<const IndexedGrammar> grammar = workspace.grammar(document.path);
    if (!grammar) {
        return Json::array();
    }
    HintWriter writer(place, *grammar, at);
    writer.add_calls();
    const CheckedDocument& checked = workspace.check(document);
    if (checked.compiled.grammar.program) {
        writer.add_program(*checked.compiled.grammar.program, *checked.compiled.grammar.sources);
    }
    return writer.take();
}

Json code_lenses(Workspace& workspace, const Json& params) {
    Document& document = workspace.document(params.at("textDocument").at("uri"));
    const std::shared_ptr<const NameIndex> names =
        workspace.names(workspace.roots_of(document.path));
    Places at(workspace);
    Json lenses = Json::array();
    const auto add = [&](const TextPlace& place, const std::string& title) {
        lenses.push_back(
            {{"range", at.range(place)}, {"command", {{"title", title}, {"command", ""}}}});
    };
    for (const StatementOutline& statement : names->statements) {
        if (statement.kind == StatementKind::Generations && statement.place.path == document.path) {
            const std::string length = predicted_length(workspace.check(document).compiled);
            if (!length.empty()) {
                add(statement.place, length);
            }
        }
    }
    // The first definition of each name in the document, with the count of its uses.
    struct Counted {
        const NameUse* definition = nullptr;
        std::size_t uses = 0;
    };
    std::map<std::pair<NameKind, std::string_view>, Counted> counted;
    for (const NameUse& use : names->uses) {
        if (use.kind == NameKind::Formal || use.kind == NameKind::Production) {
            continue;
        }
        Counted& entry = counted[{use.kind, use.name}];
        if (!use.is_definition) {
            ++entry.uses;
        } else if (entry.definition == nullptr && use.place.path == document.path) {
            entry.definition = &use;
        }
    }
    for (const auto& [name, entry] : counted) {
        if (entry.definition != nullptr) {
            add(entry.definition->place, use_count_text(entry.uses));
        }
    }
    return lenses;
}

} // namespace lsys
