// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/definitions.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace lsys {

Diagnostic& report_duplicate(Resolution& resolution,
                             SourceSpan second,
                             SourceSpan first,
                             const std::string& what) {
    Diagnostic& error = resolution.diagnostics.add(DiagnosticCode::DuplicateStatement, second,
                                                   fmt::format("a second {}", what));
    error.labels.push_back({first, "the first is here"});
    return error;
}

std::optional<std::uint64_t> exact_whole_number(const Resolution& resolution,
                                                ExpressionId expression) {
    const Expression& node = resolution.ast.expression(expression);
    if (node.kind != ExpressionKind::Number) {
        return std::nullopt;
    }
    const std::string_view text = resolution.sources.text(node.span());
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return value;
}

DefinitionResolver::DefinitionResolver(Resolution& resolution,
                                       ConstantTable& constants,
                                       ExpressionResolver& expressions)
    : resolution_(resolution), constants_(constants), expressions_(expressions) {
    for (const Definition& definition : resolution.options.definitions) {
        replacements_[definition.name] = definition.value; // the last -D of a name is used
    }
}

void DefinitionResolver::generations(const GenerationsNode& node, SourceSpan statement) {
    if (first_generations_) {
        report_duplicate(resolution_, statement, *first_generations_, "`#n`");
        return;
    }
    first_generations_ = statement;
    expressions_.begin_statement();
    const ValueId value = expressions_.resolve(node.value, ExpressionPlace::Generations);
    if (value == kPoison) {
        return;
    }
    constexpr std::uint64_t kMaxGenerations = 0xFFFFFFFE;
    const SourceSpan span = resolution_.ast.expression(node.value).span();
    const float number = expressions_.constant_value(value).value_or(-1.0F);
    std::optional<std::uint64_t> count = exact_whole_number(resolution_, node.value);
    if (!count && number == std::floor(number) && number >= 0.0F && number < 0x1p32F) {
        count = static_cast<std::uint64_t>(number);
    }
    if (!count || *count > kMaxGenerations) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadGenerations, span,
            count || number >= 0x1p32F
                ? fmt::format("more than {} generations cannot be counted", kMaxGenerations)
                : fmt::format("{} is not a number of generations", number));
        if (!count && number > 0.0F && number < 1000.0F) {
            error.help.push_back(fmt::format(
                "a word is rewritten a whole number of times: write `{}` or `{}`; `lsview` plays "
                "the growth between them",
                std::floor(number), std::ceil(number)));
            return;
        }
        error.help.emplace_back("generations are a whole number from 0 on");
        return;
    }
    if (*count == 0) {
        resolution_.diagnostics.add(DiagnosticCode::ZeroGenerations, span,
                                    "no generation is derived: the word is the axiom");
    }
    resolution_.program.generations = static_cast<std::uint32_t>(*count);
    resolution_.program.generations_span = span;
}

bool DefinitionResolver::check_first_definition(NameId name, SourceSpan span) {
    const SourceSpan first = constants_.definition_span(name);
    if (first == span) {
        return true;
    }
    report_duplicate(resolution_, span, first,
                     fmt::format("definition of {}", quoted(resolution_.text(name))));
    return false;
}

void DefinitionResolver::define(const DefineNode& node) {
    expressions_.begin_statement();
    const ValueId value = expressions_.resolve(node.value, ExpressionPlace::Define);
    if (check_first_definition(node.name, node.name_span)) {
        Constant constant;
        constant.name = node.name;
        constant.span = node.name_span;
        add(constant, value, expressions_.is_random());
    }
    advance_draw_position(expressions_.draw_count());
}

void DefinitionResolver::param(const ParamNode& node) {
    expressions_.begin_statement();
    const ValueId value = expressions_.resolve(node.value, ExpressionPlace::Param);
    const bool is_random = expressions_.is_random();
    const std::uint32_t draws = expressions_.draw_count();
    const ValueId minimum = expressions_.resolve(node.minimum, ExpressionPlace::Bound);
    const ValueId maximum = expressions_.resolve(node.maximum, ExpressionPlace::Bound);
    if (check_first_definition(node.name, node.name_span)) {
        if (minimum == kPoison || maximum == kPoison) {
            constants_.fail(node.name);
        } else {
            Constant constant;
            constant.name = node.name;
            constant.span = node.name_span;
            constant.is_param = true;
            constant.minimum = *expressions_.constant_value(minimum);
            constant.maximum = *expressions_.constant_value(maximum);
            if (!std::isfinite(constant.minimum) || !std::isfinite(constant.maximum) ||
                constant.minimum > constant.maximum) {
                Diagnostic& error =
                    resolution_.diagnostics.add(DiagnosticCode::BadParameterBounds,
                                                node.bounds_span, "these bounds hold no value");
                error.help.emplace_back("write the smaller number first: `{0, 1}`");
                constants_.fail(node.name);
            } else {
                add(constant, value, is_random);
                check_bounds(node, constant);
            }
        }
    }
    advance_draw_position(draws);
}

void DefinitionResolver::add(Constant constant, ValueId value, bool is_random) {
    const auto replacement = replacements_.empty()
                                 ? replacements_.end()
                                 : replacements_.find(std::string(resolution_.text(constant.name)));
    if (replacement != replacements_.end()) {
        constant.value = replacement->second;
        constants_.define(constant);
        return;
    }
    if (value == kPoison) {
        constants_.fail(constant.name);
        return;
    }
    if (!is_random) {
        constant.value = *expressions_.constant_value(value);
        constants_.define(constant);
        return;
    }
    Program& program = resolution_.program;
    Global global;
    global.name = constant.name;
    global.span = constant.span;
    global.value = value;
    global.draw_position = draw_position_;
    global.draw_count = expressions_.draw_count();
    global.has_bounds = constant.is_param;
    global.minimum = constant.minimum;
    global.maximum = constant.maximum;
    constant.is_random = true;
    constant.global = static_cast<std::uint32_t>(program.globals.size());
    program.globals.push_back(global);
    constants_.define(constant);
}

void DefinitionResolver::check_bounds(const ParamNode& node, const Constant& constant) {
    if (constants_.state(node.name) != ConstantState::Known) {
        return;
    }
    const Constant& definition = constants_.constant(node.name);
    if (definition.is_random ||
        (definition.value >= constant.minimum && definition.value <= constant.maximum)) {
        return;
    }
    const bool replaced = replacements_.contains(std::string(resolution_.text(constant.name)));
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadParameterBounds,
        replaced ? node.name_span : resolution_.ast.expression(node.value).span(),
        fmt::format("{}{} is outside the bounds {} to {} of `{}`", replaced ? "the new value " : "",
                    definition.value, constant.minimum, constant.maximum,
                    resolution_.text(node.name)));
    error.labels.push_back({node.bounds_span, "the bounds"});
}

std::vector<std::string> DefinitionResolver::unknown_definitions() const {
    std::vector<std::string> unknown;
    const AttemptedStatements attempted(resolution_);
    for (const Definition& definition : resolution_.options.definitions) {
        const NameId name = resolution_.names.find(definition.name);
        const bool is_known = name != kNoName && constants_.state(name) != ConstantState::Unknown;
        if (!is_known && !attempted.defines(definition.name)) {
            unknown.push_back(definition.name);
        }
    }
    return unknown;
}

} // namespace lsys
