// SPDX-License-Identifier: MIT
#include "grammar/ast/ast_dump.h"

#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

namespace {

class AstDumper {
public:
    AstDumper(const Ast& ast, const Names& names, const SourceMap& sources)
        : ast_(ast), names_(names), sources_(sources) {}

    std::string run() {
        FileId file = kNoFile;
        for (std::size_t i = 0; i < ast_.statements.size(); ++i) {
            const Statement& statement = ast_.statements[i];
            if (statement.span.file != file) {
                file = statement.span.file;
                out_ += "file " + sources_.file(file).path() + "\n";
            }
            const LineColumn place = sources_.file(file).line_column(statement.span.begin);
            out_ += "  " + std::to_string(place.line) + ":" + std::to_string(place.column) + " ";
            body(statement);
            out_ += '\n';
        }
        if (ast_.incomplete) {
            out_ += "incomplete: statements with errors are left out\n";
        }
        return std::move(out_);
    }

private:
    void body(const Statement& statement) {
        switch (statement.kind) {
        case StatementKind::Generations:
            out_ += "generations ";
            expression(ast_.generations[statement.index].value);
            return;
        case StatementKind::Define: {
            const DefineNode& node = ast_.defines[statement.index];
            out_ += "define ";
            name(node.name);
            out_ += ' ';
            expression(node.value);
            return;
        }
        case StatementKind::Param: {
            const ParamNode& node = ast_.params[statement.index];
            out_ += "param ";
            name(node.name);
            for (const ExpressionId each : {node.value, node.minimum, node.maximum}) {
                out_ += ' ';
                expression(each);
            }
            return;
        }
        case StatementKind::Function: {
            const FunctionNode& node = ast_.functions[statement.index];
            out_ += "function ";
            name(node.name);
            list(node.formals);
            out_ += ' ';
            expression(node.body);
            return;
        }
        case StatementKind::Curve:
        case StatementKind::Contour: {
            const bool is_curve = statement.kind == StatementKind::Curve;
            const CurveNode& node =
                is_curve ? ast_.curves[statement.index] : ast_.contours[statement.index];
            out_ += is_curve ? "curve " : "contour ";
            name(node.name);
            list(node.coordinates);
            return;
        }
        case StatementKind::Material:
            out_ += "material";
            values(ast_.materials[statement.index].values);
            return;
        case StatementKind::Sense:
            out_ += "sense ";
            name(ast_.senses[statement.index].name);
            values(ast_.senses[statement.index].values);
            return;
        case StatementKind::Module:
            out_ += "module ";
            modules(ast_.module_declarations[statement.index].modules);
            return;
        case StatementKind::Object: {
            const ObjectNode& node = ast_.objects[statement.index];
            out_ += "object ";
            modules(node.name);
            out_ += node.is_file ? " file " : " ";
            out_ += node.object;
            out_ += node.contour.empty() ? "" : " " + node.contour;
            return;
        }
        case StatementKind::Include:
            out_ += "include " + ast_.includes[statement.index].path;
            return;
        case StatementKind::Set:
            set(ast_.sets[statement.index]);
            return;
        case StatementKind::Ignore:
            out_ += ast_.ignores[statement.index].considers ? "consider " : "ignore ";
            modules(ast_.ignores[statement.index].modules);
            return;
        case StatementKind::Axiom:
            out_ += "axiom ";
            if (ast_.axioms[statement.index].probability != kNoExpression) {
                out_ += "~ ";
                expression(ast_.axioms[statement.index].probability);
                out_ += ' ';
            }
            modules(ast_.axioms[statement.index].modules);
            return;
        case StatementKind::Production:
            production(ast_.productions[statement.index]);
            return;
        }
    }

    void set(const SetNode& node) {
        out_ += "set ";
        name(node.key);
        values(node.values);
    }

    void values(ListRange range) {
        for (std::uint32_t i = 0; i < range.count; ++i) {
            const SetValue& value = ast_.set_values[range.first + i];
            out_ += ' ';
            if (value.is_word) {
                name(value.word);
            } else if (value.is_file) {
                out_ += fmt::format("\"{}\"", names_.text(value.word));
            } else {
                expression(value.value);
            }
        }
    }

    void production(const ProductionNode& node) {
        out_ += node.stage == Stage::Rewrite ? "production" : keyword_of(node.stage) + 1;
        out_ += ' ';
        name(node.name);
        if (node.has_left) {
            out_ += "\n      left ";
            modules(node.left);
        }
        out_ += "\n      predecessor ";
        modules(node.predecessor);
        if (node.has_right) {
            out_ += "\n      right ";
            modules(node.right);
        }
        if (node.condition.condition != kNoExpression) {
            out_ += "\n      condition ";
            expression(node.condition.condition);
        }
        if (node.condition.probability != kNoExpression) {
            out_ += "\n      probability ";
            expression(node.condition.probability);
        }
        for (std::uint32_t i = 0; i < node.locals.count; ++i) {
            const LocalNode& local = ast_.locals[node.locals.first + i];
            out_ += "\n      local ";
            name(local.name);
            out_ += ' ';
            expression(local.value);
        }
        out_ += "\n      successor ";
        modules(node.successor);
    }

    void modules(ModuleList list) {
        const char* separator = "";
        for (ModuleCursor cursor(ast_, names_, sources_, list); !cursor.done(); cursor.next()) {
            const ModuleView module = cursor.view();
            out_ += separator;
            separator = " ";
            if (module.is_indivisible) {
                out_ += '`';
            }
            name(module.name);
            if (module.is_indivisible) {
                out_ += '`';
            }
            if (!module.has_parentheses) {
                continue;
            }
            for (std::uint32_t i = 0; i < module.arguments.count; ++i) {
                out_ += i == 0 ? "(" : ", ";
                expression(ast_.expression_lists[module.arguments.first + i]);
            }
            out_ += module.arguments.count == 0 ? "()" : ")";
        }
    }

    void list(ListRange expressions) {
        for (std::uint32_t i = 0; i < expressions.count; ++i) {
            out_ += i == 0 ? "(" : ", ";
            expression(ast_.expression_lists[expressions.first + i]);
        }
        out_ += expressions.count == 0 ? "()" : ")";
    }

    void name(NameId id) { out_ += id == kNoName ? std::string_view("?") : names_.text(id); }

    /// Appends an expression, without recursion: a sum may have a million terms.
    void expression(ExpressionId root) {
        struct Step {
            ExpressionId expression;
            const char* text; // written instead of the expression if not null
        };
        std::vector<Step> steps{{root, nullptr}};
        const auto later = [&](ExpressionId id) { steps.push_back({id, nullptr}); };
        const auto later_text = [&](const char* text) { steps.push_back({kNoExpression, text}); };
        while (!steps.empty()) {
            const Step step = steps.back();
            steps.pop_back();
            if (step.text != nullptr) {
                out_ += step.text;
                continue;
            }
            if (step.expression == kNoExpression) {
                out_ += '?';
                continue;
            }
            const Expression& node = ast_.expression(step.expression);
            switch (node.kind) {
            case ExpressionKind::Number:
                number(node.value);
                break;
            case ExpressionKind::Name:
                name(node.name);
                break;
            case ExpressionKind::Unary:
                out_ += spelling(node.unary());
                out_ += '(';
                later_text(")");
                later(node.left);
                break;
            case ExpressionKind::Binary:
                out_ += spelling(node.binary());
                out_ += '(';
                later_text(")");
                later(node.right);
                later_text(", ");
                later(node.left);
                break;
            case ExpressionKind::Range:
                out_ += '{';
                later_text("}");
                later(node.right);
                later_text(", ");
                later(node.left);
                break;
            case ExpressionKind::Grouping:
                later(node.left);
                break;
            case ExpressionKind::Call: {
                name(node.name);
                out_ += '(';
                later_text(")");
                const ListRange list = ast_.argument_lists[node.arguments];
                for (std::uint32_t i = list.count; i > 0; --i) {
                    later(ast_.expression_lists[list.first + i - 1]);
                    if (i > 1) {
                        later_text(", ");
                    }
                }
                break;
            }
            case ExpressionKind::Error:
                out_ += '?';
                break;
            }
        }
    }

    void number(float value) {
        char buffer[32];
        out_.append(buffer, number_to_chars(buffer, buffer + sizeof buffer, value).ptr);
    }

    const Ast& ast_;
    const Names& names_;
    const SourceMap& sources_;
    std::string out_;
};

} // namespace

std::string dump_ast(const Ast& ast, const Names& names, const SourceMap& sources) {
    return AstDumper(ast, names, sources).run();
}

} // namespace lsys
