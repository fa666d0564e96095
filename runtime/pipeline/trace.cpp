// SPDX-License-Identifier: MIT
#include "runtime/pipeline/trace.h"

#include "grammar/base/contract.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/word_text.h"
#include "runtime/pipeline/growth_forecast.h"
#include "runtime/pipeline/impl/wanted_module.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace lsys {

namespace {

/// A copy of a word without its origins; nothing if there is not enough memory.
std::optional<Word> copy_of_word(const Word& word) {
    Word copy(word.code_width());
    if (!copy.resize(word.module_count(), word.parameter_count())) {
        return std::nullopt;
    }
    std::copy(word.code_bytes().begin(), word.code_bytes().end(), copy.code_bytes().begin());
    std::copy(word.parameters().begin(), word.parameters().end(), copy.parameters().begin());
    return copy;
}

TraceOrigin origin_in_grammar(const Bytecode& bytecode, const Origin& origin) {
    TraceOrigin found;
    found.generation = origin.generation;
    if (origin.place != kNone) {
        found.production = production_with(bytecode, origin.place);
        found.place = place_of(bytecode, origin.place);
    }
    return found;
}

class Tracing {
public:
    Tracing(const TraceOptions& options, const Grammar& grammar, const Project& project)
        : options_(options), grammar_(grammar), bytecode_(grammar.bytecode), step_(project) {
        PlantOptions plant;
        plant.generations = options.generations;
        plant.seed = options.seed;
        derive_ = derive_options(plant, bytecode_, project);
        trace_.generation = options.generation.value_or(derive_.generations);
        derive_.generations = std::max(derive_.generations, trace_.generation);
        derive_.origins = true;
        trace_.generations = derive_.generations;
        trace_.seed = derive_.seed;
        trace_.scope = options.scope;
        trace_.axiom = trace_axiom(bytecode_, derive_.seed);
        trace_.is_last = trace_.generation == trace_.generations;
    }

    Outcome<Trace> run() {
        if (const std::optional<LimitReport> limit =
                predict_limit(bytecode_, trace_.generation, derive_.limits)) {
            step_.diagnose(
                limit_diagnostic(*limit, derive_.limits, bytecode_, !grammar_.is_module_file),
                grammar_.sources);
            return step_.end(Stop::Limit);
        }
        if (!step_.take(read_senses(options_.file, grammar_, step_.project()), senses_)) {
            return step_.end();
        }
        const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
        Derivation derivation(bytecode_, with_senses(derive_, senses.get()));
        std::optional<Stop> stop = derivation.start();
        keep(derivation);
        while (!stop && derivation.age() < trace_.generation) {
            stop = derivation.step();
            if (!stop) {
                keep(derivation);
            }
        }
        if (stop) {
            return end(derivation, *stop);
        }
        inputs_ = {derive_.seed, static_cast<float>(derive_.generations), derivation.globals(),
                   production_names(grammar_)};
        sense_state_ = derivation.sense_state();
        trace_.modules = derivation.word().module_count();
        if (trace_.modules >= kNone) {
            return step_.fail(fmt::format("generation {} has {} modules, and at most {} can be "
                                          "traced",
                                          trace_.generation, trace_.modules, kNone - 1));
        }
        if (!select(derivation.word())) {
            return step_.end();
        }
        if (options_.scope != TraceScope::Next) {
            for (TracedPlace& place : trace_.places) {
                if (const std::optional<Stop> failed = follow_back(place)) {
                    return step_.end(*failed);
                }
            }
        }
        if (options_.scope != TraceScope::Back) {
            stop = trace_drawing(derivation.word());
        }
        if (!stop && options_.scope == TraceScope::Next) {
            stop = trace_step(derivation);
        }
        if (stop == Stop::Cancelled || stop == Stop::OutOfMemory) {
            return step_.end(*stop);
        }
        trace_.stop = stop;
        return step_.done(std::move(trace_));
    }

private:
    /// Reports why the derivation stopped, and ends the step with `stop`.
    Step::Ended end(const Derivation& derivation, Stop stop) {
        report(derivation, stop);
        return step_.end(stop);
    }
    void report(const Derivation& derivation, Stop stop) {
        if (stop != Stop::Cancelled) {
            step_.diagnose(derivation_diagnostic(derivation.end(), derive_.limits, grammar_),
                           grammar_.sources);
        }
    }

    /// The options of a derivation that uses `senses`.
    static DeriveOptions with_senses(DeriveOptions options, WordSense* senses) {
        options.senses = senses;
        return options;
    }

    // --- stored words: starting points for earlier generations, nearer than the axiom

    struct StoredWord {
        std::uint32_t age = 0;
        Word word;
        std::string sense_state;
    };

    static std::uint64_t bytes_of(const StoredWord& stored) {
        constexpr std::uint64_t kMinBytes = 32 << 10; // two arrays of 16 KiB or more (arena.cpp)
        return std::max(stored.word.held_bytes(), kMinBytes) + stored.sense_state.size() +
               sizeof(StoredWord);
    }

    /// Stores a copy of the word if its age is a multiple of stride_. If the copies take more than
    /// a quarter of the memory limit, doubles stride_ and drops every other copy.
    void keep(const Derivation& derivation) {
        if (options_.scope == TraceScope::Next || derivation.age() % stride_ != 0) {
            return;
        }
        std::optional<Word> copy = copy_of_word(derivation.word());
        if (!copy) {
            return;
        }
        stored_words_.push_back({derivation.age(), std::move(*copy), derivation.sense_state()});
        stored_bytes_ += bytes_of(stored_words_.back());
        while (stored_words_.size() > 1 && stored_bytes_ > derive_.limits.max_bytes / 4) {
            stride_ *= 2;
            stored_words_.erase(
                std::remove_if(stored_words_.begin(), stored_words_.end(),
                               [this](const StoredWord& each) { return each.age % stride_ != 0; }),
                stored_words_.end());
            stored_bytes_ = 0;
            for (const StoredWord& each : stored_words_) {
                stored_bytes_ += bytes_of(each);
            }
        }
    }

    /// Advances a derivation to the word of age `age`, from the nearest stored word of at most this
    /// age.
    [[nodiscard]] std::optional<Stop> go_to(Derivation& derivation, std::uint32_t age) {
        const auto after = std::find_if(stored_words_.begin(), stored_words_.end(),
                                        [age](const StoredWord& each) { return each.age > age; });
        std::optional<Stop> stop;
        if (after == stored_words_.begin()) {
            stop = derivation.start();
        } else {
            const StoredWord& from = *std::prev(after);
            std::optional<Word> copy = copy_of_word(from.word);
            if (!copy) {
                return Stop::OutOfMemory;
            }
            stop = derivation.resume(std::move(*copy), from.age, from.sense_state);
        }
        return stop ? stop : derivation.run_to(age);
    }

    // --- the selected modules

    bool select(const Word& word) {
        std::vector<std::uint64_t> positions;
        if (options_.position) {
            if (*options_.position >= trace_.modules) {
                fail_without_position();
                return false;
            }
            positions = {*options_.position};
            trace_.matches = 1;
        } else if (!select_by_text(word, positions)) {
            return false;
        }
        const std::vector<TracedModule> modules = modules_at(bytecode_, word, positions);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            TracedPlace& place = trace_.places.emplace_back();
            place.position = positions[i];
            place.module = modules[i];
            place.origin = origin_in_grammar(bytecode_, word.origins()[positions[i]]);
        }
        return true;
    }

    void fail_without_position() {
        fail(trace_.modules == 0
                 ? fmt::format("generation {} is empty: it has no module at {}", trace_.generation,
                               *options_.position)
                 : fmt::format("generation {} has no module at {}: its last one is at {}",
                               trace_.generation, *options_.position, trace_.modules - 1),
             fmt::format("positions count from 0; `lsc dump -n {}` prints the word, `lsc trace -n "
                         "{} --all NAME` finds modules",
                         trace_.generation, trace_.generation));
    }
    void fail(std::string message, std::string help) {
        step_.messages.add_error(std::move(message));
        if (!help.empty()) {
            step_.messages.add_help(std::move(help));
        }
    }

    /// Lists the positions of the modules that match `options_.module` or `options_.name`. Returns
    /// false after reporting an error.
    bool select_by_text(const Word& word, std::vector<std::uint64_t>& positions) {
        const bool exact = !options_.module.empty();
        const Result<WantedModule> wanted =
            parse_wanted_module(exact ? options_.module : options_.name, exact);
        if (!wanted) {
            fail(wanted.error().message, "");
            return false;
        }
        const WantedModule& module = wanted.value();
        std::vector<bool> has_name(bytecode_.symbols.size(), false);
        for (std::size_t i = 0; i < bytecode_.symbols.size(); ++i) {
            has_name[i] = bytecode_.symbols[i].name == module.name;
        }
        std::vector<std::uint64_t> others; // positions of modules with the name and other values
        std::uint64_t parameter = 0;
        const std::uint64_t max_rows = exact ? 1 : options_.rows;
        for (std::uint64_t i = 0; i < word.module_count(); ++i) {
            const Code code = word.code(i);
            const auto symbol = static_cast<std::size_t>(bytecode_.symbol_of(code));
            if (has_name[symbol]) {
                const float* const values =
                    code < bytecode_.symbols.size()
                        ? word.parameters().data() + parameter
                        : bytecode_.constants.data() +
                              bytecode_.folded[code - bytecode_.symbols.size()].first_constant;
                const std::size_t count = bytecode_.symbols[symbol].parameter_count;
                if (!exact || std::equal(values, values + count, module.values.begin(),
                                         module.values.end())) {
                    ++trace_.matches;
                    if (positions.size() < max_rows) {
                        positions.push_back(i);
                    } else if (trace_.next_untraced == 0) {
                        trace_.next_untraced = i;
                    }
                } else if (others.size() < 4) {
                    others.push_back(i);
                }
            }
            parameter += bytecode_.stored_parameters(code);
        }
        if (positions.empty()) {
            fail_without_module(word, module, exact, others);
        }
        return !positions.empty();
    }

    void fail_without_module(const Word& word,
                             const WantedModule& module,
                             bool exact,
                             const std::vector<std::uint64_t>& others) {
        const std::string text =
            exact ? module_text(bytecode_, module.name, module.values) : module.name;
        std::string help;
        if (!others.empty()) {
            std::vector<std::string> texts;
            for (const TracedModule& other : modules_at(bytecode_, word, others)) {
                texts.push_back(fmt::format("`{}`", module_text(bytecode_, other)));
            }
            help = fmt::format("the first of this name: {}", fmt::join(texts, ", "));
        } else {
            std::vector<std::string_view> names;
            for (const BytecodeSymbol& symbol : bytecode_.symbols) {
                names.push_back(symbol.name);
            }
            const bool known = std::find(names.begin(), names.end(), module.name) != names.end();
            const std::optional<std::string_view> nearest =
                known ? std::nullopt : nearest_name(module.name, names);
            help = known     ? "the grammar has it, in other generations or not at all"
                   : nearest ? fmt::format("did you mean `{}`?", *nearest)
                             : "the grammar has no module of this name";
        }
        fail(fmt::format("generation {} has no module `{}`", trace_.generation, text),
             std::move(help));
    }

    // --- the steps after and before the word

    [[nodiscard]] std::vector<std::uint64_t> positions() const {
        std::vector<std::uint64_t> positions;
        for (const TracedPlace& place : trace_.places) {
            positions.push_back(place.position);
        }
        return positions;
    }

    /// Calls `take(place, trace)` for each trace with the TracedPlace of its root.
    /// ModuleTrace::parent becomes an index among the traces of that place.
    template <typename Take>
    void distribute(const StepTracer& tracer, const Take& take) {
        std::vector<std::size_t> index_in_place(tracer.traces().size(), kNoTrace);
        std::vector<std::size_t> counts(trace_.places.size(), 0);
        for (std::size_t i = 0; i < tracer.traces().size(); ++i) {
            ModuleTrace trace = tracer.traces()[i];
            trace.parent = trace.parent == kNoTrace ? kNoTrace : index_in_place[trace.parent];
            index_in_place[i] = counts[trace.root]++;
            TracedPlace& place = trace_.places[trace.root];
            take(place, std::move(trace));
        }
    }

    [[nodiscard]] std::optional<Stop> trace_step(Derivation& derivation) {
        StepTracer tracer(bytecode_, inputs_);
        tracer.begin(positions(), derivation.word(), trace_.generation,
                     DerivationPass::Kind::Rewrite);
        const std::optional<Stop> stop =
            traced(derivation, tracer, [](Derivation& stepping) { return stepping.step(); });
        distribute(tracer, [](TracedPlace& place, ModuleTrace trace) {
            place.step.push_back(std::move(trace));
        });
        if (!stop) {
            take_places(tracer, next_, &TracedPlace::next);
            trace_.agrees = trace_.agrees && tracer.agrees();
        }
        return stop;
    }

    /// Traces the passes of #interpret, which are applied only to words that are drawn.
    [[nodiscard]] std::optional<Stop> trace_drawing(const Word& word) {
        if (!(trace_.is_last || options_.is_drawn) || !bytecode_.has(Stage::Interpret)) {
            return std::nullopt;
        }
        const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
        Derivation drawing(bytecode_, with_senses(derive_, senses.get()));
        std::optional<Word> copy = copy_of_word(word);
        if (!copy) {
            return Stop::OutOfMemory;
        }
        if (const std::optional<Stop> stop =
                drawing.resume(std::move(*copy), trace_.generation, sense_state_)) {
            return stop;
        }
        StepTracer tracer(bytecode_, inputs_);
        tracer.begin(positions(), word, trace_.generation, DerivationPass::Kind::Interpret);
        const std::optional<Stop> stop =
            traced(drawing, tracer, [](Derivation& stepping) { return stepping.interpret(); });
        distribute(tracer, [](TracedPlace& place, ModuleTrace trace) {
            place.drawing.push_back(std::move(trace));
        });
        if (!stop) {
            take_places(tracer, next_, &TracedPlace::drawn);
            trace_.agrees = trace_.agrees && tracer.agrees();
        }
        return stop;
    }

    /// Runs `work` on a copy of the derivation `from` while `tracer` observes it. Reports a stop.
    template <typename Work>
    [[nodiscard]] std::optional<Stop>
    traced(const Derivation& from, StepTracer& tracer, const Work& work) {
        DeriveOptions options = derive_;
        options.on_pass = [&](const DerivationPass& pass) { tracer.on_pass(pass); };
        const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
        Derivation stepping(bytecode_, with_senses(options, senses.get()));
        std::optional<Word> copy = copy_of_word(from.word());
        if (!copy) {
            return Stop::OutOfMemory;
        }
        std::optional<Stop> stop = stepping.resume(std::move(*copy), from.age(), sense_state_);
        if (!stop) {
            stop = work(stepping);
        }
        tracer.finish();
        if (stop) {
            report(stepping, *stop);
            return stop;
        }
        std::vector<std::uint64_t> after;
        for (const StepTracer::Place& place : tracer.places()) {
            after.push_back(place.position);
        }
        next_ = modules_at(bytecode_, stepping.word(), after);
        return std::nullopt;
    }

    void take_places(const StepTracer& tracer,
                     std::vector<TracedModule>& modules,
                     std::vector<TracedModule> TracedPlace::*list) {
        for (std::size_t i = 0; i < tracer.places().size(); ++i) {
            const StepTracer::Place& found = tracer.places()[i];
            TracedPlace& place = trace_.places[found.root];
            if ((place.*list).empty() && list == &TracedPlace::next) {
                place.first_next = found.position;
            }
            (place.*list).push_back(std::move(modules[i]));
        }
    }

    /// Follows a module back to the axiom, or to the step that wrote it, generation by generation.
    /// Derivation::follow() of the engine finds the module of the previous word that wrote it; the
    /// step from this module is then traced.
    [[nodiscard]] std::optional<Stop> follow_back(TracedPlace& place) {
        std::uint64_t position = place.position;
        for (std::uint32_t age = trace_.generation; age-- > 0;) {
            const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
            Derivation derivation(bytecode_, with_senses(derive_, senses.get()));
            std::optional<Stop> stop = go_to(derivation, age);
            std::optional<Word> before;
            if (!stop && !(before = copy_of_word(derivation.word()))) {
                stop = Stop::OutOfMemory;
            }
            const std::string sense_state = derivation.sense_state();
            if (!stop && !derivation.follow()) {
                stop = Stop::Limit;
            }
            if (!stop) {
                stop = derivation.step();
            }
            if (stop) {
                report(derivation, *stop);
                return stop;
            }
            AncestorStep& back = place.back.emplace_back();
            back.generation = age;
            back.next_position = position;
            back.position = derivation.word().origins()[position].place;
            stop = trace_back_step(std::move(*before), sense_state, position, back);
            if (stop) {
                return stop;
            }
            trace_.agrees = trace_.agrees && back.agrees;
            position = back.position;
            if (options_.scope == TraceScope::Written && !back.steps.empty()) {
                return std::nullopt;
            }
        }
        if (!place.back.empty()) {
            const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
            Derivation start(bytecode_, with_senses(derive_, senses.get()));
            if (const std::optional<Stop> stop = start.start()) {
                report(start, *stop);
                return stop;
            }
            place.origin = origin_in_grammar(bytecode_, start.word().origins()[position]);
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> trace_back_step(Word before,
                                                      const std::string& sense_state,
                                                      std::uint64_t target,
                                                      AncestorStep& back) {
        StepTracer tracer(bytecode_, inputs_);
        tracer.begin({back.position}, before, back.generation, DerivationPass::Kind::Rewrite);
        back.module = modules_at(bytecode_, before, {back.position}).front();
        DeriveOptions options = derive_;
        options.on_pass = [&](const DerivationPass& pass) { tracer.on_pass(pass); };
        const std::unique_ptr<EnvironmentSense> senses = senses_.make(bytecode_);
        Derivation stepping(bytecode_, with_senses(options, senses.get()));
        std::optional<Stop> stop = stepping.resume(std::move(before), back.generation, sense_state);
        if (!stop) {
            stop = stepping.step();
        }
        tracer.finish();
        if (stop) {
            report(stepping, *stop);
            return stop;
        }
        back.agrees = tracer.agrees();
        const auto found = std::find_if(
            tracer.places().begin(), tracer.places().end(),
            [target](const StepTracer::Place& each) { return each.position == target; });
        if (found == tracer.places().end()) {
            back.agrees = false;
            return std::nullopt;
        }
        back.offset = found->offset;
        for (std::size_t i = found->parent; i != kNoTrace; i = tracer.traces()[i].parent) {
            const Fate fate = tracer.traces()[i].fate;
            if (fate == Fate::Rewritten || fate == Fate::Sensed) {
                back.steps.insert(back.steps.begin(), tracer.traces()[i]);
            }
        }
        for (std::size_t i = 0; i < back.steps.size(); ++i) {
            back.steps[i].parent = i == 0 ? kNoTrace : i - 1;
        }
        return std::nullopt;
    }

    const TraceOptions& options_;
    const Grammar& grammar_;
    const Bytecode& bytecode_;
    Step step_;
    DeriveOptions derive_;
    PlantSenses senses_;
    TraceInputs inputs_;
    Trace trace_;
    std::string sense_state_;              // state of the environments at the traced generation
    std::vector<TracedModule> next_;       // what the traced modules become, in their order
    std::vector<StoredWord> stored_words_; // by ascending age
    std::uint64_t stored_bytes_ = 0;       // memory of stored_words_
    std::uint32_t stride_ = 1;             // ages of stored words are multiples of this number
};

} // namespace

std::vector<ProductionNames> production_names(const Grammar& grammar) {
    std::vector<ProductionNames> names;
    if (!grammar.program ||
        grammar.program->productions.size() != grammar.bytecode.productions.size()) {
        return names;
    }
    const Program& program = *grammar.program;
    for (const Production& production : program.productions) {
        ProductionNames& production_names = names.emplace_back();
        for (const NameId formal : production.formals) {
            production_names.formals.emplace_back(grammar.names.text(formal));
        }
        for (const LocalValue& local : production.locals) {
            ProductionNames::Local& named = production_names.locals.emplace_back();
            named.name = grammar.names.text(local.name);
            const Value& value = program.value(local.value);
            if (value.left != kNoValue) {
                continue;
            }
            named.leaf = value.opcode;
            if (value.opcode == Opcode::Literal) {
                named.literal = value.literal;
            } else {
                named.index = value.index;
            }
        }
    }
    return names;
}

Outcome<Trace>
trace_modules(const TraceOptions& options, const Grammar& grammar, const Project& project) {
    return Tracing(options, grammar, project).run();
}

} // namespace lsys
