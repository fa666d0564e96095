// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_program.h"

#include "compiler/bytecode/interpret.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kStepConstant = 0;
constexpr std::uint32_t kStepsConstant = 1;
constexpr std::uint32_t kFirstGlobal = 2;

/// The operations of a chain; empty if the value cannot be computed by a chain.
using Chain = std::vector<SweepOperation>;

/// Longer chains are left to the stack machine.
constexpr std::size_t kMaxChain = 32;

/// Number of slots that a chain uses.
std::uint32_t slot_count(const Chain& chain) {
    std::uint32_t count = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) {
        if (chain[i].opcode == Opcode::Formal) {
            count = std::max(count, chain[i].slot + 1);
        }
    }
    return count;
}

} // namespace

/// The Domain of interpret() whose values are chains.
class SweepProgram::Compiler : public UnknownDomain<Chain> {
public:
    Compiler(const Bytecode& bytecode,
             const BytecodeProduction& production,
             std::vector<float>& constants)
        : bytecode_(bytecode), constants_(constants) {
        add_module(bytecode.patterns[production.predecessor.first], kOwnBase);
    }

    /// Declares that formals of `item` are read from `base`.
    void add_module(const PatternItem& item, std::uint32_t base) {
        sources_.push_back(
            {item.first_formal, bytecode_.symbol(item.symbol).parameter_count, base});
    }

    /// The chains of the values that the code at `first` takes; nothing if one is not a chain.
    std::optional<std::vector<Chain>> run(std::uint32_t first) {
        taken_.clear();
        std::vector<Chain> stack(std::max<std::size_t>(bytecode_.stack_depth, 1));
        std::vector<Chain> slots(std::max<std::size_t>(bytecode_.local_count, 1));
        if (!interpret(bytecode_.instructions.data() + first, *this, stack.data(), slots.data())) {
            return std::nullopt;
        }
        return std::move(taken_);
    }

    Chain literal(float value) {
        constants_.push_back(value);
        return constant(static_cast<std::uint32_t>(constants_.size() - 1));
    }
    [[nodiscard]] Chain formal(std::uint32_t index) const {
        for (const Source& source : sources_) {
            if (index >= source.first && index - source.first < source.count) {
                return {{Opcode::Formal, source.base, index - source.first}};
            }
        }
        return {};
    }
    static Chain global(std::uint32_t index) { return constant(kFirstGlobal + index); }
    static Chain step() { return constant(kStepConstant); }
    static Chain steps() { return constant(kStepsConstant); }
    static Chain unary(Opcode opcode, Chain x) {
        if (!x.empty()) {
            // The operation ignores its operand.
            x.push_back({opcode, kConstantBase, kStepConstant});
        }
        return x;
    }
    static Chain binary(Opcode opcode, Chain x, Chain y) {
        const bool commutes = opcode == Opcode::Add || opcode == Opcode::Multiply;
        if (y.size() != 1 && x.size() == 1 && commutes) {
            std::swap(x, y);
        }
        if (x.empty() || y.empty() || x.size() + y.size() > kMaxChain) {
            return {};
        }
        if (y.size() == 1) {
            x.push_back({opcode, y[0].base, y[0].index});
            return x;
        }
        // The value of y waits while that of x is computed.
        const std::uint32_t slot = slot_count(x);
        if (slot == kMaxSweepSlots) {
            return {};
        }
        x.front().slot = slot;
        y.insert(y.end(), x.begin(), x.end());
        y.push_back({opcode, kSlotBase, slot});
        return y;
    }
    bool take(Chain x, const std::uint32_t* /*at*/) {
        taken_.push_back(std::move(x));
        return !taken_.back().empty();
    }

private:
    struct Source {
        std::uint32_t first = 0; // index of the first formal
        std::uint32_t count = 0; // number of formals
        std::uint32_t base = 0;  // index in SweepBases
    };

    static Chain constant(std::uint32_t index) { return {{Opcode::Formal, kConstantBase, index}}; }

    const Bytecode& bytecode_;
    std::vector<float>& constants_;
    std::vector<Source> sources_;
    std::vector<Chain> taken_; // chains of the values taken so far
};

SweepProgram::SweepProgram(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage)
    : stage_(stage), constants_{0.0F, inputs.steps} {
    constants_.insert(constants_.end(), inputs.globals, inputs.globals + bytecode.globals.size());
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
        if (productions[symbol].empty()) {
            continue;
        }
        Row& row = rows_[symbol]; // modules of a swept symbol are not folded
        row.kind = Kind::Chains;
        row.candidates.first = static_cast<std::uint32_t>(candidates_.size());
        for (const std::uint32_t p : productions[symbol]) {
            if (!add_candidate(bytecode, bytecode.productions[p])) {
                row.kind = Kind::General;
                has_general_ = true;
                break;
            }
            ++row.candidates.count;
        }
    }
}

bool SweepProgram::add_contexts(const Bytecode& bytecode,
                                TableRange pattern,
                                Compiler& compiler,
                                SweepCandidate& candidate) {
    candidate.branches.first = static_cast<std::uint32_t>(branches_.size());
    const PatternItem* item = bytecode.patterns.data() + pattern.first;
    const PatternItem* const end = item + pattern.count;
    while (item != end) {
        SweepContext context{kNoSymbol, kFirstContextBase + candidate.branches.count};
        if (candidate.branches.count + 1 == kMaxSweepContexts) {
            return false;
        }
        const bool is_branch = item->kind == PatternKind::Open;
        item += is_branch ? 1 : 0;
        if (item->kind == PatternKind::Module) {
            compiler.add_module(*item, context.base);
            context.symbol = item->symbol;
            ++item;
        }
        if (!is_branch) {
            candidate.has_axis = true;
            candidate.axis = context;
            return item == end;
        }
        branches_.push_back(context);
        ++candidate.branches.count;
        if (item->kind != PatternKind::Close) {
            return false; // a longer axis, or a branch of the branch
        }
        ++item;
    }
    return true;
}

bool SweepProgram::add_candidate(const Bytecode& bytecode, const BytecodeProduction& production) {
    SweepCandidate candidate;
    const WordTemplate& successor = production.successor;
    Compiler compiler(bytecode, production, constants_);
    if (production.stochastic || successor.locals != kNone ||
        successor.parameter_count > kMaxSweepParameters ||
        !add_contexts(bytecode, stage_ == Stage::Down ? production.right : production.left,
                      compiler, candidate)) {
        return false;
    }
    const auto add_chain = [this](const Chain& chain) {
        const TableRange range{static_cast<std::uint32_t>(operations_.size()),
                               static_cast<std::uint32_t>(chain.size())};
        operations_.insert(operations_.end(), chain.begin(), chain.end());
        return range;
    };
    if (production.condition != kNone) {
        const std::optional<std::vector<Chain>> condition = compiler.run(production.condition);
        if (!condition || condition->size() != 1) {
            return false;
        }
        candidate.condition = add_chain(condition->front());
    }
    candidate.chains.first = static_cast<std::uint32_t>(chains_.size());
    if (successor.arguments != kNone) {
        const std::optional<std::vector<Chain>> values = compiler.run(successor.arguments);
        if (!values || values->size() != successor.parameter_count) {
            return false;
        }
        for (const Chain& chain : *values) {
            chains_.push_back(add_chain(chain));
        }
    }
    candidate.chains.count = successor.parameter_count;
    candidates_.push_back(candidate);
    return true;
}

void SweepProgram::set_age(std::uint32_t age) {
    constants_[kStepConstant] = static_cast<float>(age);
}

std::uint64_t SweepProgram::held_bytes() const {
    return rows_.capacity() * sizeof(Row) + candidates_.capacity() * sizeof(SweepCandidate) +
           branches_.capacity() * sizeof(SweepContext) + chains_.capacity() * sizeof(TableRange) +
           operations_.capacity() * sizeof(SweepOperation) + constants_.capacity() * sizeof(float);
}

} // namespace lsys
