// SPDX-License-Identifier: MIT
#include "runtime/derive/derive.h"

#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/derive/brackets.h"
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/engine/origins.h"
#include "runtime/derive/engine/pass.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/prune.h"
#include "runtime/derive/engine/stage_depth.h"
#include "runtime/derive/engine/start.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

struct Derivation::State {
    State(const Bytecode& program, DeriveOptions chosen)
        : bytecode(program), options(std::move(chosen)), word(code_width(program.code_count())),
          next(word.code_width()), spare(word.code_width()), pruner(program),
          depth(stage_depth(program, Stage::Decompose)), rules(program.rewriting_rule_count()) {}

    const Bytecode& bytecode;
    DeriveOptions options;
    std::vector<float> globals;
    std::optional<Plan> plan;
    std::optional<Passes> passes;
    std::optional<Plan> decompose_plan; // if the program has productions of #decompose
    std::optional<Passes> decompose_passes;
    Word word;
    Word next;  // written by the current pass
    Word spare; // the third word, for generations of several passes
    Pruner pruner;
    StageDepth depth; // passes of decomposition
    std::uint32_t rules = 0;
    std::uint32_t age = 0;
    DerivationEnd end;

    [[nodiscard]] std::optional<Stop> fail(RuntimeError error) {
        end.error = std::move(error);
        return Stop::Diagnosed;
    }

    /// Sets the values reported if the next word does not fit: its number of modules, and the bytes
    /// held with it.
    void report_limit(LimitKind kind, std::uint64_t modules, std::uint64_t bytes) {
        end.limit = {kind, age, word.module_count(), modules, bytes};
    }

    /// Draws the globals and makes the plans, which depend on them.
    [[nodiscard]] std::optional<Stop> make_plans() {
        std::optional<RuntimeError> wrong = draw_globals(bytecode, options.seed, globals);
        if (wrong) {
            return fail(std::move(*wrong));
        }
        passes.reset();
        const PlanInputs inputs{globals.data(), options.seed,
                                static_cast<float>(options.generations)};
        plan.emplace(bytecode, inputs, true);
        passes.emplace(*plan, options);
        if (depth.passes != 0) {
            decompose_passes.reset();
            decompose_plan.emplace(bytecode, inputs, true, Stage::Decompose);
            decompose_passes.emplace(*decompose_plan, options);
        }
        return std::nullopt;
    }

    /// Makes all words keep origins, or none, as DeriveOptions::origins says. Returns false if
    /// there is no memory.
    [[nodiscard]] bool apply_origin_option() {
        for (Word* const each : {&word, &next, &spare}) {
            if (!options.origins) {
                each->drop_origins();
            } else if (!each->keep_origins()) {
                return false;
            }
        }
        return true;
    }

    /// Starts from the word of a saved derivation instead of the axiom.
    [[nodiscard]] std::optional<Stop> adopt_saved_word(Word saved, std::uint32_t saved_age) {
        const bool has_origins = saved.keeps_origins();
        word = std::move(saved);
        age = saved_age;
        report_limit(LimitKind::Memory, word.module_count(),
                     word.held_bytes() +
                         (options.origins ? word.module_count() * sizeof(Origin) : 0));
        if (options.origins && end.limit.predicted_bytes > options.limits.max_bytes) {
            return Stop::Limit;
        }
        if (!apply_origin_option()) {
            return Stop::OutOfMemory;
        }
        if (!has_origins) {
            std::fill(word.origins().begin(), word.origins().end(), Origin{kNone, age});
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> make_axiom() {
        std::vector<float> parameters;
        std::optional<RuntimeError> wrong =
            axiom_parameters(bytecode, options.seed, globals, parameters);
        if (wrong) {
            return fail(std::move(*wrong));
        }
        if (!apply_origin_option()) {
            return Stop::OutOfMemory;
        }
        const BytecodeAxiom& axiom = chosen_axiom(bytecode, options.seed);
        const std::uint64_t count = axiom.word.codes.count;
        report_limit(LimitKind::Modules, count,
                     plan->held_bytes() + word.held_bytes_after(count, parameters.size()));
        end.limit.modules = 0;
        if (count > options.limits.max_modules) {
            return Stop::Limit;
        }
        end.limit.kind = LimitKind::Memory;
        if (end.limit.predicted_bytes > options.limits.max_bytes) {
            return Stop::Limit;
        }
        if (!word.resize(count, parameters.size())) {
            return Stop::OutOfMemory;
        }
        word.visit([&](auto codes) { copy_axiom_codes(bytecode, axiom, codes.data()); });
        std::copy(parameters.begin(), parameters.end(), word.parameters().begin());
        if (word.keeps_origins()) {
            copy_axiom_origins(axiom, word.origins().data());
        }
        return std::nullopt;
    }

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
    void announce(DerivationPass& facts, const Word* current) {
        if (!options.on_pass) {
            return;
        }
        Word& in = current == &word ? word : current == &next ? next : spare;
        number_modules(in, facts.generation);
        facts.in = current;
        facts.out = nullptr;
        options.on_pass(facts);
    }
    void report(DerivationPass& facts, const Word* written) const {
        if (options.on_pass) {
            facts.out = written;
            options.on_pass(facts);
        }
    }
    /// Makes the origin of each module its index.
    static void number_modules(Word& numbered, std::uint32_t age_of_word) {
        std::uint32_t index = 0;
        for (Origin& origin : numbered.origins()) {
            origin = {index++, age_of_word | kFollowed};
        }
    }

    /// Runs one pass over `current`, which then refers to the written word; `word` is unchanged.
    [[nodiscard]] std::optional<Stop>
    pass(Passes& runner, const PassKeys& keys, DerivationPass facts, const Word*& current) {
        facts.generation = keys.generation;
        facts.first_draw = keys.first_draw;
        announce(facts, current);
        Word& out = target_of_pass(current);
        const Word& other = current == &word ? spare : word;
        const std::uint64_t plans =
            plan->held_bytes() + (decompose_plan ? decompose_plan->held_bytes() : 0);
        const std::optional<Stop> stop =
            runner.run(*current, out, keys, plans + other.held_bytes());
        if (stop == Stop::Diagnosed) {
            end.error = runner.error();
        } else if (stop == Stop::Limit || stop == Stop::OutOfMemory) {
            end.limit = runner.limit();
            end.limit.modules = word.module_count();
        } else if (!stop) {
            report(facts, &out);
            make_current(out, current);
        }
        return stop;
    }

    /// Rewrites by one rule; kNone: by all rules.
    [[nodiscard]] std::optional<Stop>
    rewrite(std::uint64_t first_draw, std::uint32_t rule, const Word*& current) {
        return pass(*passes, {options.seed, age, first_draw}, {.rule = rule}, current);
    }

    /// Runs a pass of each rule in turn.
    [[nodiscard]] std::optional<Stop> rewrite_sequentially(const Word*& current) {
        std::optional<Stop> stop;
        for (std::uint32_t rule = 0; rule < rules && !stop; ++rule) {
            plan->select_rule(rule);
            if (passes->may_rewrite_any(*current)) {
                stop = rewrite(kDrawsOfPass * rule, rule, current);
            }
        }
        return stop;
    }

    [[nodiscard]] std::optional<Stop> rewrite_by_mode(const Word*& current) {
        if (rules == 0) {
            return std::nullopt;
        }
        plan->prepare(age);
        switch (bytecode.settings.rewriting) {
        case RewritingMode::Parallel:
        case RewritingMode::Leftmost:
            return rewrite(0, kNone, current);
        case RewritingMode::Sequential:
            return rewrite_sequentially(current);
        case RewritingMode::Cyclic:
            plan->select_rule(age % rules);
            return passes->may_rewrite_any(*current) ? rewrite(0, age % rules, current)
                                                     : std::nullopt;
        }
        return std::nullopt;
    }

    /// Removes the modules that `%` modules cut, before any module is rewritten.
    [[nodiscard]] std::optional<Stop> prune(const Word*& current) {
        if (!pruner.can_cut()) {
            return std::nullopt;
        }
        const PrunedSize size = pruned_size(pruner, *current);
        if (size.modules == current->module_count()) {
            return std::nullopt;
        }
        DerivationPass facts{.kind = DerivationPass::Kind::Cut, .generation = age};
        announce(facts, current);
        Word& out = target_of_pass(current);
        report_limit(LimitKind::Memory, size.modules,
                     plan->held_bytes() + word.held_bytes() + spare.held_bytes() +
                         out.held_bytes_after(size.modules, size.parameters));
        end.limit.exact = false;
        if (end.limit.predicted_bytes > options.limits.max_bytes) {
            return Stop::Limit;
        }
        if (!out.resize(size.modules, size.parameters)) {
            return Stop::OutOfMemory;
        }
        write_pruned(pruner, *current, out);
        report(facts, &out);
        make_current(out, current);
        passes->discard_census();
        return std::nullopt;
    }

    /// The error for the first module that a production of the plan's stage still matches, if any.
    [[nodiscard]] static std::optional<RuntimeError>
    unfinished(const Plan& stage_plan, const Word& in, const PassKeys& keys) {
        return visit_view(in, [&](const auto& view) -> std::optional<RuntimeError> {
            Chooser chooser(stage_plan, keys, view, nullptr);
            const std::optional<ModulePlace> place = find_match(stage_plan, chooser, view);
            if (!place) {
                return std::nullopt;
            }
            return too_deep(stage_plan, chooser, keys, view, *place);
        });
    }

    /// Runs passes of #decompose over a word of age `word_age` until nothing matches, or up to the
    /// max number of passes.
    [[nodiscard]] std::optional<Stop> decompose(std::uint32_t word_age, const Word*& current) {
        if (!decompose_plan) {
            return std::nullopt;
        }
        decompose_plan->prepare(word_age);
        decompose_passes->discard_census();
        PassKeys keys{options.seed, word_age, kFirstDecomposeDraw, true};
        for (std::uint32_t done = 0; decompose_passes->may_rewrite_any(*current); ++done) {
            std::optional<RuntimeError> matching = unfinished(*decompose_plan, *current, keys);
            if (!matching) {
                break;
            }
            if (done == depth.passes) {
                return depth.checked ? fail(std::move(*matching)) : std::nullopt;
            }
            const DerivationPass facts{.kind = DerivationPass::Kind::Decompose, .number = done};
            if (const std::optional<Stop> stop = pass(*decompose_passes, keys, facts, current)) {
                end.limit.generation = age;
                // For the axiom, no word is complete yet.
                end.limit.modules = word_age == 0 ? 0 : end.limit.modules;
                return stop;
            }
            keys.first_draw += kDrawsOfPass;
            passes->discard_census();
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> step() {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return Stop::Cancelled;
        }
        const Word* current = &word;
        std::optional<Stop> stop = prune(current);
        if (!stop) {
            stop = rewrite_by_mode(current);
        }
        if (!stop) {
            stop = decompose(age + 1, current);
        }
        if (stop) {
            passes->discard_census();
            return stop;
        }
        if (current == &next) {
            std::swap(word, next);
        }
        ++age;
        if (options.progress) {
            options.progress(age, word.module_count());
        }
        return std::nullopt;
    }

    /// Runs the passes of #interpret over the word.
    [[nodiscard]] std::optional<Stop> interpret() {
        const StageDepth drawn = stage_depth(bytecode, Stage::Interpret);
        if (drawn.passes == 0) {
            return std::nullopt;
        }
        const PlanInputs inputs{globals.data(), options.seed,
                                static_cast<float>(options.generations)};
        Plan drawing(bytecode, inputs, true, Stage::Interpret);
        drawing.prepare(age);
        Passes runner(drawing, options);
        PassKeys keys{options.seed, age, kFirstInterpretDraw, true};
        const Word* current = &word;
        for (std::uint32_t done = 0; runner.may_rewrite_any(*current); ++done) {
            std::optional<RuntimeError> matching = unfinished(drawing, *current, keys);
            if (!matching) {
                break;
            }
            if (done == drawn.passes) {
                if (drawn.checked) {
                    return fail(std::move(*matching));
                }
                break;
            }
            const DerivationPass facts{.kind = DerivationPass::Kind::Interpret, .number = done};
            if (const std::optional<Stop> stop = pass(runner, keys, facts, current)) {
                return stop;
            }
            keys.first_draw += kDrawsOfPass;
        }
        if (current == &next) {
            std::swap(word, next);
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Stop> decompose_axiom() {
        const Word* current = &word;
        const std::optional<Stop> stop = decompose(0, current);
        if (!stop && current == &next) {
            std::swap(word, next);
        }
        return stop;
    }

    [[nodiscard]] std::optional<Stop> check_brackets() {
        BracketCounter counter(bytecode);
        const std::optional<std::uint64_t> found =
            word.visit([&](auto codes) { return counter.feed(codes.data(), codes.size()); });
        return found ? fail(unmatched_bracket(bytecode, word.code(*found), *found, age))
                     : std::nullopt;
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

Derivation::Derivation(const Bytecode& bytecode, DeriveOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}

Derivation::~Derivation() = default;
Derivation::Derivation(Derivation&&) noexcept = default;
Derivation& Derivation::operator=(Derivation&&) noexcept = default;

std::optional<Stop> Derivation::start() {
    return state_->run([this]() -> std::optional<Stop> {
        std::optional<Stop> stop = state_->make_plans();
        state_->age = 0;
        if (!stop) {
            stop = state_->make_axiom();
        }
        return stop ? stop : state_->decompose_axiom();
    });
}

std::optional<Stop> Derivation::resume(Word word, std::uint32_t age) {
    LSYS_CHECK(word.code_width() == state_->word.code_width(), word.code_width());
    return state_->run([&] {
        const std::optional<Stop> stop = state_->make_plans();
        return stop ? stop : state_->adopt_saved_word(std::move(word), age);
    });
}

std::optional<Stop> Derivation::step() {
    LSYS_CHECK(state_->passes.has_value());
    return state_->run([this] { return state_->step(); });
}

std::optional<Stop> Derivation::run_to(std::uint32_t age) {
    std::optional<Stop> stop;
    while (!stop && state_->age < age) {
        stop = step();
    }
    return stop;
}

std::optional<Stop> Derivation::derive() {
    std::optional<Stop> stop = start();
    if (!stop) {
        stop = run_to(state_->options.generations);
    }
    return stop ? stop : check_brackets();
}

std::optional<Stop> Derivation::interpret() {
    LSYS_CHECK(state_->passes.has_value());
    return state_->run([this] { return state_->interpret(); });
}

bool Derivation::follow() {
    const std::span<Origin> origins = state_->word.origins();
    LSYS_CHECK(origins.size() == state_->word.module_count(), origins.size());
    if (origins.size() > kNone) {
        return false;
    }
    for (std::uint32_t i = 0; i < origins.size(); ++i) {
        origins[i] = {i, state_->age | kFollowed};
    }
    return true;
}

std::optional<Stop> Derivation::check_brackets() {
    return state_->run([this] { return state_->check_brackets(); });
}

const Word& Derivation::word() const {
    return state_->word;
}
std::uint32_t Derivation::age() const {
    return state_->age;
}
const DerivationEnd& Derivation::end() const {
    return state_->end;
}
const std::vector<float>& Derivation::globals() const {
    return state_->globals;
}
Word Derivation::take_word() {
    return std::exchange(state_->word, Word(state_->word.code_width()));
}

} // namespace lsys
