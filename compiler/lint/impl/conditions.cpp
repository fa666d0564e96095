// SPDX-License-Identifier: MIT
// Conditions that always or never hold, and pairs of conditions that both exclude or both include a
// single value.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "compiler/lint/impl/rule_table.h"

#include <fmt/format.h>

namespace lsys {

namespace {

constexpr std::size_t kMaxCompared = 1'000; // productions of a module; more are not compared

void check_constant(const CheckInput& input,
                    const analysis::ProductionIndex& index,
                    std::uint32_t p,
                    SymbolId symbol,
                    Diagnostics& diagnostics) {
    const Production& production = input.program.productions[p];
    if (production.condition == kNoValue || names_constant(input, production)) {
        return;
    }
    const std::optional<RuleTable> table = make_rule_table(*input.bytecode, index, symbol, {p});
    if (!table) {
        return;
    }
    std::uint64_t held = 0;
    for (std::uint64_t point = 0; point < table->points; ++point) {
        held += table->holds(0, point) ? 1U : 0U;
    }
    if (held == 0) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::ConstantCondition, production.condition_span,
                            fmt::format("this condition never holds, so {} is never used",
                                        quoted(input.name(production.name))));
        diagnostic.help.emplace_back("mend the condition, or remove the production");
    } else if (held == table->points) {
        Diagnostic& diagnostic =
            diagnostics.add(DiagnosticCode::ConstantCondition, production.condition_span,
                            "this condition always holds");
        if (is_meant_as_probability(input, production)) {
            const std::string replacement =
                fmt::format("* ~ {}", input.sources.text(production.condition_span));
            add_fix(diagnostic,
                    fmt::format("a probability comes after a `~`: write `{}`", replacement),
                    production.condition_span, replacement, false);
            return;
        }
        diagnostic.help.emplace_back("write `*` for a production without condition");
    }
}

/// Finds single parameter values for which no production or two productions of a module match:
/// `x > 2` and `x < 2` both exclude 2, `x >= 2` and `x <= 2` both include it.
class SingleValues {
public:
    SingleValues(const CheckInput& input, SymbolId symbol, const RuleTable& table)
        : input_(input), symbol_(symbol), table_(table) {}

    void run(Diagnostics& diagnostics) {
        for (std::uint64_t point = 0; point < table_.points; ++point) {
            for (std::size_t axis = 0; axis < table_.grid.axes.size(); ++axis) {
                std::uint64_t below = 0;
                std::uint64_t above = 0;
                if (!neighbours(point, axis, below, above)) {
                    continue;
                }
                const std::size_t here = count(point);
                // No gap if the same production matches on both sides: `x != 2` is intended.
                if (here == 0 && !gap_reported_ && count(below) != 0 && count(above) != 0 &&
                    first(below) != first(above)) {
                    gap_reported_ = true;
                    report_gap(point, axis, first(below), first(above), diagnostics);
                }
                if (here == 2 && !overlap_reported_ && count(below) == 1 && count(above) == 1 &&
                    first(below) != first(above)) {
                    overlap_reported_ = true;
                    report_overlap(point, axis, diagnostics);
                }
            }
        }
    }

private:
    /// Sets `below` and `above` to the points next to `point` along `axis`. Returns false if one of
    /// them does not exist, or if the cell of `axis` has several values and equal_axis() finds no
    /// axis.
    bool neighbours(std::uint64_t point,
                    std::size_t axis,
                    std::uint64_t& below,
                    std::uint64_t& above) const {
        std::uint64_t stride = 1;
        for (std::size_t i = table_.grid.axes.size(); i-- > axis + 1;) {
            stride *= table_.grid.axes[i].samples.size();
        }
        const analysis::GridAxis& row = table_.grid.axes[axis];
        const std::size_t sample = table_.grid.sample_of(point, axis);
        if (sample == 0 || sample + 1 == row.samples.size()) {
            return false;
        }
        below = point - stride;
        above = point + stride;
        const analysis::GridCell& cell = row.cells[row.samples[sample].cell];
        return cell.low == cell.high || equal_axis(point, axis);
    }

    /// Another axis whose value at `point` equals the value of `axis`, if conditions compare the
    /// parameters of both axes with other parameters (GridAxis::compared).
    std::optional<std::size_t> equal_axis(std::uint64_t point, std::size_t axis) const {
        const std::vector<analysis::GridAxis>& axes = table_.grid.axes;
        const auto value = [&](std::size_t i) {
            return axes[i].samples[table_.grid.sample_of(point, i)].value;
        };
        for (std::size_t other = 0; other < axes.size(); ++other) {
            if (other != axis && axes[axis].compared && axes[other].compared &&
                value(other) == value(axis)) {
                return other;
            }
        }
        return std::nullopt;
    }

    /// The number of productions that match at a point. All stochastic ones together count as one.
    std::size_t count(std::uint64_t point) const {
        std::size_t matching = 0;
        bool stochastic = false;
        for (std::size_t row = 0; row < table_.productions.size(); ++row) {
            if (table_.holds(row, point)) {
                const bool chosen = production(row).stochastic;
                matching += chosen && stochastic ? 0U : 1U;
                stochastic = stochastic || chosen;
            }
        }
        return matching;
    }
    /// The row of the first production that matches at a point; productions.size() if none does.
    std::size_t first(std::uint64_t point) const {
        std::size_t row = 0;
        while (row < table_.productions.size() && !table_.holds(row, point)) {
            ++row;
        }
        return row;
    }
    const Production& production(std::size_t row) const {
        return input_.program.productions[table_.productions[row]];
    }

    /// The fix that changes `x > 2` to `x >= 2`, if the condition is a single comparison.
    std::optional<Fix> inclusive(std::size_t row) const {
        const Production& p = production(row);
        const Value& value = input_.program.value(p.condition);
        if (value.opcode != Opcode::Greater && value.opcode != Opcode::Less) {
            return std::nullopt;
        }
        const std::string_view text = input_.sources.text(p.condition_span);
        const char sign = value.opcode == Opcode::Greater ? '>' : '<';
        const std::size_t at = text.find_first_of("<>");
        // The text must contain exactly one comparison sign, which belongs to the opcode.
        if (at == std::string_view::npos ||
            text.find_first_of("<>=", at + 1) != std::string_view::npos || text[at] != sign ||
            text.find("/*") != std::string_view::npos) {
            return std::nullopt;
        }
        const auto begin = p.condition_span.begin + static_cast<std::uint32_t>(at);
        std::string mended(text);
        mended.insert(at + 1, "=");
        Fix fix;
        fix.title = fmt::format("write {}", quoted(mended));
        fix.edits = {{{p.condition_span.file, begin, begin + 1}, fmt::format("{}=", sign)}};
        fix.machine_applicable = false;
        return fix;
    }

    /// `a`, `b`: the rows of the first productions that match just below and just above the gap.
    void report_gap(std::uint64_t point,
                    std::size_t axis,
                    std::size_t a,
                    std::size_t b,
                    Diagnostics& diagnostics) const {
        const std::size_t later = std::max(a, b);
        const std::size_t earlier = std::min(a, b);
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::ConditionGap, production(later).condition_span,
            fmt::format("{} matches no production and stays", text_of(point, axis, later)));
        diagnostic.label = "this condition leaves it out";
        diagnostic.labels.push_back({production(earlier).condition_span, "and so does this one"});
        for (const std::size_t row : {later, earlier}) {
            if (std::optional<Fix> fix = inclusive(row)) {
                diagnostic.fixes.push_back(std::move(*fix));
            }
        }
        if (diagnostic.fixes.empty()) {
            diagnostic.help.emplace_back(
                "let one of the conditions include the value with `>=` or `<=`");
        }
    }

    void report_overlap(std::uint64_t point, std::size_t axis, Diagnostics& diagnostics) const {
        std::vector<std::size_t> rows;
        for (std::size_t row = 0; row < table_.productions.size(); ++row) {
            if (table_.holds(row, point)) {
                rows.push_back(row);
            }
        }
        const Production& earlier = production(rows.front());
        const Production& later = production(rows.back());
        if (earlier.stochastic || later.stochastic) {
            return;
        }
        Diagnostic& diagnostic = diagnostics.add(
            DiagnosticCode::ConditionOverlap, later.condition_span,
            fmt::format("{} matches both conditions, and {} takes it",
                        text_of(point, axis, rows.back()), quoted(input_.name(earlier.name))));
        diagnostic.labels.push_back({earlier.condition_span, "the first in the file is taken"});
    }

    /// The module at a point: `A(2)`, or `B(x, y)` with `x == y`.
    std::string text_of(std::uint64_t point, std::size_t axis, std::size_t row) const {
        const analysis::GridAxis& grid_axis = table_.grid.axes[axis];
        const std::optional<std::size_t> other = equal_axis(point, axis);
        const analysis::GridCell& cell =
            grid_axis.cells[grid_axis.samples[table_.grid.sample_of(point, axis)].cell];
        if (!other || cell.low == cell.high) {
            return quoted(module_at(input_, production(row), symbol_, table_, point));
        }
        const Production& p = production(row);
        const std::uint32_t first = p.predecessor.items.front().first_formal;
        const auto name = [&](std::size_t i) {
            return input_.name(p.formals[first + table_.grid.axes[i].parameter]);
        };
        return fmt::format("{} with `{} == {}`", quoted(input_.sources.text(p.predecessor.span)),
                           name(axis), name(*other));
    }

    const CheckInput& input_;
    SymbolId symbol_;
    const RuleTable& table_;
    bool gap_reported_ = false;
    bool overlap_reported_ = false;
};

} // namespace

void check_conditions(const CheckInput& input, Diagnostics& diagnostics) {
    if (input.bytecode == nullptr) {
        return;
    }
    const Bytecode& bytecode = *input.bytecode;
    const analysis::ProductionIndex index(bytecode);
    for (std::uint32_t s = 0; s < bytecode.symbols.size(); ++s) {
        const std::span<const std::uint32_t> productions = index.productions_of(SymbolId{s});
        bool has_contexts = false;
        bool has_conditions = false;
        bool has_unconditional = false;
        for (const std::uint32_t p : productions) {
            const BytecodeProduction& production = bytecode.productions[p];
            check_constant(input, index, p, SymbolId{s}, diagnostics);
            has_contexts = has_contexts || production.has_left || production.has_right;
            has_conditions = has_conditions || production.condition != kNone;
            has_unconditional = has_unconditional || production.condition == kNone;
        }
        // An unconditional production leaves no gap, and with contexts a gap may be intended.
        if (has_contexts || has_unconditional || !has_conditions || productions.size() < 2 ||
            productions.size() > kMaxCompared) {
            continue;
        }
        if (const std::optional<RuleTable> table = make_rule_table(
                bytecode, index, SymbolId{s}, {productions.begin(), productions.end()})) {
            SingleValues(input, SymbolId{s}, *table).run(diagnostics);
        }
    }
}

} // namespace lsys
