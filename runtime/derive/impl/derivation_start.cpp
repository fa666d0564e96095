// SPDX-License-Identifier: MIT
#include "grammar/base/contract.h"
#include "runtime/derive/engine/origins.h"
#include "runtime/derive/engine/start.h"
#include "runtime/derive/impl/derivation_state.h"

#include <algorithm>

namespace lsys {

Derivation::State::State(const Bytecode& program, DeriveOptions chosen)
    : bytecode(program), options(std::move(chosen)), word(code_width(program.code_count())),
      next(word.code_width()), spare(word.code_width()), pruner(program),
      depth(stage_depth(program, Stage::Decompose)), rules(program.rewriting_rule_count()) {
    if (program.has_senses()) {
        for (Code code = 0; code < program.code_count(); ++code) {
            is_sense.push_back(program.symbol(program.symbol_of(code)).senses());
        }
    }
}

std::optional<Stop> Derivation::State::make_plans() {
    std::optional<RuntimeError> wrong = draw_globals(bytecode, options.seed, globals);
    if (wrong) {
        return fail(std::move(*wrong));
    }
    passes.reset();
    const PlanInputs inputs = plan_inputs();
    plan.emplace(bytecode, inputs, true);
    passes.emplace(*plan, options);
    if (depth.passes != 0) {
        decompose_passes.reset();
        decompose_plan.emplace(bytecode, inputs, true, Stage::Decompose);
        decompose_passes.emplace(*decompose_plan, options);
    }
    for (auto& [stage, sweep] : {std::pair<Stage, std::optional<Sweep>&>(Stage::Down, down),
                                 std::pair<Stage, std::optional<Sweep>&>(Stage::Up, up)}) {
        if (bytecode.has(stage)) {
            sweep.emplace(bytecode, inputs, stage);
        }
    }
    if (!bytecode.has_senses()) {
        return std::nullopt;
    }
    LSYS_CHECK(options.senses != nullptr);
    return options.senses->begin(options.seed, options.generations, globals, end);
}

bool Derivation::State::apply_origin_option() {
    for (Word* const each : {&word, &next, &spare}) {
        if (!options.origins) {
            each->drop_origins();
        } else if (!each->keep_origins()) {
            return false;
        }
    }
    return true;
}

std::optional<Stop> Derivation::State::adopt_saved_word(Word saved, std::uint32_t saved_age) {
    const bool has_origins = saved.keeps_origins();
    word = std::move(saved);
    age = saved_age;
    report_limit(LimitKind::Memory, word.module_count(),
                 word.held_bytes() + (options.origins ? word.module_count() * sizeof(Origin) : 0));
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

std::optional<Stop> Derivation::State::make_axiom() {
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

std::optional<Stop> Derivation::State::adopt_sense_state(std::string_view saved) {
    if (is_sense.empty() || options.senses->restore(saved)) {
        return std::nullopt;
    }
    RuntimeError error;
    error.kind = RuntimeErrorKind::SenseFailed;
    error.generation = age;
    error.text = "the environments of the saved state are not those of this program";
    return fail(std::move(error));
}

std::optional<Stop> Derivation::State::complete_axiom() {
    const Word* current = &word;
    std::optional<Stop> stop = decompose(0, current);
    if (!stop) {
        stop = sense_and_sweep(0, current);
    }
    if (!stop && current == &next) {
        std::swap(word, next);
    }
    return stop;
}

} // namespace lsys
