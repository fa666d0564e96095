// Trace: why modules of one generation became what they became, and which modules they came from.
// Derives a word, then traces the step after it by the StepTracer of runtime/derive, which is
// compared with the word that the engine writes.
#pragma once

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

/// Which modules to trace, and how.
struct TraceOptions {
    std::optional<std::uint32_t> generation; // of the modules; none: that of #n
    /// Of the whole derivation, steps(). None: #n, or `generation` if it is more.
    std::optional<std::uint32_t> generations;
    std::optional<std::uint64_t> seed; // none: that of #set seed
    // One of the next three is set.
    std::optional<std::uint64_t> position;
    std::string module;      // `A(3)`: the first such module
    std::string name;        // all modules of this name
    std::uint64_t rows = 10; // max modules of `name`
    bool back = false;       // follow the modules back to the axiom instead
};

/// A module, and who wrote it.
struct TraceOrigin {
    ProductionId production = kNoProduction; // kNoProduction: the axiom
    std::optional<Site> place;               // of the module in the grammar
    std::uint32_t generation = 0;            // of the first word with it
};

/// A step of a module's way back to the axiom, from the word of age `generation` to the next.
struct TraceBack {
    std::uint32_t generation = 0;
    std::uint64_t position = 0; // of the module that became the next one
    TracedModule module;
    std::uint64_t next_position = 0; // of the module that it wrote, or its own in the next word
    std::uint64_t offset = 0;        // of that module in what the last of `steps` wrote
    /// The traces that lead to the next module, in order; the last wrote it. Empty: a copy in every
    /// pass.
    std::vector<ModuleTrace> steps;
    bool agrees = true;
};

struct TracedPlace {
    std::uint64_t position = 0;
    TracedModule module;
    TraceOrigin origin;
    /// Of the generation after: of the module itself and of what later passes made of what it
    /// wrote. ModuleTrace::parent counts in this list.
    std::vector<ModuleTrace> step;
    /// The modules of the next word that it became.
    std::vector<TracedModule> next;
    std::uint64_t first_next = 0;     // position of the first one
    std::vector<ModuleTrace> drawing; // passes of #interpret, as step
    std::vector<TracedModule> drawn;  // if `drawing` has traces
    std::vector<TraceBack> back;      // from the word before to the axiom
};

struct Trace {
    std::uint32_t generation = 0;  // of the modules
    std::uint32_t generations = 0; // of the derivation: steps()
    std::uint64_t seed = 0;
    std::uint64_t modules = 0;   // of the word
    std::uint64_t matches = 0;   // modules that the options ask for
    std::uint64_t next_like = 0; // position of the next module like that of `module`; 0: none
    bool is_last = false;        // the word is the last one, which is drawn
    bool agrees = true;          // every successor is the engine's
    /// The traces of an incomplete step, whose messages say why the engine has no next word.
    std::optional<Stop> stop;
    std::vector<TracedPlace> places;
};

/// Derives generation `options.generation` and traces its modules. Where the step after it fails,
/// the Trace has what is known, Trace::stop, and the message of the error. Stop::Failed: the word
/// has no such module.
[[nodiscard]] Outcome<Trace>
trace_modules(const TraceOptions& options, const Grammar& grammar, const Project& project);

/// Names of formals and local values for texts; empty for a .lsb file.
[[nodiscard]] std::vector<ProductionNames> production_names(const Grammar& grammar);

} // namespace lsys
