#include "compiler/growth/production_index.h"

#include <algorithm>

namespace lsys::analysis {

ProductionIndex::ProductionIndex(const Bytecode& bytecode) : bytecode_(&bytecode) {
    list_productions();
    find_relevant();
    find_age();
}

void ProductionIndex::list_productions() {
    const Bytecode& bytecode = *bytecode_;
    const auto symbol_of = [&](const BytecodeProduction& production) {
        return static_cast<std::size_t>(bytecode.patterns[production.predecessor.first].symbol);
    };
    first_.assign(bytecode.symbols.size() + 1, 0);
    group_first_.assign(std::size_t{bytecode.group_count} + 1, 0);
    for (const BytecodeProduction& production : bytecode.productions) {
        if (production.stage != Stage::Rewrite) {
            break;
        }
        if (production.predecessor.count == 1) {
            ++first_[symbol_of(production) + 1];
        }
        if (production.stochastic) {
            ++group_first_[production.group + 1];
        }
    }
    for (std::size_t i = 1; i < first_.size(); ++i) {
        first_[i] += first_[i - 1];
    }
    for (std::size_t i = 1; i < group_first_.size(); ++i) {
        group_first_[i] += group_first_[i - 1];
    }
    list_.resize(first_.back());
    group_list_.resize(group_first_.back());
    std::vector<std::uint32_t> next = first_;
    std::vector<std::uint32_t> next_in_group = group_first_;
    for (std::uint32_t p = 0; p < bytecode.productions.size(); ++p) {
        const BytecodeProduction& production = bytecode.productions[p];
        if (production.stage != Stage::Rewrite) {
            break;
        }
        if (production.predecessor.count == 1) {
            list_[next[symbol_of(production)]++] = p;
        }
        if (production.stochastic) {
            group_list_[next_in_group[production.group]++] = p;
        }
    }
}

template <typename Visit>
bool ProductionIndex::scan(std::uint32_t production,
                           std::uint32_t first,
                           std::uint32_t last,
                           Visit&& visit) const {
    const PatternItem& head =
        bytecode_->patterns[bytecode_->productions[production].predecessor.first];
    const std::uint32_t count = bytecode_->symbol(head.symbol).parameter_count;
    bool asks_step = false;
    for (std::uint32_t at = first; at < last;) {
        const std::uint32_t word = bytecode_->instructions[at];
        if (opcode_of(word) == Opcode::Formal && operand_of(word) >= head.first_formal &&
            operand_of(word) - head.first_formal < count) {
            visit(parameter_base_[static_cast<std::size_t>(head.symbol)] + operand_of(word) -
                  head.first_formal);
        }
        asks_step = asks_step || opcode_of(word) == Opcode::Step;
        at += instruction_length(opcode_of(word));
    }
    return asks_step;
}

void ProductionIndex::find_relevant() {
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
    for (const std::uint32_t p : list_) {
        const std::uint32_t first = bytecode.productions[p].condition;
        if (first == kNone) {
            continue;
        }
        std::uint32_t last = first;
        while (opcode_of(bytecode.instructions[last]) != Opcode::Test) {
            last += instruction_length(opcode_of(bytecode.instructions[last]));
        }
        depends_on_age_ |= scan(p, first, last, mark);
    }
    if (work.empty()) {
        return;
    }
    struct Edge {
        std::uint32_t to;
        std::uint32_t from; // `to` is computed from it
    };
    std::vector<Edge> edges;
    for (const std::uint32_t p : list_) {
        const WordTemplate& successor = bytecode.productions[p].successor;
        if (successor.parameter_count == 0) {
            continue;
        }
        for_each_argument(
            bytecode, successor,
            [&](Code code, std::uint32_t argument, std::uint32_t first, std::uint32_t last) {
                const std::uint32_t to = parameter_base_[code] + argument;
                scan(p, first, last, [&](std::uint32_t from) { edges.push_back({to, from}); });
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

void ProductionIndex::find_age() {
    if (!any_relevant_ || depends_on_age_) {
        return;
    }
    for (const std::uint32_t p : list_) {
        const WordTemplate& successor = bytecode_->productions[p].successor;
        if (successor.parameter_count == 0) {
            continue;
        }
        for_each_argument(
            *bytecode_, successor,
            [&](Code code, std::uint32_t argument, std::uint32_t first, std::uint32_t last) {
                if (relevant_[parameter_base_[code] + argument]) {
                    depends_on_age_ |= scan(p, first, last, [](std::uint32_t) {});
                }
                return !depends_on_age_;
            });
    }
}

std::uint32_t ProductionIndex::relevant_count(SymbolId symbol) const {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < bytecode_->symbol(symbol).parameter_count; ++i) {
        count += is_relevant(symbol, i) ? 1U : 0U;
    }
    return count;
}

} // namespace lsys::analysis
