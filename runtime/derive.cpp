#include "runtime/derive.h"

#include "grammar/contract.h"
#include "runtime/derive/brackets.h"
#include "runtime/derive/origins.h"
#include "runtime/derive/pass.h"
#include "runtime/derive/plan.h"
#include "runtime/derive/start.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace lsys {

struct Derivation::State {
    State(const Bytecode& program, DeriveOptions chosen)
        : bytecode(program), options(std::move(chosen)), word(code_width(program.code_count())),
          next(word.code_width()), spare(word.code_width()) {}

    const Bytecode& bytecode;
    DeriveOptions options;
    std::vector<float> globals;
    std::optional<Plan> plan;
    std::optional<Passes> passes;
    Word word;
    Word next;  // written by the pass at work
    Word spare; // a generation of several passes needs a third
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
        switch (word.code_width()) {
        case 1:
            copy_axiom_codes(bytecode, word.codes<std::uint8_t>().data());
            break;
        case 2:
            copy_axiom_codes(bytecode, word.codes<std::uint16_t>().data());
            break;
        default:
            copy_axiom_codes(bytecode, word.codes<std::uint32_t>().data());
            break;
        }
        std::copy(parameters.begin(), parameters.end(), word.parameters().begin());
        if (word.keeps_origins()) {
            copy_axiom_origins(bytecode, word.origins().data());
        }
        return DeriveStatus::Ok;
    }

    /// One pass from `in` to `out`; `other` is a word that is held beside them.
    [[nodiscard]] DeriveStatus
    pass(const Word& in, Word& out, std::uint64_t first_draw, const Word& other) {
        const PassKeys keys{options.seed, age, first_draw};
        const std::uint64_t others = plan->held_bytes() + other.held_bytes();
        const DeriveStatus status = passes->run(in, out, keys, others);
        if (status == DeriveStatus::Error) {
            error = passes->error();
        } else if (status == DeriveStatus::Limit || status == DeriveStatus::OutOfMemory) {
            limit = passes->limit();
            limit.modules = word.module_count();
        }
        return status;
    }

    [[nodiscard]] DeriveStatus step_parallel() {
        const DeriveStatus status = pass(word, next, 0, spare);
        if (status == DeriveStatus::Ok) {
            std::swap(word, next);
        }
        return status;
    }

    [[nodiscard]] DeriveStatus step_cyclic() {
        plan->select_rule(age % bytecode.rule_count);
        return passes->concerns(word) ? step_parallel() : DeriveStatus::Ok;
    }

    /// A pass of each rule in turn. `word` stays what it is until all are done.
    [[nodiscard]] DeriveStatus step_sequential() {
        const Word* current = &word;
        for (std::uint32_t rule = 0; rule < bytecode.rule_count; ++rule) {
            plan->select_rule(rule);
            if (!passes->concerns(*current)) {
                continue;
            }
            constexpr std::uint64_t kDrawsOfRule = std::uint64_t{kMaxSequentialDraws} + 1;
            Word& out = current == &next ? spare : next;
            const Word& other = current == &word ? spare : word;
            const DeriveStatus status = pass(*current, out, kDrawsOfRule * rule, other);
            if (status != DeriveStatus::Ok) {
                return status;
            }
            if (&out == &spare) {
                std::swap(next, spare);
            }
            current = &next;
        }
        if (current == &next) {
            std::swap(word, next);
        }
        return DeriveStatus::Ok;
    }

    [[nodiscard]] DeriveStatus step() {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return DeriveStatus::Cancelled;
        }
        DeriveStatus status = DeriveStatus::Ok;
        if (!bytecode.productions.empty()) {
            plan->prepare(age);
            switch (bytecode.settings.rewriting) {
            case RewritingMode::Parallel:
                status = step_parallel();
                break;
            case RewritingMode::Sequential:
                status = step_sequential();
                break;
            case RewritingMode::Cyclic:
                status = step_cyclic();
                break;
            }
        }
        if (status != DeriveStatus::Ok) {
            passes->forget();
            return status;
        }
        ++age;
        if (options.progress) {
            options.progress(age, word.module_count());
        }
        return DeriveStatus::Ok;
    }

    template <typename C>
    [[nodiscard]] std::optional<std::uint64_t> unmatched_close() const {
        BracketCounter counter(bytecode);
        return counter.feed(word.codes<C>().data(), word.module_count());
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
    return state_->make_axiom();
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

DeriveStatus Derivation::check_brackets() {
    State& state = *state_;
    std::optional<std::uint64_t> found;
    switch (state.word.code_width()) {
    case 1:
        found = state.unmatched_close<std::uint8_t>();
        break;
    case 2:
        found = state.unmatched_close<std::uint16_t>();
        break;
    default:
        found = state.unmatched_close<std::uint32_t>();
        break;
    }
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
