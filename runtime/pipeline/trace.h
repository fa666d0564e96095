// SPDX-License-Identifier: MIT
// Trace: explains how modules of one generation were rewritten, and from which modules they derive.
// Derives a word, then traces the next step with the StepTracer of runtime/derive, whose result is
// compared with the word that the engine writes.
#pragma once

#include "grammar/base/counted_enum.h"
#include "grammar/base/outcome.h"
#include "runtime/derive/origin.h"
#include "runtime/derive/trace.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

LSYS_COUNTED_ENUM(TraceScope,
                  Next,    // the step that rewrites the module, and the drawing of the last word
                  Written, // the step that wrote the module, and the drawing of the last word
                  Back);   // all steps back to the axiom

/// The modules to trace, and how to trace them.
struct TraceOptions {
    std::string file;                        // path of the grammar, base of files of `#sense`
    std::optional<std::uint32_t> generation; // generation of the modules; unset: the value of #n
    /// Number of generations of the whole derivation, which steps() returns. Unset: #n, or
    /// `generation` if that is more.
    std::optional<std::uint32_t> generations;
    std::optional<std::uint64_t> seed; // unset: the value of #set seed
    // Exactly one of `position`, `module` and `name` is set.
    std::optional<std::uint64_t> position; // index of the module in the word, from 0
    std::string module;                    // `A(3)`: the first such module
    std::string name;                      // all modules of this name
    std::uint64_t rows = 10;               // max number of modules of `name` to trace
    TraceScope scope = TraceScope::Next;
    bool is_drawn = false; // trace its drawing (`#interpret`) too; always done for the last word
};

/// The production that wrote a module, its place in the grammar, and the generation.
struct TraceOrigin {
    ProductionId production = kNoProduction; // kNoProduction: the axiom
    std::optional<Site> place;               // place of the module in the grammar
    std::uint32_t generation = 0;            // age of the first word with the module
};

/// One step on the way back from a module to the axiom: the step from the word of generation
/// `generation` to the next word.
struct AncestorStep {
    std::uint32_t generation = 0;
    std::uint64_t position = 0;      // index of the ancestor in the word
    TracedModule module;             // the ancestor
    std::uint64_t next_position = 0; // index of the followed module in the next word
    /// Index of the followed module in the successor written by the last of `steps`.
    std::uint64_t offset = 0;
    /// The rewritings that lead from the ancestor to the followed module, in order. Empty if every
    /// pass copied the module.
    std::vector<ModuleTrace> steps;
    bool agrees = true; // like Trace::agrees, for this step
};

/// A traced module, and the steps after or before it, as TraceScope selects.
struct TracedPlace {
    std::uint64_t position = 0; // index of the module in the word
    TracedModule module;
    TraceOrigin origin;
    /// Scope Next: traces of the next step: how it rewrites `module`, and how its later passes
    /// rewrite the modules that replaced `module`. ModuleTrace::parent is an index in this list.
    std::vector<ModuleTrace> step;
    /// The modules of the next word that replace the module.
    std::vector<TracedModule> next;
    std::uint64_t first_next = 0;     // position of next[0] in the next word
    std::vector<ModuleTrace> drawing; // traces of #interpret, in the form of `step`
    std::vector<TracedModule> drawn;  // drawn in place of `module`; empty without `drawing`
    /// Scopes Written and Back: the steps from the previous word back to the step that wrote the
    /// module, or to the axiom. Empty for the axiom itself.
    std::vector<AncestorStep> back;
};

struct Trace {
    std::uint32_t generation = 0;  // generation of the traced modules
    std::uint32_t generations = 0; // number of generations of the derivation, which steps() returns
    std::uint64_t seed = 0;
    TraceScope scope = TraceScope::Next;
    std::uint64_t modules = 0;       // number of modules in the word
    std::uint64_t matches = 0;       // number of modules that the options select
    std::uint64_t next_untraced = 0; // position of the first match that is not traced; 0: none
    std::optional<AxiomTrace> axiom; // set if there are several axioms
    bool is_last = false; // whether the word belongs to the last generation, which is drawn
    bool agrees = true;   // whether tracer and engine wrote the same modules
    /// Set if the next step failed. The traces are then incomplete, and messages give the reason.
    std::optional<Stop> stop;
    std::vector<TracedPlace> places;
};

/// Derives generation `options.generation` and traces its modules. If the traced step or the
/// drawing fails, sets Trace::stop. Stop::Failed: the word has no such module.
[[nodiscard]] Outcome<Trace>
trace_modules(const TraceOptions& options, const Grammar& grammar, const Project& project);

/// By production: names of formals and local values, for texts. Empty for a .lsb file.
[[nodiscard]] std::vector<ProductionNames> production_names(const Grammar& grammar);

} // namespace lsys
