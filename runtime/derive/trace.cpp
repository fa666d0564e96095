// SPDX-License-Identifier: MIT
#include "runtime/derive/trace.h"

#include "grammar/base/contract.h"
#include "runtime/base/random.h"
#include "runtime/derive/impl/explain_module.h"
#include "runtime/derive/impl/traced_word.h"
#include "runtime/derive/word_text.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace lsys {

namespace {

/// Whether the engine has written `expected` at `position` of `word`.
bool equals(const TracedWord& word, std::uint64_t position, const TracedModule& expected) {
    return same_module(word.module(position), expected);
}

} // namespace

bool same_module(const TracedModule& first, const TracedModule& second) {
    return first.symbol == second.symbol &&
           std::equal(first.values.begin(), first.values.end(), second.values.begin(),
                      second.values.end(), [](float x, float y) {
                          return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
                      });
}

std::string module_text(const Bytecode& bytecode, const TracedModule& module) {
    return module_text(bytecode, bytecode.symbol(module.symbol).name, module.values);
}

std::string
module_text(const Bytecode& bytecode, std::string_view name, const std::vector<float>& values) {
    std::string text = spelled_name(name, bytecode.settings.print_letters);
    for (std::size_t i = 0; i < values.size(); ++i) {
        text += i == 0 ? "(" : ", ";
        append_number(values[i], text);
    }
    text += values.empty() ? "" : ")";
    return text;
}

std::vector<TracedModule> modules_at(const Bytecode& bytecode,
                                     const Word& word,
                                     const std::vector<std::uint64_t>& positions) {
    const TracedWord traced(bytecode, word);
    std::vector<TracedModule> modules;
    for (const std::uint64_t position : positions) {
        modules.push_back(traced.module(position));
    }
    return modules;
}

std::optional<AxiomTrace> trace_axiom(const Bytecode& bytecode, std::uint64_t seed) {
    if (bytecode.axioms.size() == 1) {
        return std::nullopt;
    }
    constexpr std::uint32_t kGeneration = 0xFFFFFFFF; // docs/language.md section 6.2
    constexpr std::uint64_t kPosition = ~std::uint64_t{0};
    AxiomTrace trace;
    trace.unit = DrawSource(seed, kGeneration, kPosition).draw(0);
    float sum = 0.0F;
    for (const BytecodeAxiom& axiom : bytecode.axioms) {
        sum += axiom.weight;
    }
    float cumulative = 0.0F;
    std::optional<std::size_t> taken;
    for (const BytecodeAxiom& axiom : bytecode.axioms) {
        cumulative += axiom.weight / sum;
        if (!taken && cumulative > trace.unit) {
            taken = trace.alternatives.size();
        }
        trace.alternatives.push_back({axiom.site, axiom.weight, cumulative});
    }
    trace.taken = taken.value_or(trace.alternatives.size() - 1);
    return trace;
}

struct StepTracer::State {
    State(const Bytecode& program, TraceInputs given)
        : bytecode(program), inputs(std::move(given)) {}

    const Bytecode& bytecode;
    TraceInputs inputs;
    std::vector<ModuleTrace> traces;
    std::vector<Place> places; // tracked modules of the current word, ascending
    std::vector<ModuleTrace>
        traces_without_pass;                     // traces of the roots, if the engine makes no pass
    std::vector<std::uint32_t> pass_productions; // productions of the current pass
    std::size_t first_of_pass = 0;               // index in traces
    /// By place: the index of its trace in the current pass; kNoTrace: the module was copied and
    /// has no trace.
    std::vector<std::size_t> trace_of_place;
    bool ok = true; // every successor compared so far equals that of the engine

    /// Whether the predecessor of a production of the pass begins with `symbol`.
    [[nodiscard]] bool may_rewrite(SymbolId symbol) const {
        return std::any_of(
            pass_productions.begin(), pass_productions.end(), [&](std::uint32_t index) {
                const TableRange predecessor = bytecode.productions[index].predecessor;
                return bytecode.patterns[predecessor.first].symbol == symbol;
            });
    }

    std::size_t add(ModuleTrace trace, const Place& place) {
        trace.root = place.root;
        trace.parent = place.parent;
        trace.offset = place.offset;
        traces.push_back(std::move(trace));
        return traces.size() - 1;
    }

    void begin_cuts(const TracedWord& word, const DerivationPass& facts) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::optional<std::uint64_t> cut = word.cut_of(places[i].position);
            if (!cut) {
                continue;
            }
            ModuleTrace trace;
            trace.kind = facts.kind;
            trace.generation = facts.generation;
            trace.position = places[i].position;
            trace.module = word.module(places[i].position);
            trace.fate = Fate::Cut;
            trace.cause = *cut;
            trace_of_place[i] = add(std::move(trace), places[i]);
        }
    }

    /// Whether the tracked module at `position` gets a trace: always in a rewriting pass, except in
    /// sequential mode; else if a production of the pass may apply to it.
    [[nodiscard]] bool is_explained(const TracedPass& pass, std::uint64_t position) const {
        return (pass.facts.kind == DerivationPass::Kind::Rewrite &&
                bytecode.settings.rewriting != RewritingMode::Sequential) ||
               may_rewrite(pass.word.symbol(position));
    }

    void begin_productions(const TracedPass& pass) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Place& place = places[i];
            if (is_visited(pass.facts, place.position) && is_explained(pass, place.position)) {
                trace_of_place[i] =
                    add(explain_module(pass, pass_productions, place.position), place);
            }
        }
    }

    /// Begins a pass that has predecessors of several modules: a match may begin before a tracked
    /// module and consume it. Reads the word from its start, as the pass does. The place of a
    /// consumed module becomes the place of the match.
    void begin_matches(const TracedPass& pass) {
        const std::vector<Place> tracked = std::exchange(places, {});
        trace_of_place.clear();
        const auto keep = [this](const Place& place, std::size_t trace) {
            places.push_back(place);
            trace_of_place.push_back(trace);
        };
        std::size_t next = 0;
        for (std::uint64_t i = 0; next < tracked.size();) {
            const bool is_tracked = tracked[next].position == i;
            std::optional<ModuleTrace> match;
            if (may_rewrite(pass.word.symbol(i)) || (is_tracked && is_explained(pass, i))) {
                match = explain_module(pass, pass_productions, i);
            }
            if (is_tracked) {
                keep(tracked[next], match ? add(*match, tracked[next]) : kNoTrace);
                ++next;
            }
            const std::uint64_t end =
                i + (match && match->fate == Fate::Rewritten ? match->replaced : 1);
            bool is_kept = is_tracked;
            for (; next < tracked.size() && tracked[next].position < end; ++next) {
                Place place = tracked[next];
                place.parent = add(consumed(pass, place.position, *match), place);
                place.position = i;
                if (!std::exchange(is_kept, true)) {
                    keep(place, add(*match, place));
                }
            }
            i = end;
        }
    }

    /// The trace of a module that `match` consumes.
    [[nodiscard]] static ModuleTrace
    consumed(const TracedPass& pass, std::uint64_t position, const ModuleTrace& match) {
        ModuleTrace trace;
        trace.kind = match.kind;
        trace.rule = match.rule;
        trace.pass = match.pass;
        trace.generation = match.generation;
        trace.position = position;
        trace.module = pass.word.module(position);
        trace.fate = Fate::Consumed;
        trace.cause = match.position;
        trace.production = match.production;
        return trace;
    }

    /// Explains the tracked sense modules: their parameters before and after sensing.
    void explain_answers(const DerivationPass& facts) {
        const TracedWord before(bytecode, *facts.in);
        const TracedWord after(bytecode, *facts.out);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::uint64_t position = places[i].position;
            if (!bytecode.symbol(before.symbol(position)).senses()) {
                continue;
            }
            ModuleTrace trace;
            trace.kind = facts.kind;
            trace.generation = facts.generation;
            trace.position = position;
            trace.module = before.module(position);
            trace.fate = Fate::Sensed;
            trace.written = {after.module(position)};
            trace_of_place[i] = add(std::move(trace), places[i]);
        }
    }

    /// Explains a sweep, whose contexts are modules with the parameters that the sweep has written.
    void explain_sweep(const DerivationPass& facts) {
        const TracedWord before(bytecode, *facts.in);
        const TracedWord after(bytecode, *facts.out);
        pass_productions = productions_of_pass(bytecode, facts);
        begin_productions({bytecode, inputs, before, after, facts});
    }
    /// Whether a sweep has visited the module at `position` before it ended.
    [[nodiscard]] static bool is_visited(const DerivationPass& facts, std::uint64_t position) {
        return facts.fault == DerivationPass::kNoFault ||
               (facts.kind == DerivationPass::Kind::Up ? position <= facts.fault
                                                       : position >= facts.fault);
    }

    /// Compares the successors with the written word, and tracks their modules from then on.
    void end(const Word& out) {
        const TracedWord word(bytecode, out);
        const std::span<const Origin> origins = out.origins();
        LSYS_CHECK(origins.size() == out.module_count(), origins.size());
        const auto first_from = [&](std::uint64_t position) {
            return static_cast<std::uint64_t>(std::partition_point(origins.begin(), origins.end(),
                                                                   [&](const Origin& origin) {
                                                                       return origin.place <
                                                                              position;
                                                                   }) -
                                              origins.begin());
        };
        std::vector<Place> written;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::uint64_t begin = first_from(places[i].position);
            const std::uint64_t end = first_from(places[i].position + 1);
            const std::size_t index = trace_of_place[i];
            Place place = places[i];
            if (index != kNoTrace) {
                ModuleTrace& trace = traces[index];
                trace.first_written = begin;
                trace.is_checked = true;
                trace.agrees = trace.written.size() == end - begin && trace.fate != Fate::Failed;
                for (std::uint64_t k = 0; trace.agrees && k < end - begin; ++k) {
                    trace.agrees = equals(word, begin + k, trace.written[k]);
                }
                ok = ok && trace.agrees;
                if (trace.fate == Fate::Rewritten || trace.fate == Fate::Sensed) {
                    place.parent = index;
                    place.offset = 0;
                }
            }
            const bool is_written = place.parent != places[i].parent;
            for (std::uint64_t k = begin; k < end; ++k) {
                place.position = k;
                place.offset = is_written ? k - begin : place.offset;
                written.push_back(place);
            }
        }
        for (std::size_t i = first_of_pass; i < traces.size(); ++i) {
            traces[i].is_checked = true;
            traces[i].agrees = traces[i].agrees || traces[i].fate == Fate::Consumed;
        }
        places = std::move(written);
    }
};

StepTracer::StepTracer(const Bytecode& bytecode, TraceInputs inputs)
    : state_(std::make_unique<State>(bytecode, std::move(inputs))) {}
StepTracer::~StepTracer() = default;
StepTracer::StepTracer(StepTracer&&) noexcept = default;
StepTracer& StepTracer::operator=(StepTracer&&) noexcept = default;

void StepTracer::begin(const std::vector<std::uint64_t>& positions,
                       const Word& word,
                       std::uint32_t age,
                       DerivationPass::Kind kind) {
    State& state = *state_;
    state.traces.clear();
    state.places.clear();
    state.traces_without_pass.clear();
    state.ok = true;
    const Bytecode& bytecode = state.bytecode;
    DerivationPass facts{.kind = kind, .generation = age};
    if (kind == DerivationPass::Kind::Rewrite &&
        bytecode.settings.rewriting == RewritingMode::Cyclic &&
        bytecode.rewriting_rule_count() != 0) {
        facts.rule = age % bytecode.rewriting_rule_count();
    }
    const std::vector<std::uint32_t> productions = productions_of_pass(bytecode, facts);
    const TracedWord traced(bytecode, word);
    const TracedPass pass{bytecode, state.inputs, traced, traced, facts};
    for (const std::uint64_t position : positions) {
        const Place place{position, state.places.size(), kNoTrace, 0};
        state.places.push_back(place);
        ModuleTrace trace = explain_module(pass, productions, position);
        trace.root = place.root;
        trace.was_run = false;
        state.traces_without_pass.push_back(std::move(trace));
    }
}

void StepTracer::on_pass(const DerivationPass& facts) {
    State& state = *state_;
    const bool senses = facts.kind == DerivationPass::Kind::Sense;
    const bool sweeps =
        facts.kind == DerivationPass::Kind::Down || facts.kind == DerivationPass::Kind::Up;
    if (facts.out != nullptr) {
        if (senses) {
            state.explain_answers(facts);
        } else if (sweeps) {
            state.explain_sweep(facts);
        }
        if (facts.fault == DerivationPass::kNoFault) {
            state.end(*facts.out);
        }
        return;
    }
    state.first_of_pass = state.traces.size();
    state.trace_of_place.assign(state.places.size(), kNoTrace);
    if (senses || sweeps) {
        return; // the call after the pass explains them
    }
    const TracedWord word(state.bytecode, *facts.in);
    if (facts.kind == DerivationPass::Kind::Cut) {
        state.begin_cuts(word, facts);
        return;
    }
    state.pass_productions = productions_of_pass(state.bytecode, facts);
    const TracedPass pass{state.bytecode, state.inputs, word, word, facts};
    const bool has_several_modules = std::any_of(
        state.pass_productions.begin(), state.pass_productions.end(), [&](std::uint32_t index) {
            return state.bytecode.productions[index].predecessor.count > 1;
        });
    if (has_several_modules) {
        state.begin_matches(pass);
    } else {
        state.begin_productions(pass);
    }
}

void StepTracer::finish() {
    State& state = *state_;
    std::vector<bool> traced(state.traces_without_pass.size(), false);
    for (const ModuleTrace& trace : state.traces) {
        traced[trace.root] = traced[trace.root] || trace.kind == DerivationPass::Kind::Cut ||
                             trace.kind == state.traces_without_pass[trace.root].kind;
    }
    for (std::size_t root = 0; root < traced.size(); ++root) {
        if (traced[root]) {
            continue;
        }
        ModuleTrace& trace = state.traces_without_pass[root];
        trace.is_checked = true; // the engine found no module that a pass could change
        trace.agrees = trace.fate == Fate::Copied;
        trace.first_written = trace.position;
        for (const Place& place : state.places) {
            if (place.root == root && place.parent == kNoTrace) {
                trace.first_written = place.position; // later passes may have moved it
            }
        }
        state.ok = state.ok && trace.agrees;
        // The trace of a root comes before the traces of its successors.
        for (ModuleTrace& other : state.traces) {
            if (other.parent != kNoTrace) {
                ++other.parent;
            }
        }
        for (Place& place : state.places) {
            if (place.parent != kNoTrace) {
                ++place.parent;
            }
        }
        state.traces.insert(state.traces.begin(), trace);
    }
}

const std::vector<ModuleTrace>& StepTracer::traces() const {
    return state_->traces;
}
const std::vector<StepTracer::Place>& StepTracer::places() const {
    return state_->places;
}
bool StepTracer::agrees() const {
    return state_->ok;
}

} // namespace lsys
