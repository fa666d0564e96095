// SPDX-License-Identifier: MIT
// Trace: explains how one step of a derivation rewrote some modules. A direct evaluator follows
// docs/language.md sections 5 and 6 sentence by sentence, without the tables of engine/, and
// compares each successor with the successor that the engine wrote.
//
//     Derivation ─ DeriveOptions::on_pass ─→ StepTracer ─→ ModuleTrace ...
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/counted_enum.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

inline constexpr std::size_t kNoTrace = ~std::size_t{0};

/// A module with the values of its parameters.
struct TracedModule {
    SymbolId symbol = kNoSymbol;
    std::vector<float> values;
};
/// Whether the symbols are equal and the values have the same bits.
[[nodiscard]] bool same_module(const TracedModule& first, const TracedModule& second);

/// A module as printed in words: `A(3, 0.5)`.
[[nodiscard]] std::string module_text(const Bytecode& bytecode, const TracedModule& module);
[[nodiscard]] std::string
module_text(const Bytecode& bytecode, std::string_view name, const std::vector<float>& values);

/// A module that a context search visited.
struct VisitedModule {
    std::uint64_t position = 0; // position in the word that the pass reads
    std::uint32_t item = 0;     // pattern item that the module was compared with
    TracedModule module;
};

LSYS_COUNTED_ENUM(ContextEnd,
                  Fits,
                  OtherModule, // the last module visited is not the one of the pattern
                  EndOfPath,   // there is no further module
                  NoBranch,    // there is no branch where the pattern has `[`
                  NotSearched);

/// The search for a context: visited modules in the order of the search, from the traced module
/// outwards.
struct ContextTrace {
    ContextEnd end = ContextEnd::NotSearched;
    std::vector<VisitedModule> visited;
    std::uint32_t item = 0;     // pattern item where the search ended without fitting
    std::uint64_t ignored = 0;  // modules skipped because of #ignore or #consider
    std::uint64_t branches = 0; // branches skipped
};

/// An operation of an expression with its value.
struct TracedPart {
    std::string text;   // "x * 2 > y"
    std::string values; // "3 > 2.5"
    float value = 0.0F;
    bool is_truth = false; // a comparison or a logical operation
};

/// A random range or a distribution, and its draw.
struct TracedRange {
    std::string text; // "{0.8, 1.2}", "normal(2, 0.3)"
    Opcode opcode = Opcode::Range;
    std::uint64_t number = 0;     // number of the draw
    std::vector<float> arguments; // minimum and maximum, or the distribution's arguments
    float unit = 0.0F;            // u of docs/language.md section 6
    float value = 0.0F;
};

/// A local value.
struct TracedLocal {
    std::string name;
    std::string text; // the expression of the local value; for `if`, the chosen side
    float value = 0.0F;
    std::vector<std::string> choices; // conditions of `if` in it: "x > 2 is true"
};

/// An expression that was evaluated. Long texts end with "...".
struct ExpressionTrace {
    std::string text;
    std::vector<TracedPart> parts; // operands before operations
    float value = 0.0F;
    bool is_finite = true;
};

LSYS_COUNTED_ENUM(Verdict,
                  Applies,
                  OtherCount,  // the predecessor has another number of parameters
                  OtherRule,   // rewriting cyclic: the rule of another generation
                  Predecessor, // a module after the first differs from the predecessor
                  LeftContext,
                  RightContext,
                  Condition, // the condition is 0
                  Fault,     // condition, weight or sum of weights not finite, or weight negative
                  NoWeight,  // the computed weight is 0
                  NotDrawn,  // it matches, but another production was drawn
                  NotTried); // an earlier production was taken

/// A production whose predecessor has the name of the traced module, and the reason why the
/// production applies or does not.
struct Attempt {
    ProductionId production = kNoProduction;
    Verdict verdict = Verdict::NotTried;
    std::vector<VisitedModule>
        predecessor; // modules compared with the predecessor after the first one
    ContextTrace left;
    ContextTrace right;
    std::optional<ExpressionTrace> condition; // if it was evaluated
    std::optional<ExpressionTrace> weight;    // if it is an expression that was evaluated
};

/// The choice among productions with probabilities.
struct ChoiceTrace {
    struct Alternative {
        ProductionId production = kNoProduction;
        float weight = 0.0F;
        float cumulative = 0.0F; // sum of the normalised weights up to this alternative
    };
    std::vector<Alternative> alternatives; // in file order; more than one
    bool by_generation = false;            // `choice generation`: one draw for all modules
    bool by_glibc = false;                 // `random glibc`
    std::uint64_t number = 0;              // number of the draw
    std::uint64_t position = 0;            // position that keys the draw
    std::uint32_t rule = 0;                // rule of the alternatives
    float unit = 0.0F;                     // u of docs/language.md section 6
    std::size_t taken = 0;                 // index in alternatives
};

/// The choice among several axioms (docs/language.md section 5.9).
struct AxiomTrace {
    struct Alternative {
        std::uint32_t site = kNone; // index in Bytecode::sites
        float weight = 0.0F;
        float cumulative = 0.0F; // sum of the normalised weights up to this alternative
    };
    std::vector<Alternative> alternatives; // in file order
    float unit = 0.0F;                     // u of docs/language.md section 6
    std::size_t taken = 0;                 // index in alternatives
};
/// Explains the choice of the axiom; nothing if there is only one.
[[nodiscard]] std::optional<AxiomTrace> trace_axiom(const Bytecode& bytecode, std::uint64_t seed);

LSYS_COUNTED_ENUM(Fate,
                  Copied,    // no production matches
                  Rewritten, // by a production
                  Cut,       // removed with the rest of its branch
                  Consumed,  // by a match that begins before it
                  Sensed,    // the module, a sense module, got an answer
                  Failed);   // a value is not finite, or a range cannot be drawn from

/// A module in one pass.
struct ModuleTrace {
    DerivationPass::Kind kind = DerivationPass::Kind::Rewrite;
    std::uint32_t rule = kNone; // the only rule of the pass
    std::uint32_t pass = 0;     // DerivationPass::number
    std::uint32_t generation = 0;
    bool was_run = true; // false: the engine skipped the pass, which could change no module

    std::size_t root = 0;          // index of the start module in StepTracer::begin()
    std::size_t parent = kNoTrace; // the trace that wrote the module, in StepTracer::traces()
    std::uint64_t offset = 0;      // index in ModuleTrace::written of the parent
    std::uint64_t position = 0;    // position in the word that the pass reads
    TracedModule module;

    std::vector<Attempt> attempts; // in file order
    std::uint64_t other_names = 0; // productions of the pass for modules of other names
    std::optional<ChoiceTrace> choice;
    Fate fate = Fate::Copied;
    ProductionId production = kNoProduction; // if rewritten or consumed
    /// Position of the cut, or of the match that consumed the module.
    std::uint64_t cause = 0;
    std::uint32_t replaced = 1; // modules that the match replaced

    std::vector<TracedLocal> locals;
    std::vector<TracedRange> ranges;
    std::string fault;                 // error in the successor; empty: none
    std::vector<TracedModule> written; // the module itself if it was copied
    std::uint64_t first_written = 0;   // position in the word written
    bool is_checked = false;           // compared with the successor that the engine wrote
    bool agrees = false;               // the engine wrote an equal successor
};

/// Names of a production's formals and local values, for texts.
struct ProductionNames {
    struct Local {
        std::string name;
        /// Opcode of a value that is a single leaf, such as a literal; the leaf is copied to each
        /// use. End: code computes the value.
        Opcode leaf = Opcode::End;
        float literal = 0.0F;    // value of a Literal
        std::uint32_t index = 0; // index of a Formal, Global or Local
    };
    std::vector<std::string> formals;
    std::vector<Local> locals; // by slot
};

/// Values that are constant during a derivation.
struct TraceInputs {
    std::uint64_t seed = 0;
    float steps = 0.0F; // number of generations of the derivation
    std::vector<float> globals;
    std::vector<ProductionNames> names; // by production; none: formals are $0, $1, ...
};

/// The modules at `positions`. Time is linear in the length of the word. Precondition: positions
/// ascend and are less than the number of modules.
[[nodiscard]] std::vector<TracedModule>
modules_at(const Bytecode& bytecode, const Word& word, const std::vector<std::uint64_t>& positions);

/// Traces modules through the passes of one step, or of Derivation::interpret(). The derivation's
/// DeriveOptions::on_pass calls on_pass().
class StepTracer {
public:
    /// `bytecode` must outlive the tracer.
    StepTracer(const Bytecode& bytecode, TraceInputs inputs);
    ~StepTracer();
    StepTracer(StepTracer&&) noexcept;
    StepTracer& operator=(StepTracer&&) noexcept;

    /// Starts with the modules at `positions`, ascending, of the word of age `age`, which is about
    /// to be rewritten or, with Kind::Interpret, drawn.
    void begin(const std::vector<std::uint64_t>& positions,
               const Word& word,
               std::uint32_t age,
               DerivationPass::Kind kind);
    void on_pass(const DerivationPass& pass);
    /// Ends the step. Adds a trace of each start module whose pass the engine skipped because it
    /// changes nothing.
    void finish();

    /// All traces, each after its parent: of the modules given to begin(), in each pass, and of
    /// modules written for these modules, if productions of later passes may apply to them.
    [[nodiscard]] const std::vector<ModuleTrace>& traces() const;
    /// A module of the last word of the step.
    struct Place {
        std::uint64_t position = 0;
        std::size_t root = 0;          // index of the start module in begin()
        std::size_t parent = kNoTrace; // the trace that wrote it
        std::uint64_t offset = 0;      // index in ModuleTrace::written of the parent
    };
    /// The modules that the last pass has written for the modules of begin().
    [[nodiscard]] const std::vector<Place>& places() const;
    /// Whether every successor equals that of the engine.
    [[nodiscard]] bool agrees() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
