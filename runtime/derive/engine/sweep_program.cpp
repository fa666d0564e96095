// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_program.h"

#include <algorithm>

namespace lsys {

SweepProgram::SweepProgram(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage)
    : stage_(stage) {
    code_.constants = {0.0F, inputs.steps};
    code_.constants.insert(code_.constants.end(), inputs.globals,
                           inputs.globals + bytecode.globals.size());
    for (Code code = 0; code < bytecode.code_count(); ++code) {
        Row& row = rows_.emplace_back();
        row.symbol = bytecode.symbol_of(code);
        row.stored = bytecode.stored_parameters(code);
        row.role = context_role(bytecode.symbol(row.symbol));
        if (code >= bytecode.symbols.size()) {
            row.constants = bytecode.folded[code - bytecode.symbols.size()].first_constant;
        }
    }
    std::vector<std::vector<std::uint32_t>> productions(bytecode.symbols.size()); // by symbol
    const TableRange range = bytecode.productions_of(stage);
    for (std::uint32_t p = range.first; p < range.first + range.count; ++p) {
        const TableRange predecessor = bytecode.productions[p].predecessor;
        const SymbolId symbol = bytecode.patterns[predecessor.first].symbol;
        productions[static_cast<std::size_t>(symbol)].push_back(p);
    }
    for (std::size_t symbol = 0; symbol < productions.size(); ++symbol) {
        Row& row = rows_[symbol]; // modules of a swept symbol are not folded
        row.candidates.first = static_cast<std::uint32_t>(candidates_.size());
        for (const std::uint32_t p : productions[symbol]) {
            add_candidate(bytecode, bytecode.productions[p], row);
        }
        row.candidates.count =
            static_cast<std::uint32_t>(candidates_.size()) - row.candidates.first;
        for (std::uint32_t i = 0; i < row.candidates.count; ++i) {
            add_outcomes(row.candidates.first + i, row.candidates.first + row.candidates.count);
        }
    }
}

TableRange SweepProgram::add_context(const Bytecode& bytecode,
                                     const BytecodeProduction& production,
                                     SweepCompiler& compiler) {
    const TableRange pattern = stage_ == Stage::Down ? production.right : production.left;
    TableRange range{static_cast<std::uint32_t>(items_.size()), pattern.count};
    SweepReach reach;
    std::uint32_t open = 0;
    for (std::uint32_t i = 0; i < pattern.count; ++i) {
        // From the module outwards: a left context is read from its end.
        const std::uint32_t at = stage_ == Stage::Down ? i : pattern.count - 1 - i;
        const PatternItem& item = bytecode.patterns[pattern.first + at];
        const std::uint32_t base = kFirstContextBase + i;
        items_.push_back({item.kind, item.symbol, base});
        if (item.kind == PatternKind::Module) {
            compiler.add_module(item, base);
        }
        reach.items += item.kind == PatternKind::Close ? 0 : 1;
        open += item.kind == PatternKind::Open ? 1 : 0;
        open -= item.kind == PatternKind::Close ? 1 : 0;
        reach.nesting = std::max(reach.nesting, open);
        base_count_ = std::max(base_count_, base + 1);
    }
    reach_.items = std::max(reach_.items, reach.items);
    reach_.nesting = std::max(reach_.nesting, reach.nesting);
    return range;
}

void SweepProgram::add_candidate(const Bytecode& bytecode,
                                 const BytecodeProduction& production,
                                 Row& row) {
    const bool draws_choice =
        production.stochastic && bytecode.settings.choice == ChoiceScope::Module;
    const std::uint64_t first_draw = first_sweep_draw(stage_);
    SweepCompiler compiler(bytecode, code_, first_draw + (draws_choice ? 1 : 0));
    SweepCandidate candidate;
    candidate.rule = production.rule;
    candidate.group = production.group;
    candidate.is_stochastic = production.stochastic;
    candidate.weight = production.weight;
    compiler.add_module(bytecode.patterns[production.predecessor.first], kOwnBase);
    candidate.context = add_context(bytecode, production, compiler);
    if (candidate.context.count == 1) { // a single element is a module
        candidate.kind = SweepCandidate::Context::Module;
        candidate.module = items_[candidate.context.first];
    } else if (candidate.context.count > 1) {
        candidate.kind = SweepCandidate::Context::Items;
    }
    if (production.condition != kNone) {
        candidate.condition = compiler.condition(production.condition);
    }
    candidate.is_certain = production.condition == kNone && !production.stochastic;
    if (production.weight_code != kNone) {
        candidate.weight_code = compiler.condition(production.weight_code);
    }
    candidate.successor = compiler.successor(production.successor);
    candidate.value_count = production.successor.parameter_count;
    if (draws_choice) {
        choice_draw_ = code_.draw(first_draw);
    }
    row.draws = row.draws || draws_choice || compiler.draws();
    candidates_.push_back(candidate);
}

// Adds in the order of SweepVisitor::choose_among(), because the order decides the rounding.
void SweepProgram::add_outcomes(std::uint32_t first, std::uint32_t end) {
    if (!candidates_[first].is_stochastic) {
        return;
    }
    std::vector<std::uint32_t> chosen;
    float sum = 0.0F;
    for (std::uint32_t i = first; i < end; ++i) {
        const SweepCandidate& each = candidates_[i];
        if (each.group != candidates_[first].group || !each.is_stochastic) {
            continue;
        }
        if ((i != first && each.condition != kNone) || each.weight_code != kNone) {
            return;
        }
        sum += each.weight;
        if (each.weight != 0.0F) {
            chosen.push_back(i);
        }
    }
    candidates_[first].outcomes = {static_cast<std::uint32_t>(outcomes_.size()),
                                   static_cast<std::uint32_t>(chosen.size())};
    float threshold = 0.0F;
    for (const std::uint32_t i : chosen) {
        threshold += candidates_[i].weight / sum;
        outcomes_.push_back({i, threshold});
    }
}

void SweepProgram::set_age(std::uint32_t age) {
    code_.constants[kStepConstant] = static_cast<float>(age);
}

void SweepProgram::prepare(SweepMachine& machine) const {
    machine.reserve(base_count_, code_.slot_count, code_.value_count);
    machine.set_base(kConstantBase, code_.constants.data());
}

std::uint64_t SweepProgram::held_bytes() const {
    return rows_.capacity() * sizeof(Row) + candidates_.capacity() * sizeof(SweepCandidate) +
           items_.capacity() * sizeof(SweepItem) + outcomes_.capacity() * sizeof(SweepOutcome) +
           code_.operations.capacity() * sizeof(SweepOperation) +
           code_.constants.capacity() * sizeof(float);
}

} // namespace lsys
