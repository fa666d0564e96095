// SPDX-License-Identifier: MIT
#include "grammar/ast/ast_builder.h"

#include "grammar/ast/reports.h"
#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "grammar/base/utf8.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

constexpr NameId kUnset{0xFFFFFFFFu};

/// Precedence level of a comparison, 0 for other operations. Two comparisons of one level cannot be
/// chained: `a < b < c` is an error.
int comparison_level(BinaryOperation operation) {
    switch (operation) {
    case BinaryOperation::Less:
    case BinaryOperation::LessEqual:
    case BinaryOperation::Greater:
    case BinaryOperation::GreaterEqual:
        return 1;
    case BinaryOperation::Equal:
    case BinaryOperation::NotEqual:
        return 2;
    default:
        return 0;
    }
}

Expression make_node(ExpressionKind kind, SourceSpan span) {
    Expression node;
    node.kind = kind;
    node.file = span.file;
    node.begin = span.begin;
    node.end = span.end;
    return node;
}

} // namespace

AstBuilder::AstBuilder(const ScannedText& scanned, Ast& ast, const ParseContext& context)
    : scanned_(scanned), ast_(ast), sources_(context.sources), names_(context.names),
      diagnostics_(context.diagnostics), word_cache_(256) {
    one_character_names_.fill(kUnset);
    finish_statement({}, true); // sets the watermark
}

// --- expressions

ExpressionId AstBuilder::add(const Expression& expression) {
    const auto id = static_cast<ExpressionId>(ast_.expressions.size());
    ast_.expressions.push_back(expression);
    return id;
}

ExpressionId AstBuilder::number(float value, SourceSpan span) {
    Expression node = make_node(ExpressionKind::Number, span);
    node.value = value;
    return add(node);
}

ExpressionId AstBuilder::name(NameId name, SourceSpan span) {
    Expression node = make_node(ExpressionKind::Name, span);
    node.name = name;
    return add(node);
}

ExpressionId AstBuilder::unary(UnaryOperation operation, ExpressionId operand, SourceSpan span) {
    Expression node = make_node(ExpressionKind::Unary, span);
    node.operation = static_cast<std::uint8_t>(operation);
    node.left = operand;
    return add(node);
}

ExpressionId AstBuilder::binary(BinaryOperation operation,
                                ExpressionId left,
                                ExpressionId right,
                                SourceSpan span) {
    if (const int level = comparison_level(operation); level != 0) {
        const auto chains = [&](ExpressionId id) {
            const Expression& inner = ast_.expression(id);
            return inner.kind == ExpressionKind::Binary &&
                   comparison_level(inner.binary()) == level;
        };
        // A chain of comparisons gets one message, at its second comparison.
        if (chains(left) && !chains(ast_.expression(left).left)) {
            report_chained_comparison(diagnostics_, ast_, left, span, sources_);
        }
    }
    Expression node = make_node(ExpressionKind::Binary, span);
    node.operation = static_cast<std::uint8_t>(operation);
    node.left = left;
    node.right = right;
    return add(node);
}

ExpressionId AstBuilder::grouping(ExpressionId inner, SourceSpan span) {
    Expression node = make_node(ExpressionKind::Grouping, span);
    node.left = inner;
    return add(node);
}

ExpressionId AstBuilder::range(std::uint32_t count, SourceSpan span) {
    if (count != 2) {
        drop_arguments(count);
        report_bad_range(diagnostics_, count, span, sources_);
        return error(span);
    }
    Expression node = make_node(ExpressionKind::Range, span);
    node.left = arguments_[arguments_.size() - 2];
    node.right = arguments_[arguments_.size() - 1];
    drop_arguments(count);
    return add(node);
}

ExpressionId AstBuilder::call(NameId function, std::uint32_t count, SourceSpan span) {
    Expression node = make_node(ExpressionKind::Call, span);
    node.name = function;
    node.arguments = static_cast<std::uint32_t>(ast_.argument_lists.size());
    ast_.argument_lists.push_back(take_arguments(count));
    return add(node);
}

ExpressionId AstBuilder::negated(float value, SourceSpan number_span, SourceSpan span) {
    return unary(UnaryOperation::Negate, number(value, number_span), span);
}

ExpressionId AstBuilder::error(SourceSpan span) {
    return add(make_node(ExpressionKind::Error, span));
}

std::uint32_t AstBuilder::argument(std::uint32_t count_before, ExpressionId value) {
    arguments_.push_back(value);
    return count_before + 1;
}

void AstBuilder::drop_arguments(std::uint32_t count) {
    LSYS_CHECK(count <= arguments_.size(), count, arguments_.size());
    arguments_.resize(arguments_.size() - count);
}

ListRange AstBuilder::take_arguments(std::uint32_t count) {
    LSYS_CHECK(count <= arguments_.size(), count, arguments_.size());
    const ListRange range{static_cast<std::uint32_t>(ast_.expression_lists.size()), count};
    for (std::size_t i = arguments_.size() - count; i < arguments_.size(); ++i) {
        ast_.expression_lists.push_back(arguments_[i]);
    }
    drop_arguments(count);
    return range;
}

// --- statements

void AstBuilder::begin_node(StatementKind kind, std::size_t index) {
    statement_.kind = kind;
    statement_.index = static_cast<std::uint32_t>(index);
    has_node_ = true;
}

void AstBuilder::generations(ExpressionId value) {
    begin_node(StatementKind::Generations, ast_.generations.size());
    ast_.generations.push_back({value});
}

void AstBuilder::define(NameId name, SourceSpan name_span, ExpressionId value) {
    begin_node(StatementKind::Define, ast_.defines.size());
    ast_.defines.push_back({name, name_span, value});
}

void AstBuilder::param(NameId name,
                       SourceSpan name_span,
                       ExpressionId value,
                       std::uint32_t bound_count,
                       SourceSpan bounds) {
    ParamNode node;
    node.name = name;
    node.name_span = name_span;
    node.value = value;
    node.bounds_span = bounds;
    if (bound_count == 2) {
        node.minimum = arguments_[arguments_.size() - 2];
        node.maximum = arguments_[arguments_.size() - 1];
    } else {
        report_bad_range(diagnostics_, bound_count, bounds, sources_);
        node.minimum = error(bounds);
        node.maximum = error(bounds);
    }
    drop_arguments(bound_count);
    begin_node(StatementKind::Param, ast_.params.size());
    ast_.params.push_back(node);
}

void AstBuilder::function(
    NameId name, SourceSpan name_span, std::uint32_t count, SourceSpan formals, ExpressionId body) {
    begin_node(StatementKind::Function, ast_.functions.size());
    ast_.functions.push_back({name, name_span, take_arguments(count), formals, body});
}

void AstBuilder::curve(NameId name, SourceSpan name_span, std::uint32_t count) {
    begin_node(StatementKind::Curve, ast_.curves.size());
    ast_.curves.push_back({name, name_span, take_arguments(count)});
}

void AstBuilder::contour(NameId name, SourceSpan name_span, std::uint32_t count) {
    begin_node(StatementKind::Contour, ast_.contours.size());
    ast_.contours.push_back({name, name_span, take_arguments(count)});
}

void AstBuilder::module_declaration(ModuleList modules) {
    begin_node(StatementKind::Module, ast_.module_declarations.size());
    ast_.module_declarations.push_back({modules});
}

void AstBuilder::object(
    SourceSpan keyword, ModuleList name, NameId object, SourceSpan span, bool is_file) {
    begin_node(StatementKind::Object, ast_.objects.size());
    ast_.objects.push_back(
        {keyword, name, span, is_file, std::string(names_.text(object)), {}, {}});
}

void AstBuilder::contour_of_object(NameId contour, SourceSpan span) {
    ast_.objects.back().contour = names_.text(contour);
    ast_.objects.back().contour_span = span;
}

void AstBuilder::include(NameId path, SourceSpan span) {
    begin_node(StatementKind::Include, ast_.includes.size());
    ast_.includes.push_back({span, std::string(names_.text(path)), kNoFile});
}

void AstBuilder::set_word(NameId word, SourceSpan span) {
    ast_.set_values.push_back({span, true, word, kNoExpression});
}

void AstBuilder::set_number(ExpressionId value, SourceSpan span) {
    ast_.set_values.push_back({span, false, kNoName, value});
}

void AstBuilder::set_file(NameId path, SourceSpan span) {
    ast_.set_values.push_back({span, false, path, kNoExpression, true});
}

ListRange AstBuilder::new_set_values() const {
    const auto first = static_cast<std::uint32_t>(watermark_.set_values);
    return {first, static_cast<std::uint32_t>(ast_.set_values.size()) - first};
}

void AstBuilder::set(NameId key, SourceSpan key_span) {
    begin_node(StatementKind::Set, ast_.sets.size());
    ast_.sets.push_back({key, key_span, new_set_values()});
}

void AstBuilder::material(SourceSpan keyword) {
    begin_node(StatementKind::Material, ast_.materials.size());
    ast_.materials.push_back({keyword, new_set_values()});
}

void AstBuilder::sense(NameId name, SourceSpan name_span) {
    begin_node(StatementKind::Sense, ast_.senses.size());
    ast_.senses.push_back({name, name_span, new_set_values()});
}

void AstBuilder::ignore(SourceSpan keyword, ModuleList modules, bool considers) {
    begin_node(StatementKind::Ignore, ast_.ignores.size());
    ast_.ignores.push_back({modules, considers, keyword});
}

void AstBuilder::axiom(ModuleList modules, ExpressionId probability) {
    begin_node(StatementKind::Axiom, ast_.axioms.size());
    ast_.axioms.push_back({probability, modules});
}

void AstBuilder::left_context(ModuleList left, SourceSpan less) {
    production_.has_left = true;
    production_.left = left;
    production_.less_span = less;
}

void AstBuilder::predecessor(ModuleList modules) {
    production_.predecessor = modules;
}

void AstBuilder::right_context(SourceSpan greater, ModuleList right) {
    production_.has_right = true;
    production_.greater_span = greater;
    production_.right = right;
}

void AstBuilder::condition(ExpressionId condition) {
    production_.condition.condition = condition;
}

void AstBuilder::probability(SourceSpan tilde, ExpressionId probability) {
    production_.condition.probability = probability;
    production_.condition.tilde_span = tilde;
}

void AstBuilder::production_front(NameId name,
                                  SourceSpan label,
                                  SourceSpan condition,
                                  Stage stage) {
    production_.stage = stage;
    production_.name = name;
    production_.name_span = name_without_hash(label);
    production_.condition.span = condition;
}

void AstBuilder::local(NameId name, SourceSpan name_span, ExpressionId value) {
    ast_.locals.push_back({name, name_span, value});
}

void AstBuilder::production(ModuleList successor) {
    production_.locals.first = static_cast<std::uint32_t>(watermark_.locals);
    production_.locals.count = static_cast<std::uint32_t>(ast_.locals.size() - watermark_.locals);
    production_.successor = successor;
    begin_node(StatementKind::Production, ast_.productions.size());
    ast_.productions.push_back(production_);
}

void AstBuilder::recover() {
    is_discarded_ = true;
    arguments_.clear();
}

bool AstBuilder::check_room(SourceSpan span) {
    constexpr std::size_t kMaxNodes = std::size_t{1} << 31;
    const std::size_t max_count =
        std::max({ast_.expressions.size(), ast_.expression_lists.size(), ast_.modules.size(),
                  ast_.calls.size(), ast_.set_values.size(), ast_.statements.size()});
    if (max_count > kMaxNodes && diagnostics_.admits(DiagnosticCode::ProgramTooLarge)) {
        diagnostics_.add(DiagnosticCode::ProgramTooLarge, span,
                         "the grammar has more than 2,147,483,648 modules or values up to here");
    }
    return max_count <= kMaxNodes;
}

void AstBuilder::mark_incomplete() {
    ast_.incomplete = true;
}

bool AstBuilder::finish_statement(SourceSpan span, bool is_complete) {
    const bool is_kept = is_complete && !is_discarded_ && check_room(span);
    if (!is_kept) {
        rollback();
        ast_.incomplete = true;
    } else if (has_node_) {
        statement_.span = span;
        ast_.statements.push_back(statement_);
    }
    set_watermark();
    has_node_ = false;
    is_discarded_ = false;
    arguments_.clear();
    production_ = ProductionNode{};
    list_place_ = {};
    return is_kept;
}

void AstBuilder::set_watermark() {
    watermark_ = {ast_.expressions.size(),    ast_.expression_lists.size(),
                  ast_.argument_lists.size(), ast_.modules.size(),
                  ast_.calls.size(),          ast_.set_values.size(),
                  ast_.locals.size()};
}

void AstBuilder::rollback() {
    if (has_node_) {
        switch (statement_.kind) {
        case StatementKind::Generations:
            ast_.generations.pop_back();
            break;
        case StatementKind::Define:
            ast_.defines.truncate(statement_.index);
            break;
        case StatementKind::Param:
            ast_.params.pop_back();
            break;
        case StatementKind::Function:
            ast_.functions.pop_back();
            break;
        case StatementKind::Curve:
            ast_.curves.pop_back();
            break;
        case StatementKind::Contour:
            ast_.contours.pop_back();
            break;
        case StatementKind::Material:
            ast_.materials.pop_back();
            break;
        case StatementKind::Sense:
            ast_.senses.pop_back();
            break;
        case StatementKind::Module:
            ast_.module_declarations.pop_back();
            break;
        case StatementKind::Object:
            ast_.objects.pop_back();
            break;
        case StatementKind::Include:
            ast_.includes.pop_back();
            break;
        case StatementKind::Set:
            ast_.sets.truncate(statement_.index);
            break;
        case StatementKind::Ignore:
            ast_.ignores.pop_back();
            break;
        case StatementKind::Axiom:
            ast_.axioms.pop_back();
            break;
        case StatementKind::Production:
            ast_.productions.truncate(statement_.index);
            break;
        }
    }
    ast_.expressions.truncate(watermark_.expressions);
    ast_.expression_lists.truncate(watermark_.expression_lists);
    ast_.argument_lists.truncate(watermark_.argument_lists);
    ast_.modules.truncate(watermark_.modules);
    ast_.calls.truncate(watermark_.calls);
    ast_.set_values.truncate(watermark_.set_values);
    ast_.locals.truncate(watermark_.locals);
}

SourceSpan AstBuilder::name_without_hash(SourceSpan label) const {
    if (scanned_.translation != nullptr) {
        return label; // in the original there is no `#`
    }
    const std::string_view text = sources_.text(label);
    if (text.starts_with('#')) {
        const std::size_t name = text.find_first_not_of(kWhitespace, 1);
        label.begin += static_cast<std::uint32_t>(name == std::string_view::npos ? 1 : name);
    } else if (text.starts_with("\xEF\xBC\x83")) { // the full-width number sign
        label.begin += 3;
    }
    return label;
}

} // namespace lsys
