// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep.h"

#include "grammar/base/contract.h"
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/engine/faults.h"
#include "runtime/derive/engine/sweep_run.h"

#include <algorithm>
#include <atomic>

namespace lsys {

namespace {

/// Modules between two checks of DeriveOptions::cancelled.
constexpr std::uint64_t kModulesBetweenChecks = std::uint64_t{1} << 20;

} // namespace

Sweep::Sweep(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage)
    : stage_(stage), plan_(bytecode, inputs, true, stage), program_(bytecode, inputs, stage),
      contexts_(plan_), keys_{inputs.seed, 0, first_sweep_draw(stage), true} {
    LSYS_CHECK(stage == Stage::Down || stage == Stage::Up);
}

std::uint64_t Sweep::held_bytes() const {
    return plan_.held_bytes() + program_.held_bytes() + contexts_.held_bytes();
}

bool Sweep::may_change(const Word& word, std::uint32_t age) {
    plan_.prepare(age);
    return visit_view(word, [this](const auto& view) { return may_rewrite(plan_, view); });
}

std::optional<Stop>
Sweep::run(Word& word, std::uint32_t age, const DeriveOptions& options, std::uint64_t other_bytes) {
    plan_.prepare(age);
    keys_.generation = age;
    program_.set_age(age);
    float* const parameters = word.parameters().data();
    return visit_view(word, [&](const auto& view) {
        return run_typed(word, view, parameters, options, other_bytes);
    });
}

std::optional<Stop>
Sweep::make_tables(const Word& word, const Limits& limits, std::uint64_t other_bytes) {
    limit_ = {};
    limit_.kind = LimitKind::Memory;
    limit_.generation = keys_.generation;
    limit_.predicted_modules = word.module_count();
    limit_.predicted_bytes =
        other_bytes + plan_.held_bytes() + word.held_bytes() + contexts_.held_bytes_after(word);
    limit_.exact = false;
    if (limit_.predicted_bytes > limits.max_bytes) {
        return Stop::Limit;
    }
    return contexts_.prepare(plan_, word) ? std::nullopt : std::optional(Stop::OutOfMemory);
}

template <typename C>
std::optional<Stop> Sweep::run_typed(const Word& word,
                                     const WordView<C>& view,
                                     float* parameters,
                                     const DeriveOptions& options,
                                     std::uint64_t other_bytes) {
    SweepRun<C> pass(plan_, program_, keys_, view, parameters);
    const bool is_down = stage_ == Stage::Down;
    ModulePlace place{is_down ? view.count : 0, is_down ? word.parameter_count() : 0};
    for (std::uint64_t left = view.count; left > 0;) {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return Stop::Cancelled;
        }
        const std::uint64_t count = std::min(left, kModulesBetweenChecks);
        left -= count;
        if (!(is_down ? pass.down(place, left) : pass.up(place, view.count - left))) {
            return report_fault(word, view, place, options.limits, other_bytes);
        }
    }
    return std::nullopt;
}

template <typename C>
std::optional<Stop> Sweep::report_fault(const Word& word,
                                        const WordView<C>& view,
                                        const ModulePlace& place,
                                        const Limits& limits,
                                        std::uint64_t other_bytes) {
    if (plan_.needs_contexts()) {
        if (const std::optional<Stop> stop = make_tables(word, limits, other_bytes)) {
            return stop;
        }
    }
    std::optional<RuntimeError> error = find_fault(
        plan_, keys_, view, plan_.needs_contexts() ? &contexts_ : nullptr, place, place.index + 1);
    LSYS_CHECK(error.has_value(), place.index);
    error_ = std::move(*error);
    return Stop::Diagnosed;
}

} // namespace lsys
