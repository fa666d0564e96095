// SPDX-License-Identifier: MIT
#include "compiler/growth/production_index.h"

#include <algorithm>

namespace lsys::analysis {

ProductionIndex::ProductionIndex(const Bytecode& bytecode) : bytecode_(&bytecode) {
    const TableRange rewriting = bytecode.productions_of(Stage::Rewrite);
    by_symbol_ = GroupedLists(bytecode.symbols.size(), [&](auto&& add) {
        for (std::uint32_t p = 0; p < rewriting.count; ++p) {
            const TableRange predecessor = bytecode.productions[p].predecessor;
            if (predecessor.count == 1) {
                add(static_cast<std::size_t>(bytecode.patterns[predecessor.first].symbol), p);
            }
        }
    });
    by_group_ = GroupedLists(bytecode.context_group_count, [&](auto&& add) {
        for (std::uint32_t p = 0; p < rewriting.count; ++p) {
            if (bytecode.productions[p].stochastic) {
                add(bytecode.productions[p].group, p);
            }
        }
    });
    find_relevant_parameters();
    find_age_dependence();
}

template <typename Visit>
bool ProductionIndex::scan(std::uint32_t production,
                           InstructionRange instructions,
                           Visit&& visit) const {
    const PatternItem& head =
        bytecode_->patterns[bytecode_->productions[production].predecessor.first];
    const std::uint32_t count = bytecode_->symbol(head.symbol).parameter_count;
    bool calls_step = false;
    bool uses_locals = false;
    const auto read = [&](const InstructionRange& range) {
        for (const Instruction instruction : range) {
            if (instruction.opcode == Opcode::Formal && instruction.operand >= head.first_formal &&
                instruction.operand - head.first_formal < count) {
                visit(parameter_base_[static_cast<std::size_t>(head.symbol)] + instruction.operand -
                      head.first_formal);
            }
            calls_step = calls_step || instruction.opcode == Opcode::Step;
            uses_locals = uses_locals || instruction.opcode == Opcode::Local;
        }
    };
    read(instructions);
    const std::uint32_t locals = bytecode_->productions[production].successor.locals;
    if (uses_locals && locals != kNone) {
        read(InstructionRange(bytecode_->instructions, locals));
    }
    return calls_step;
}

void ProductionIndex::find_relevant_parameters() {
    const Bytecode& bytecode = *bytecode_;
    std::uint32_t parameters = 0;
    for (const BytecodeSymbol& symbol : bytecode.symbols) {
        parameter_base_.push_back(parameters);
        parameters += symbol.parameter_count;
    }
    relevant_.assign(parameters, false);
    std::vector<std::uint32_t> work;
    const auto mark = [&](std::uint32_t parameter) {
        if (!relevant_[parameter]) {
            relevant_[parameter] = true;
            any_relevant_ = true;
            work.push_back(parameter);
        }
    };
    for (const std::uint32_t p : by_symbol_.all()) {
        const BytecodeProduction& production = bytecode.productions[p];
        for (const std::uint32_t code : {production.condition, production.weight_code}) {
            if (code != kNone) {
                depends_on_age_ |= scan(p, InstructionRange(bytecode.instructions, code), mark);
            }
        }
    }
    if (work.empty()) {
        return;
    }
    struct Edge {
        std::uint32_t to;
        std::uint32_t from; // parameter read by the argument that computes parameter `to`
    };
    std::vector<Edge> edges;
    for (const std::uint32_t p : by_symbol_.all()) {
        const WordTemplate& successor = bytecode.productions[p].successor;
        if (successor.parameter_count == 0) {
            continue;
        }
        for_each_argument(
            bytecode, successor,
            [&](Code code, std::uint32_t argument, InstructionRange instructions) {
                const std::uint32_t to = parameter_base_[code] + argument;
                scan(p, instructions, [&](std::uint32_t from) { edges.push_back({to, from}); });
                return true;
            });
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.to != b.to ? a.to < b.to : a.from < b.from;
    });
    while (!work.empty()) {
        const std::uint32_t to = work.back();
        work.pop_back();
        auto edge =
            std::lower_bound(edges.begin(), edges.end(), to,
                             [](const Edge& e, std::uint32_t value) { return e.to < value; });
        for (; edge != edges.end() && edge->to == to; ++edge) {
            mark(edge->from);
        }
    }
}

void ProductionIndex::find_age_dependence() {
    if (!any_relevant_ || depends_on_age_) {
        return;
    }
    for (const std::uint32_t p : by_symbol_.all()) {
        const WordTemplate& successor = bytecode_->productions[p].successor;
        if (successor.parameter_count == 0) {
            continue;
        }
        for_each_argument(*bytecode_, successor,
                          [&](Code code, std::uint32_t argument, InstructionRange instructions) {
                              if (relevant_[parameter_base_[code] + argument]) {
                                  depends_on_age_ |= scan(p, instructions, [](std::uint32_t) {});
                              }
                              return !depends_on_age_;
                          });
    }
}

std::vector<std::uint32_t> changed_parameters(const Bytecode& bytecode) {
    constexpr std::uint32_t kTurtleAnswer = 3; // x, y and z
    std::vector<std::uint32_t> changed(bytecode.symbols.size(), 0);
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        if (symbol.senses()) {
            const std::uint32_t answer =
                asks_environment(symbol.sense)
                    ? answer_size(
                          bytecode.environments[static_cast<std::size_t>(symbol.sense)].kind)
                    : kTurtleAnswer;
            changed[i] = std::min(symbol.parameter_count, answer);
        }
    }
    for (const BytecodeProduction& production : bytecode.productions) {
        if (production.stage == Stage::Down || production.stage == Stage::Up) {
            const auto swept =
                static_cast<std::size_t>(bytecode.patterns[production.predecessor.first].symbol);
            changed[swept] = bytecode.symbols[swept].parameter_count;
        }
    }
    return changed;
}

std::uint32_t ProductionIndex::relevant_count(SymbolId symbol) const {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < bytecode_->symbol(symbol).parameter_count; ++i) {
        count += is_relevant(symbol, i) ? 1U : 0U;
    }
    return count;
}

} // namespace lsys::analysis
