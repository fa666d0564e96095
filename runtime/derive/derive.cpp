#include "runtime/derive/derive.h"

#include "grammar/base/contract.h"
#include "runtime/derive/engine/brackets.h"
#include "runtime/derive/engine/chains.h"
#include "runtime/derive/engine/origins.h"
#include "runtime/derive/engine/pass.h"
#include "runtime/derive/engine/plan.h"
#include "runtime/derive/engine/prune.h"
#include "runtime/derive/engine/remains.h"
#include "runtime/derive/engine/start.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

struct Derivation::State {
    State(const Bytecode& program, DeriveOptions chosen)
        : bytecode(program), options(std::move(chosen)), word(code_width(program.code_count())),
          next(word.code_width()), spare(word.code_width()), pruner(program),
          depth(depth_of(program, Stage::Decompose)), rules(program.rewriting_rules()) {}

    const Bytecode& bytecode;
    DeriveOptions options;
    std::vector<float> globals;
    std::optional<Plan> plan;
    std::optional<Passes> passes;
    std::optional<Plan> decompose_plan; // where there are such productions
    std::optional<Passes> decompose_passes;
    Word word;
    Word next;  // written by the pass at work
    Word spare; // a generation of several passes needs a third
    Pruner pruner;
    StageDepth depth; // of decomposition
    std::uint32_t rules = 0;
    std::uint32_t age = 0;
    RuntimeError error;
    LimitReport limit;

    [[nodiscard]] DeriveStatus fail(RuntimeError with) {
        error = std::move(with);
        return DeriveStatus::Error;
    }

    /// Draws the globals and prepares the plan, which depends on them.
    [[nodiscard]] DeriveStatus begin() {
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
        return DeriveStatus::Ok;
    }

    /// Either all words keep origins or none does. False: no memory.
    [[nodiscard]] bool agree_on_origins() {
        for (Word* const each : {&word, &next, &spare}) {
            if (!options.origins) {
                each->drop_origins();
            } else if (!each->keep_origins()) {
                return false;
            }
        }
        return true;
    }

    /// The word of a saved derivation in place of the axiom.
    [[nodiscard]] DeriveStatus take_over(Word saved, std::uint32_t saved_age) {
        const bool knows = saved.keeps_origins();
        word = std::move(saved);
        age = saved_age;
        limit = {};
        limit.kind = LimitKind::Memory;
        limit.generation = age;
        limit.modules = word.module_count();
        limit.predicted_modules = word.module_count();
        limit.predicted_bytes =
            word.held_bytes() + (options.origins ? word.module_count() * sizeof(Origin) : 0);
        if (options.origins && limit.predicted_bytes > options.limits.max_bytes) {
            return DeriveStatus::Limit;
        }
        if (!agree_on_origins()) {
            return DeriveStatus::OutOfMemory;
        }
        if (!knows) {
            std::fill(word.origins().begin(), word.origins().end(), Origin{kNone, age});
        }
        return DeriveStatus::Ok;
    }

    [[nodiscard]] DeriveStatus make_axiom() {
        std::vector<float> parameters;
        std::optional<RuntimeError> wrong =
            axiom_parameters(bytecode, options.seed, globals, parameters);
        if (wrong) {
            return fail(std::move(*wrong));
        }
        if (!agree_on_origins()) {
            return DeriveStatus::OutOfMemory;
        }
        const std::uint64_t count = bytecode.axiom.codes.count;
        limit = {};
        limit.predicted_modules = count;
        limit.predicted_bytes =
            plan->held_bytes() + word.held_bytes_after(count, parameters.size());
        if (count > options.limits.max_modules) {
            return DeriveStatus::Limit;
        }
        limit.kind = LimitKind::Memory;
        if (limit.predicted_bytes > options.limits.max_bytes) {
            return DeriveStatus::Limit;
        }
        if (!word.resize(count, parameters.size())) {
            return DeriveStatus::OutOfMemory;
        }
        word.visit([this](auto codes) { copy_axiom_codes(bytecode, codes.data()); });
        std::copy(parameters.begin(), parameters.end(), word.parameters().begin());
        if (word.keeps_origins()) {
            copy_axiom_origins(bytecode, word.origins().data());
        }
        return DeriveStatus::Ok;
    }

    /// Where the next pass writes; then `current` is told.
    [[nodiscard]] Word& room_beside(const Word* current) { return current == &next ? spare : next; }
    void take(const Word& written, const Word*& current) {
        if (&written == &spare) {
            std::swap(next, spare);
        }
        current = &next;
    }

    /// One pass over `current`, which becomes what is written; `word` stays what it is.
    [[nodiscard]] DeriveStatus pass(Passes& by, const PassKeys& keys, const Word*& current) {
        Word& out = room_beside(current);
        const Word& other = current == &word ? spare : word;
        const std::uint64_t plans =
            plan->held_bytes() + (decompose_plan ? decompose_plan->held_bytes() : 0);
        const DeriveStatus status = by.run(*current, out, keys, plans + other.held_bytes());
        if (status == DeriveStatus::Error) {
            error = by.error();
        } else if (status == DeriveStatus::Limit || status == DeriveStatus::OutOfMemory) {
            limit = by.limit();
            limit.modules = word.module_count();
        }
        if (status == DeriveStatus::Ok) {
            take(out, current);
        }
        return status;
    }

    [[nodiscard]] DeriveStatus rewrite(std::uint64_t first_draw, const Word*& current) {
        return pass(*passes, {options.seed, age, first_draw}, current);
    }

    /// A pass of each rule in turn.
    [[nodiscard]] DeriveStatus rewrite_sequentially(const Word*& current) {
        DeriveStatus status = DeriveStatus::Ok;
        for (std::uint32_t rule = 0; rule < rules && status == DeriveStatus::Ok; ++rule) {
            plan->select_rule(rule);
            if (passes->concerns(*current)) {
                status = rewrite(kDrawsOfPass * rule, current);
            }
        }
        return status;
    }

    [[nodiscard]] DeriveStatus rewrite_by_mode(const Word*& current) {
        if (rules == 0) {
            return DeriveStatus::Ok;
        }
        plan->prepare(age);
        switch (bytecode.settings.rewriting) {
        case RewritingMode::Parallel:
        case RewritingMode::Leftmost:
            return rewrite(0, current);
        case RewritingMode::Sequential:
            return rewrite_sequentially(current);
        case RewritingMode::Cyclic:
            plan->select_rule(age % rules);
            return passes->concerns(*current) ? rewrite(0, current) : DeriveStatus::Ok;
        }
        return DeriveStatus::Ok;
    }

    /// What `%` cuts off goes before anything is rewritten.
    [[nodiscard]] DeriveStatus prune(const Word*& current) {
        if (!pruner.any()) {
            return DeriveStatus::Ok;
        }
        const PrunedSize size = pruned_size(pruner, *current);
        if (size.modules == current->module_count()) {
            return DeriveStatus::Ok;
        }
        Word& out = room_beside(current);
        limit = {};
        limit.kind = LimitKind::Memory;
        limit.generation = age;
        limit.modules = word.module_count();
        limit.predicted_modules = size.modules;
        limit.predicted_bytes = plan->held_bytes() + word.held_bytes() + spare.held_bytes() +
                                out.held_bytes_after(size.modules, size.parameters);
        limit.exact = false;
        if (limit.predicted_bytes > options.limits.max_bytes) {
            return DeriveStatus::Limit;
        }
        if (!out.resize(size.modules, size.parameters)) {
            return DeriveStatus::OutOfMemory;
        }
        write_pruned(pruner, *current, out);
        take(out, current);
        passes->forget();
        return DeriveStatus::Ok;
    }

    /// The error that a module can still be decomposed, if there is such a module.
    [[nodiscard]] std::optional<RuntimeError> undecomposed(const Word& in, const PassKeys& keys) {
        return visit_view(in, [&](const auto& view) -> std::optional<RuntimeError> {
            Chooser chooser(*decompose_plan, keys, view, nullptr);
            const std::optional<ModulePlace> place = find_match(*decompose_plan, chooser, view);
            if (!place) {
                return std::nullopt;
            }
            return too_deep(*decompose_plan, chooser, keys, view, *place);
        });
    }

    /// Passes of #decompose over a word of age `of`, until nothing matches.
    [[nodiscard]] DeriveStatus decompose(std::uint32_t of, const Word*& current) {
        if (!decompose_plan) {
            return DeriveStatus::Ok;
        }
        decompose_plan->prepare(of);
        decompose_passes->forget();
        PassKeys keys{options.seed, of, kFirstDecomposeDraw, true};
        for (std::uint32_t done = 0; decompose_passes->concerns(*current); ++done) {
            std::optional<RuntimeError> left = undecomposed(*current, keys);
            if (!left) {
                break;
            }
            if (done == depth.passes) {
                return depth.checked ? fail(std::move(*left)) : DeriveStatus::Ok;
            }
            const DeriveStatus status = pass(*decompose_passes, keys, current);
            if (status != DeriveStatus::Ok) {
                limit.generation = age;
                limit.modules = of == 0 ? 0 : limit.modules; // the axiom is not there yet
                return status;
            }
            keys.first_draw += kDrawsOfPass;
            passes->forget();
        }
        return DeriveStatus::Ok;
    }

    [[nodiscard]] DeriveStatus step() {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return DeriveStatus::Cancelled;
        }
        const Word* current = &word;
        DeriveStatus status = prune(current);
        if (status == DeriveStatus::Ok) {
            status = rewrite_by_mode(current);
        }
        if (status == DeriveStatus::Ok) {
            status = decompose(age + 1, current);
        }
        if (status != DeriveStatus::Ok) {
            passes->forget();
            return status;
        }
        if (current == &next) {
            std::swap(word, next);
        }
        ++age;
        if (options.progress) {
            options.progress(age, word.module_count());
        }
        return DeriveStatus::Ok;
    }

    [[nodiscard]] DeriveStatus decompose_axiom() {
        const Word* current = &word;
        const DeriveStatus status = decompose(0, current);
        if (status == DeriveStatus::Ok && current == &next) {
            std::swap(word, next);
        }
        return status;
    }
};

Derivation::Derivation(const Bytecode& bytecode, DeriveOptions options)
    : state_(std::make_unique<State>(bytecode, std::move(options))) {}

Derivation::~Derivation() = default;
Derivation::Derivation(Derivation&&) noexcept = default;
Derivation& Derivation::operator=(Derivation&&) noexcept = default;

DeriveStatus Derivation::start() {
    const DeriveStatus status = state_->begin();
    if (status != DeriveStatus::Ok) {
        return status;
    }
    state_->age = 0;
    const DeriveStatus made = state_->make_axiom();
    return made == DeriveStatus::Ok ? state_->decompose_axiom() : made;
}

DeriveStatus Derivation::resume(Word word, std::uint32_t age) {
    LSYS_CHECK(word.code_width() == state_->word.code_width(), word.code_width());
    const DeriveStatus status = state_->begin();
    if (status != DeriveStatus::Ok) {
        return status;
    }
    return state_->take_over(std::move(word), age);
}

DeriveStatus Derivation::step() {
    LSYS_CHECK(state_->passes.has_value());
    return state_->step();
}

DeriveStatus Derivation::run_to(std::uint32_t age) {
    DeriveStatus status = DeriveStatus::Ok;
    while (status == DeriveStatus::Ok && state_->age < age) {
        status = step();
    }
    return status;
}

DeriveStatus Derivation::derive() {
    DeriveStatus status = start();
    if (status == DeriveStatus::Ok) {
        status = run_to(state_->options.generations);
    }
    return status == DeriveStatus::Ok ? check_brackets() : status;
}

DeriveStatus Derivation::check_brackets() {
    State& state = *state_;
    BracketCounter counter(state.bytecode);
    const std::optional<std::uint64_t> found =
        state.word.visit([&](auto codes) { return counter.feed(codes.data(), codes.size()); });
    return found ? state.fail(unmatched_bracket(state.bytecode, state.word.code(*found), *found,
                                                state.age))
                 : DeriveStatus::Ok;
}

const Word& Derivation::word() const {
    return state_->word;
}
std::uint32_t Derivation::age() const {
    return state_->age;
}
const RuntimeError& Derivation::error() const {
    return state_->error;
}
const LimitReport& Derivation::limit() const {
    return state_->limit;
}
const std::vector<float>& Derivation::globals() const {
    return state_->globals;
}
Word Derivation::take_word() {
    return std::exchange(state_->word, Word(state_->word.code_width()));
}

} // namespace lsys
