// SPDX-License-Identifier: MIT
// The state of a Derivation and the stages of a generation. Each stage reads the word `current` and
// writes another one, which then is `current`; `word` changes only when a generation is complete,
// so that after a Stop it still has the age `age`.
//
//     derivation_start.cpp    globals, plans, axiom, saved word
//     derivation_rewrite.cpp  passes, cut, rewriting, a whole generation
//     derivation_stages.cpp   decomposition, interpretation
//     derivation_senses.cpp   sensing and sweeps, which change the parameters of a complete word
#pragma once

#include "runtime/base/out_of_memory.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/engine/pass.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/prune.h"
#include "runtime/derive/engine/stage_depth.h"
#include "runtime/derive/engine/sweep.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

struct Derivation::State {
    State(const Bytecode& program, DeriveOptions chosen);

    const Bytecode& bytecode;
    DeriveOptions options;
    std::vector<float> globals;
    std::optional<Plan> plan;
    std::optional<Passes> passes;
    std::optional<Plan> decompose_plan; // if the program has productions of #decompose
    std::optional<Passes> decompose_passes;
    std::optional<Sweep> down; // if the program has productions of #down
    std::optional<Sweep> up;
    std::vector<bool> is_sense; // by code; empty if the program has no sense module
    Word word;                  // the last complete word, of age `age`
    Word next;                  // written by the current pass
    Word spare;                 // the third word, for generations of several passes
    Pruner pruner;
    StageDepth depth;        // passes of decomposition
    std::uint32_t rules = 0; // number of rules of rewriting
    std::uint32_t age = 0;
    DerivationEnd end;

    [[nodiscard]] std::optional<Stop> fail(RuntimeError error) {
        end.error = std::move(error);
        return Stop::Diagnosed;
    }
    /// Sets the values of the limit report for a next word that does not fit: its number of
    /// modules, and the bytes that all words would take.
    void report_limit(LimitKind kind, std::uint64_t modules, std::uint64_t bytes) {
        end.limit = {kind, age, word.module_count(), modules, bytes};
    }
    [[nodiscard]] PlanInputs plan_inputs() const {
        return {globals.data(), options.seed, static_cast<float>(options.generations)};
    }

    // --- the start

    /// Draws the globals and makes the plans, which depend on them.
    [[nodiscard]] std::optional<Stop> make_plans();
    /// Makes all words keep origins, or none, as DeriveOptions::origins says. Returns false if
    /// there is no memory.
    [[nodiscard]] bool apply_origin_option();
    /// Starts from the word of a saved derivation instead of the axiom.
    [[nodiscard]] std::optional<Stop> adopt_saved_word(Word saved, std::uint32_t saved_age);
    /// Restores the environments of a saved derivation.
    [[nodiscard]] std::optional<Stop> adopt_sense_state(std::string_view saved);
    [[nodiscard]] std::optional<Stop> make_axiom();
    /// Makes the axiom's word complete.
    [[nodiscard]] std::optional<Stop> complete_axiom();

    // --- passes

    /// The word that the next pass over `current` writes; make_current() then makes it `current`.
    [[nodiscard]] Word& target_of_pass(const Word* current) {
        return current == &next ? spare : next;
    }
    void make_current(const Word& written, const Word*& current) {
        if (&written == &spare) {
            std::swap(next, spare);
        }
        current = &next;
    }
    /// Calls DeriveOptions::on_pass, if set, before a pass over `current`.
    void announce(DerivationPass& facts, const Word* current);
    /// Calls DeriveOptions::on_pass, if set, after a pass that wrote `written`.
    void report(DerivationPass& facts, const Word* written) const;
    /// Runs one pass over `current`.
    [[nodiscard]] std::optional<Stop>
    pass(Passes& runner, const PassKeys& keys, DerivationPass facts, const Word*& current);

    // --- stages of a generation

    /// Removes the modules that `%` modules cut, before any module is rewritten.
    [[nodiscard]] std::optional<Stop> prune(const Word*& current);
    [[nodiscard]] std::optional<Stop> rewrite_by_mode(const Word*& current);
    /// Rewrites by one rule; kNone: by all rules.
    [[nodiscard]] std::optional<Stop>
    rewrite(std::uint64_t first_draw, std::uint32_t rule, const Word*& current);
    /// Runs a pass of each rule in turn.
    [[nodiscard]] std::optional<Stop> rewrite_sequentially(const Word*& current);
    /// Runs passes of #decompose over a word of age `word_age` until nothing matches, or up to the
    /// max number of passes.
    [[nodiscard]] std::optional<Stop> decompose(std::uint32_t word_age, const Word*& current);
    /// Senses and sweeps the word `current` of age `word_age`.
    [[nodiscard]] std::optional<Stop> sense_and_sweep(std::uint32_t word_age, const Word*& current);
    [[nodiscard]] std::optional<Stop> sense(std::uint32_t word_age, const Word*& current);
    [[nodiscard]] std::optional<Stop>
    sweep(Sweep& runner, std::uint32_t word_age, const Word*& current);
    /// Makes `changed` a word with the contents of `current` whose parameters a stage may change:
    /// `current` itself, or a copy if `current` is the last complete word or DeriveOptions::on_pass
    /// gets both words.
    [[nodiscard]] std::optional<Stop> make_changeable(const Word* current, Word*& changed);
    /// Bytes of all plans.
    [[nodiscard]] std::uint64_t plan_bytes() const;
    /// A whole generation.
    [[nodiscard]] std::optional<Stop> step();
    /// Runs the passes of #interpret over the word.
    [[nodiscard]] std::optional<Stop> interpret();
    [[nodiscard]] std::optional<Stop> check_brackets();

    [[nodiscard]] bool is_cancelled() const {
        return options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed);
    }
    /// Runs `work` for a public function; catches missing memory, and stores the result in `end`.
    template <typename Work>
    [[nodiscard]] std::optional<Stop> run(const Work& work) {
        end.stop = catch_out_of_memory(work, [this]() -> std::optional<Stop> {
            if (passes) {
                passes->discard_census();
            }
            report_limit(LimitKind::Memory, word.module_count(), word.held_bytes());
            end.limit.exact = false;
            return Stop::OutOfMemory;
        });
        return end.stop;
    }
};

} // namespace lsys
