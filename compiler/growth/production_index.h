// SPDX-License-Identifier: MIT
// The productions of each symbol and of each stochastic group, and the relevant parameters: the
// parameters that a condition or weight reads, or from which successors compute relevant ones.
#pragma once

#include "compiler/bytecode/instructions.h"
#include "grammar/base/grouped_lists.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys::analysis {

class ProductionIndex {
public:
    /// `bytecode` is verified and outlives this object.
    explicit ProductionIndex(const Bytecode& bytecode);

    /// The productions whose predecessor is one module of this symbol, in file order.
    [[nodiscard]] std::span<const std::uint32_t> productions_of(SymbolId symbol) const {
        return by_symbol_[static_cast<std::size_t>(symbol)];
    }
    /// The stochastic productions of a group, in file order.
    [[nodiscard]] std::span<const std::uint32_t> group(std::uint32_t group) const {
        return by_group_[group];
    }
    /// The formal that is the first parameter of a production's predecessor.
    [[nodiscard]] std::uint32_t first_formal(std::uint32_t production) const {
        return bytecode_->patterns[bytecode_->productions[production].predecessor.first]
            .first_formal;
    }

    /// Whether the parameter can decide how modules are rewritten: a condition, a weight or an
    /// argument for a relevant parameter reads it.
    [[nodiscard]] bool is_relevant(SymbolId symbol, std::uint32_t parameter) const {
        return relevant_[parameter_base_[static_cast<std::size_t>(symbol)] + parameter];
    }
    /// Number of relevant parameters of a symbol.
    [[nodiscard]] std::uint32_t relevant_count(SymbolId symbol) const;
    /// Whether some symbol has a relevant parameter.
    [[nodiscard]] bool any_relevant() const { return any_relevant_; }
    /// Whether a condition, a weight or a relevant argument calls step().
    [[nodiscard]] bool depends_on_age() const { return depends_on_age_; }

private:
    /// Sets relevant_.
    void find_relevant_parameters();
    /// Sets depends_on_age_.
    void find_age_dependence();
    /// Calls visit(parameter) for each formal of the predecessor that the instructions, or local
    /// values used by them, read. Returns whether the instructions or these values call step().
    template <typename Visit>
    bool scan(std::uint32_t production, InstructionRange instructions, Visit&& visit) const;

    const Bytecode* bytecode_;
    GroupedLists by_symbol_;                    // see productions_of()
    GroupedLists by_group_;                     // see group()
    std::vector<std::uint32_t> parameter_base_; // by symbol: its first parameter in relevant_
    std::vector<bool> relevant_;                // by number of the parameter, see parameter_base_
    bool any_relevant_ = false;
    bool depends_on_age_ = false;
};

/// Per symbol: how many of its parameters, counted from the first, an answer to a sense module or a
/// sweep may change; for a swept module, all of them.
[[nodiscard]] std::vector<std::uint32_t> changed_parameters(const Bytecode& bytecode);

/// Calls visit(code, argument, instructions of the argument) for each stored parameter of a word
/// until `visit` returns false.
template <typename Visit>
void for_each_argument(const Bytecode& bytecode, const WordTemplate& word, Visit&& visit) {
    std::uint32_t at = word.arguments;
    for (std::uint32_t i = 0; i < word.codes.count; ++i) {
        const Code code = bytecode.template_codes[word.codes.first + i];
        const std::uint32_t count = bytecode.stored_parameters(code);
        for (std::uint32_t argument = 0; argument < count; ++argument) {
            const std::uint32_t first = at;
            while (opcode_of(bytecode.instructions[at]) != Opcode::Emit) {
                at += instruction_length(opcode_of(bytecode.instructions[at]));
            }
            ++at;
            if (!visit(code, argument, InstructionRange(bytecode.instructions, first, at))) {
                return;
            }
        }
    }
}

} // namespace lsys::analysis
