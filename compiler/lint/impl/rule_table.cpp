// SPDX-License-Identifier: MIT
#include "compiler/lint/impl/rule_table.h"

#include "compiler/lint/impl/places.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxEntries = 1'000'000; // max number of productions times points
constexpr std::uint64_t kMaxPoints = 65'536;     // max number of points of the grid
// Max instructions run per table, about 0.1 s: a condition of n comparisons has n points and n
// instructions at each of them.
constexpr std::uint64_t kMaxWork = 16'000'000;

} // namespace

std::optional<RuleTable> make_rule_table(const Bytecode& bytecode,
                                         const analysis::ProductionIndex& index,
                                         SymbolId symbol,
                                         std::vector<std::uint32_t> productions) {
    if (productions.empty()) {
        return std::nullopt;
    }
    std::vector<analysis::ConditionView> views;
    for (const std::uint32_t p : productions) {
        if (bytecode.productions[p].condition != kNone) {
            views.push_back({bytecode.productions[p].condition, index.first_formal(p)});
        }
    }
    const std::vector<analysis::KnownValue> unknown(bytecode.symbol(symbol).parameter_count);
    const std::uint64_t max_points =
        std::min<std::uint64_t>(kMaxPoints, kMaxEntries / productions.size());
    std::optional<analysis::ConditionGrid> grid =
        make_condition_grid(bytecode.instructions, views, unknown, {}, max_points);
    if (!grid || max_points == 0) {
        return std::nullopt;
    }
    RuleTable table;
    table.productions = std::move(productions);
    table.grid = std::move(*grid);
    table.points = table.grid.point_count();
    table.truth.resize(table.productions.size() * table.points);
    analysis::Evaluator evaluator(bytecode.stack_depth, bytecode.local_count);
    std::vector<analysis::KnownValue> values;
    for (std::size_t row = 0; row < table.productions.size(); ++row) {
        const std::uint32_t p = table.productions[row];
        const std::uint32_t condition = bytecode.productions[p].condition;
        const std::uint32_t first = index.first_formal(p);
        values.assign(first + unknown.size(), analysis::KnownValue{});
        for (std::uint64_t point = 0; point < table.points; ++point) {
            bool holds = true;
            if (condition != kNone) {
                table.grid.set_parameters(point, std::span(values).subspan(first));
                const analysis::KnownValue value =
                    evaluator.run(bytecode.instructions, condition, {values, {}, {}});
                if (!value.known || evaluator.work() > kMaxWork) {
                    return std::nullopt;
                }
                holds = value.value != 0.0F;
            }
            table.truth[row * table.points + point] = holds;
        }
    }
    return table;
}

std::string module_at(const CheckInput& input,
                      const Production& production,
                      SymbolId symbol,
                      const RuleTable& table,
                      std::uint64_t point) {
    const std::uint32_t count = input.program.symbol(symbol).parameter_count;
    std::vector<analysis::KnownValue> values(count);
    table.grid.set_parameters(point, values);
    const std::uint32_t first = production.predecessor.items.front().first_formal;
    std::string text(input.name(symbol));
    for (std::uint32_t i = 0; i < count; ++i) {
        text += i == 0 ? "(" : ", ";
        text += values[i].known ? number_text(values[i].value)
                                : std::string(input.name(production.formals[first + i]));
    }
    return count == 0 ? text : text + ")";
}

bool names_constant(const CheckInput& input, const Production& production) {
    const std::string_view text = input.sources.text(production.condition_span);
    const auto is_letter = [](char c) {
        return c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0;
    };
    const auto is_part = [&](char c) {
        return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
    };
    for (std::size_t at = 0; at < text.size();) {
        if (text.substr(at, 2) == "/*") {
            const std::size_t end = text.find("*/", at + 2);
            at = end == std::string_view::npos ? text.size() : end + 2;
            continue;
        }
        if (!is_letter(text[at])) {
            // The `e` of an exponent belongs to a number and does not begin a name.
            const bool number = is_part(text[at]);
            ++at;
            while (number && at < text.size() && is_part(text[at])) {
                ++at;
            }
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && is_part(text[end])) {
            ++end;
        }
        const std::string_view name = text.substr(at, end - at);
        while (end < text.size() && text[end] == ' ') {
            ++end;
        }
        const bool call = end < text.size() && text[end] == '(';
        const bool formal = std::any_of(production.formals.begin(), production.formals.end(),
                                        [&](NameId id) { return input.name(id) == name; });
        if (!call && !formal) {
            return true;
        }
        at = end;
    }
    return false;
}

} // namespace lsys
