// SPDX-License-Identifier: MIT
#include "compiler/instancing/impl/instancing_pass.h"

#include "grammar/base/contract.h"

#include <map>

namespace lsys {

namespace {

class Instancer {
public:
    Instancer(Program& program, const Branches& branches, float rho)
        : program_(program), branches_(branches), rho_(rho) {}

    void run() {
        for (std::size_t i = 0; i < branches_.sites.size();) {
            std::size_t end = i;
            while (end < branches_.sites.size() &&
                   branches_.sites[end].production == branches_.sites[i].production) {
                ++end;
            }
            rewrite(program_.productions[branches_.sites[i].production].successor, i, end);
            i = end;
        }
    }

private:
    /// Replaces the successor `word` by an appended copy with the branch sites [begin, end)
    /// instanced.
    void rewrite(ProgramWord& word, std::size_t begin, std::size_t end) {
        const auto first_module = static_cast<std::uint32_t>(program_.modules.size());
        const auto first_argument = static_cast<std::uint32_t>(program_.arguments.size());
        std::size_t site = begin;
        std::size_t argument = word.first_argument;
        for (std::uint32_t i = 0; i < word.module_count; ++i) {
            ProgramModule module = program_.modules[word.first_module + i];
            if (site < end && branches_.sites[site].open == i) {
                module.symbol = add_arguments(word.span, module.symbol, branches_.sites[site]);
                ++site;
            } else {
                const std::uint32_t count = program_.symbol(module.symbol).parameter_count;
                for (std::uint32_t k = 0; k < count; ++k) {
                    program_.arguments.push_back(ValueId{program_.arguments[argument++]});
                }
            }
            program_.modules.push_back(module);
        }
        LSYS_CHECK(site == end);
        word.first_module = first_module;
        word.first_argument = first_argument;
    }

    /// Appends the arguments of the SaveBranch that replaces `bracket`; returns the symbol of the
    /// SaveBranch.
    SymbolId add_arguments(SourceSpan span, SymbolId bracket, const BranchSite& site) {
        const BranchKind& kind = branches_.kinds[site.kind_id - 1];
        Value draw;
        draw.opcode = Opcode::BranchDraw;
        draw.index = site.number;
        program_.arguments.push_back(
            operation(span, Opcode::Less, add(span, draw), literal(span, rho_)));
        Value step;
        step.opcode = Opcode::Step;
        program_.arguments.push_back(
            operation(span, Opcode::Add, add(span, step), literal(span, 1.0F)));
        program_.arguments.push_back(literal(span, static_cast<float>(site.kind_id)));
        for (const std::uint32_t formal : kind.formals) {
            Value value;
            value.opcode = Opcode::Formal;
            value.index = formal;
            program_.arguments.push_back(add(span, value));
        }
        for (const std::uint32_t local : kind.locals) {
            Value value;
            value.opcode = Opcode::Local;
            value.index = local;
            program_.arguments.push_back(add(span, value));
        }
        return symbol(bracket, kBranchArguments + static_cast<std::uint32_t>(kind.formals.size() +
                                                                             kind.locals.size()));
    }

    ValueId add(SourceSpan span, Value value) {
        value.span = span;
        program_.values.push_back(value);
        return ValueId{static_cast<std::uint32_t>(program_.values.size() - 1)};
    }
    ValueId literal(SourceSpan span, float number) {
        Value value;
        value.opcode = Opcode::Literal;
        value.literal = number;
        return add(span, value);
    }
    ValueId operation(SourceSpan span, Opcode opcode, ValueId left, ValueId right) {
        Value value;
        value.opcode = opcode;
        value.left = left;
        value.right = right;
        return add(span, value);
    }

    /// The symbol of SaveBranch with this number of parameters and the name of `bracket`.
    SymbolId symbol(SymbolId bracket, std::uint32_t parameters) {
        const auto [known, is_new] = symbols_.emplace(
            parameters, SymbolId{static_cast<std::uint32_t>(program_.symbols.size())});
        if (is_new) {
            Symbol save_branch = program_.symbol(bracket);
            save_branch.parameter_count = parameters;
            save_branch.turtle = TurtleOperation::SaveBranch;
            program_.symbols.push_back(save_branch);
        }
        return known->second;
    }

    Program& program_;
    const Branches& branches_;
    float rho_;
    std::map<std::uint32_t, SymbolId> symbols_; // by number of parameters
};

} // namespace

void instance_branches(Program& program, const Branches& branches, float rho) {
    LSYS_CHECK(rho >= 0.0F && rho <= 1.0F);
    Instancer(program, branches, rho).run();
}

} // namespace lsys
