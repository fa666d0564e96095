// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep.h"

#include "grammar/base/contract.h"
#include "runtime/derive/engine/depth_limit.h"
#include "runtime/derive/engine/faults.h"
#include "runtime/derive/engine/write.h"

#include <algorithm>
#include <atomic>

namespace lsys {

namespace {

/// Modules between two looks at DeriveOptions::cancelled.
constexpr std::uint64_t kModulesPerLook = std::uint64_t{1} << 20;

} // namespace

Sweep::Sweep(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage)
    : stage_(stage), plan_(bytecode, inputs, true, stage),
      contexts_(plan_), keys_{inputs.seed, 0, first_draw(), true} {
    LSYS_CHECK(stage == Stage::Down || stage == Stage::Up);
}

std::uint64_t Sweep::held_bytes() const {
    return plan_.held_bytes() + contexts_.held_bytes();
}

std::optional<Stop>
Sweep::run(Word& word, std::uint32_t age, const DeriveOptions& options, std::uint64_t other_bytes) {
    plan_.prepare(age);
    keys_.generation = age;
    if (plan_.needs_contexts()) {
        if (const std::optional<Stop> stop = make_tables(word, options.limits, other_bytes)) {
            return stop;
        }
    }
    float* const parameters = word.parameters().data();
    return visit_view(word, [&](const auto& view) { return run_typed(view, parameters, options); });
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

/// One pass. `parameters` are those of `view`, which the pass changes.
template <typename C>
struct Sweep::Run {
    Run(Sweep& sweep, const WordView<C>& word, float* own_parameters)
        : plan(sweep.plan_), keys(sweep.keys_), view(word), parameters(own_parameters),
          contexts(plan.needs_contexts() ? &sweep.contexts_ : nullptr),
          chooser(plan, keys, view, contexts), values(sweep.values_) {}

    /// Gives the module at `place` its new parameters. Returns false on a fault.
    [[nodiscard]] bool visit(const ModulePlace& place, const Row& row) {
        std::uint32_t record = 0;
        if (row.kind != RowKind::Fixed) {
            if (row.kind == RowKind::General && !chooser.passes_guards(place.index, row)) {
                return true;
            }
            if (!chooser.choose(place, row, record)) {
                return false;
            }
            if (record == 0) {
                return true;
            }
        }
        const Entry& entry =
            plan.entries()[record == 0 ? view.codes[place.index] : row.base + record];
        EvalFault fault;
        values.resize(std::max<std::size_t>(values.size(), entry.parameter_count));
        if (!evaluate_entry(plan, keys, chooser.matcher(), place.index, place, entry, values.data(),
                            fault)) {
            return false;
        }
        std::copy_n(values.data(), entry.parameter_count, parameters + place.parameter);
        return true;
    }

    /// Visits the modules from `begin` to `end`. Returns false on a fault, at `place`.
    [[nodiscard]] bool up(ModulePlace& place, std::uint64_t end) {
        const Row* const rows = plan.rows().data();
        for (; place.index < end; ++place.index) {
            const Row& row = rows[view.codes[place.index]];
            if (!row.copies && !visit(place, row)) {
                return false;
            }
            place.parameter += row.stored;
        }
        return true;
    }
    /// Visits the modules before `place` down to `end`. On a fault returns false, with its module
    /// in `place`.
    [[nodiscard]] bool down(ModulePlace& place, std::uint64_t end) {
        const Row* const rows = plan.rows().data();
        while (place.index > end) {
            --place.index;
            const Row& row = rows[view.codes[place.index]];
            place.parameter -= row.stored;
            if (!row.copies && !visit(place, row)) {
                return false;
            }
        }
        return true;
    }

    const Plan& plan;
    const PassKeys& keys;
    const WordView<C>& view;
    float* parameters;
    const ContextTables* contexts;
    Chooser<C> chooser;
    std::vector<float>& values;
};

template <typename C>
std::optional<Stop>
Sweep::run_typed(const WordView<C>& view, float* parameters, const DeriveOptions& options) {
    Run<C> pass(*this, view, parameters);
    const bool is_down = stage_ == Stage::Down;
    ModulePlace place;
    if (is_down) {
        place.index = view.count;
        for (std::uint64_t i = 0; i < view.count; ++i) {
            place.parameter += plan_.rows()[view.codes[i]].stored;
        }
    }
    for (std::uint64_t left = view.count; left > 0;) {
        if (options.cancelled != nullptr && options.cancelled->load(std::memory_order_relaxed)) {
            return Stop::Cancelled;
        }
        const std::uint64_t count = std::min(left, kModulesPerLook);
        left -= count;
        if (!(is_down ? pass.down(place, left) : pass.up(place, view.count - left))) {
            std::optional<RuntimeError> error =
                find_fault(plan_, keys_, view, pass.contexts, place, place.index + 1);
            LSYS_CHECK(error.has_value(), place.index);
            error_ = std::move(*error);
            return Stop::Diagnosed;
        }
    }
    return std::nullopt;
}

} // namespace lsys
