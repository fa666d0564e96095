// SPDX-License-Identifier: MIT
// A sweep: productions of `#down` or `#up` change the parameters of a complete word in place, in
// one pass over the word (docs/language.md section 13; fast information transfer: Karwowski and
// Prusinkiewicz 2003). `#down` visits the modules from right to left, so that the right context of
// a module has the parameters that this sweep gave it; `#up` visits from left to right and reads
// left contexts. SweepProgram has the productions, SweepNeighbours the contexts. A sweep runs on
// one thread, because each module may depend on the one visited before.
#pragma once

#include "runtime/base/limits.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/contexts.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/sweep_program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// Productions of Stage::Down or Stage::Up, ready to sweep words.
class Sweep {
public:
    /// `bytecode` and the globals of `inputs` outlive the sweep.
    Sweep(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage);

    /// Whether the sweep may change a word of age `age`.
    [[nodiscard]] bool may_change(const Word& word, std::uint32_t age);
    /// Sweeps `word`, of age `age`. After a Stop the parameters of the word are unspecified, and
    /// error() or limit() has the facts; the error is that of the first module visited that has
    /// one. `other_bytes` counts towards the limit on memory besides the word and the tables.
    [[nodiscard]] std::optional<Stop>
    run(Word& word, std::uint32_t age, const DeriveOptions& options, std::uint64_t other_bytes);

    [[nodiscard]] Stage stage() const { return stage_; }
    [[nodiscard]] std::uint64_t first_draw() const { return first_sweep_draw(stage_); }
    [[nodiscard]] const RuntimeError& error() const { return error_; }
    [[nodiscard]] const LimitReport& limit() const { return limit_; }
    [[nodiscard]] std::uint64_t held_bytes() const;

private:
    /// Prepares contexts_ for find_fault(), unless the memory would exceed the limit; sets limit_.
    [[nodiscard]] std::optional<Stop>
    make_tables(const Word& word, const Limits& limits, std::uint64_t other_bytes);
    /// run() for codes of type C.
    template <typename C>
    [[nodiscard]] std::optional<Stop> run_typed(const Word& word,
                                                const WordView<C>& view,
                                                float* parameters,
                                                const DeriveOptions& options,
                                                std::uint64_t other_bytes);
    /// Sets error() to the fault of the module at `place`.
    template <typename C>
    [[nodiscard]] std::optional<Stop> report_fault(const Word& word,
                                                   const WordView<C>& view,
                                                   const ModulePlace& place,
                                                   const Limits& limits,
                                                   std::uint64_t other_bytes);

    Stage stage_;
    Plan plan_;
    SweepProgram program_;
    ContextTables contexts_;
    PassKeys keys_;
    RuntimeError error_;
    LimitReport limit_;
};

} // namespace lsys
