// SPDX-License-Identifier: MIT
// SweepProgram: the productions of a sweep in the form that its loop runs. Productions whose
// expressions are chains and whose context is one module and the branches before it need neither the
// stack machine nor tables of neighbours: the loop keeps the neighbours while it passes them. A
// chain is an expression of formals, constants and operators without a condition or a draw; a value
// that an operator needs later, `c op d` in `(a op b) op (c op d)`, waits in a slot. Symbols with
// other productions have Kind::General.
#pragma once

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lsys {

/// Max modules of a context, and max parameters of a module, that a SweepProgram handles.
inline constexpr std::size_t kMaxSweepContexts = 4;
inline constexpr std::size_t kMaxSweepParameters = 16;
/// Max values of a chain that wait at the same time.
inline constexpr std::uint32_t kMaxSweepSlots = 8;

/// Parameters of the modules that a production reads: the module's own, the constants, then the
/// modules of the context in text order, then the slots of values that wait.
using SweepBases = std::array<const float*, 3 + kMaxSweepContexts>;
inline constexpr std::uint32_t kOwnBase = 0;
inline constexpr std::uint32_t kConstantBase = 1;
inline constexpr std::uint32_t kFirstContextBase = 2;
inline constexpr std::uint32_t kSlotBase = kFirstContextBase + kMaxSweepContexts;

/// One operation of a chain: value = opcode(value, bases[base][index]). Formal: the value so far
/// moves to `slot`, and the operand becomes the value.
struct SweepOperation {
    Opcode opcode = Opcode::Formal;
    std::uint32_t base = 0;
    std::uint32_t index = 0;
    std::uint32_t slot = 0;
};

/// A neighbour of a module: kNoSymbol if there is none.
struct SweepNeighbour {
    SymbolId symbol = kNoSymbol;
    const float* parameters = nullptr;
};

/// An element of a context: the first module of a branch, or the next module of the axis.
struct SweepContext {
    SymbolId symbol = kNoSymbol; // kNoSymbol: any branch
    std::uint32_t base = 0;      // index in SweepBases
};

struct SweepCandidate {
    bool has_axis = false; // whether the context has a module of the axis
    SweepContext axis;
    TableRange branches;  // of SweepProgram::branch(), in text order, before the module of the axis
    TableRange condition; // range of operations; count 0: the condition always holds
    TableRange chains;    // one per parameter
};

class SweepProgram {
public:
    enum class Kind : std::uint8_t { Unchanged, Chains, General };
    struct Row {
        SymbolId symbol = kNoSymbol;
        std::uint32_t stored = 0;        // parameters in the word
        std::uint32_t constants = kNone; // folded module: index in Bytecode::constants
        TableRange candidates;           // Kind::Chains; in file order
        ContextRole role = ContextRole::Module;
        Kind kind = Kind::Unchanged;
    };

    /// The productions of `stage`, Down or Up.
    SweepProgram(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage);

    /// Sets the value of step().
    void set_age(std::uint32_t age);
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; } // by code
    /// Whether some symbol has Kind::General.
    [[nodiscard]] bool has_general() const { return has_general_; }
    [[nodiscard]] const SweepCandidate& candidate(std::uint32_t index) const {
        return candidates_[index];
    }
    [[nodiscard]] const SweepContext& branch(std::uint32_t index) const { return branches_[index]; }
    [[nodiscard]] const float* constants() const { return constants_.data(); }
    /// The value of a condition. `slots`: those of kSlotBase.
    [[nodiscard]] float
    condition_value(const SweepCandidate& candidate, const SweepBases& bases, float* slots) const {
        return value(candidate.condition, bases, slots);
    }
    /// Value `index` of the successor.
    [[nodiscard]] float parameter_value(const SweepCandidate& candidate,
                                        std::uint32_t index,
                                        const SweepBases& bases,
                                        float* slots) const {
        return value(chains_[candidate.chains.first + index], bases, slots);
    }
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    class Compiler; // compiles expressions to chains

    [[nodiscard]] float value(TableRange chain, const SweepBases& bases, float* slots) const {
        const SweepOperation* operation = operations_.data() + chain.first;
        const SweepOperation* const end = operation + chain.count;
        float result = bases[operation->base][operation->index];
        for (++operation; operation != end; ++operation) {
            const float operand = bases[operation->base][operation->index];
            switch (operation->opcode) {
            case Opcode::Formal:
                slots[operation->slot] = result;
                result = operand;
                break;
            case Opcode::Add:
                result = result + operand;
                break;
            case Opcode::Multiply:
                result = result * operand;
                break;
            case Opcode::Max:
                result = arithmetic::maximum(result, operand);
                break;
            default:
                result = arithmetic::apply(operation->opcode, result, operand);
                break;
            }
        }
        return result;
    }
    /// Adds a production; returns false if it is not of the form that chains need.
    [[nodiscard]] bool add_candidate(const Bytecode& bytecode,
                                     const BytecodeProduction& production);
    /// Adds the elements of the context, and tells `compiler` where their formals are. Returns
    /// false if the context is anything but branches of at most one module each, followed by at
    /// most one module.
    [[nodiscard]] bool add_contexts(const Bytecode& bytecode,
                                    TableRange pattern,
                                    Compiler& compiler,
                                    SweepCandidate& candidate);

    Stage stage_;
    std::vector<Row> rows_;
    std::vector<SweepCandidate> candidates_;
    std::vector<SweepContext> branches_;
    std::vector<TableRange> chains_; // ranges of operations_
    std::vector<SweepOperation> operations_;
    std::vector<float> constants_; // step(), steps(), the globals, literals
    bool has_general_ = false;
};

} // namespace lsys
