// SPDX-License-Identifier: MIT
// SweepProgram: the productions of a sweep in the form that its loop runs: contexts as items that
// SweepNeighbours are compared with, expressions as operations of a SweepMachine.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/sweep_compiler.h"
#include "runtime/derive/engine/sweep_neighbours.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Number of the first draw in `#down` sweeps (docs/language.md section 6).
inline constexpr std::uint64_t kFirstDownDraw = (std::uint64_t{1} << 32) + (std::uint64_t{1} << 30);
inline constexpr std::uint64_t kFirstUpDraw = kFirstDownDraw + (std::uint64_t{1} << 29);
[[nodiscard]] constexpr std::uint64_t first_sweep_draw(Stage stage) {
    return stage == Stage::Down ? kFirstDownDraw : kFirstUpDraw;
}

/// An element of a context, from the swept module outwards.
struct SweepItem {
    PatternKind kind = PatternKind::Module;
    SymbolId symbol = kNoSymbol;
    std::uint32_t base = 0; // SweepOperand::base of the module's parameters
};

/// A production of a sweep, in one cache line.
struct alignas(64) SweepCandidate {
    /// The context: none, one module, or else `context`.
    enum class Context : std::uint8_t { None, Module, Items };
    Context kind = Context::None;
    bool is_stochastic = false;
    bool is_certain = false;         // matches without a condition, and is not chosen at random
    SweepItem module;                // for Context::Module
    TableRange context;              // of SweepProgram::items()
    std::uint32_t condition = kNone; // first operation, or kNone: always holds
    std::uint32_t successor = kNone;
    std::uint32_t value_count = 0;
    std::uint32_t rule = 0;
    std::uint32_t group = 0; // candidates of a group have the same context
    float weight = 0.0F;
    std::uint32_t weight_code = kNone; // first operation of a weight that is not constant
    /// Range of SweepProgram::outcomes(): the random choice that begins with this candidate. Empty
    /// if a weight of its group is not constant or a later candidate of the group has a condition.
    TableRange outcomes;
};

/// A candidate of a random choice. Thresholds ascend: a draw takes the first above it.
struct SweepOutcome {
    std::uint32_t candidate = 0;
    float threshold = 0.0F;
};

class SweepProgram {
public:
    struct Row {
        SymbolId symbol = kNoSymbol;
        std::uint32_t stored = 0;        // parameters in the word
        std::uint32_t constants = kNone; // folded module: index in Bytecode::constants
        TableRange candidates;           // in file order
        ContextRole role = ContextRole::Module;
        bool draws = false; // some candidate uses random draws
    };

    /// The productions of `stage`, Down or Up.
    SweepProgram(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage);

    /// Sets the value of step().
    void set_age(std::uint32_t age);
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; } // by code
    [[nodiscard]] const SweepCandidate* candidates() const { return candidates_.data(); }
    [[nodiscard]] const SweepItem* items() const { return items_.data(); }
    [[nodiscard]] const SweepOutcome* outcomes() const { return outcomes_.data(); }
    [[nodiscard]] const SweepOperation* operations() const { return code_.operations.data(); }
    [[nodiscard]] SweepReach reach() const { return reach_; }
    /// Draw 0 of a module, which chooses its production.
    [[nodiscard]] SweepOperand choice_draw() const { return choice_draw_; }
    /// The blocks of draws that a module needs; see SweepCode.
    [[nodiscard]] const std::vector<std::uint32_t>& draw_blocks() const {
        return code_.draw_blocks;
    }
    /// Makes `machine` ready to run the operations.
    void prepare(SweepMachine& machine) const;
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    void add_candidate(const Bytecode& bytecode, const BytecodeProduction& production, Row& row);
    /// Sets the outcomes of candidate `first`; `end`: the end of the candidates of its symbol.
    void add_outcomes(std::uint32_t first, std::uint32_t end);
    /// Adds the elements of the context, and tells `compiler` where their formals are.
    [[nodiscard]] TableRange add_context(const Bytecode& bytecode,
                                         const BytecodeProduction& production,
                                         SweepCompiler& compiler);

    Stage stage_;
    std::vector<Row> rows_;
    std::vector<SweepCandidate> candidates_;
    std::vector<SweepItem> items_;
    std::vector<SweepOutcome> outcomes_;
    SweepCode code_;
    SweepReach reach_;
    SweepOperand choice_draw_;
    std::uint32_t base_count_ = kFirstContextBase;
};

} // namespace lsys
