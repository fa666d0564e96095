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

/// Modules between two checks of DeriveOptions::cancelled.
constexpr std::uint64_t kModulesBetweenChecks = std::uint64_t{1} << 20;

/// A stack that keeps its memory when items are removed.
template <typename T>
class Stack {
public:
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const T& operator[](std::size_t index) const { return items_[index]; }
    void push(const T& item) {
        if (size_ == items_.size()) {
            items_.resize(2 * size_ + 16);
        }
        items_[size_++] = item;
    }
    /// The last item; without one, T{}.
    [[nodiscard]] T top() const { return size_ == 0 ? T{} : items_[size_ - 1]; }
    void pop() { size_ -= size_ == 0 ? 0 : 1; }
    /// Keeps the first `size` items.
    void cut(std::size_t size) { size_ = size; }

private:
    std::vector<T> items_;
    std::size_t size_ = 0;
};

} // namespace

Sweep::Sweep(const Bytecode& bytecode, const PlanInputs& inputs, Stage stage)
    : stage_(stage), plan_(bytecode, inputs, true, stage), program_(bytecode, inputs, stage),
      contexts_(plan_), keys_{inputs.seed, 0, first_draw(), true} {
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
    if (program_.has_general() && plan_.needs_contexts()) {
        if (const std::optional<Stop> stop = make_tables(word, options.limits, other_bytes)) {
            return stop;
        }
    }
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

/// One pass over `word`, whose parameters are `parameters`. Stores the neighbours of the next
/// module to be visited: for `#down` the module after it on the axis and the first modules of the
/// branches in between, for `#up` the module before it on the path to the root.
template <typename C>
class Sweep::Run {
public:
    Run(Sweep& sweep, const WordView<C>& word, float* parameters)
        : plan_(sweep.plan_), program_(sweep.program_), keys_(sweep.keys_), view_(word),
          parameters_(parameters),
          chooser_(plan_, keys_, view_, plan_.needs_contexts() ? &sweep.contexts_ : nullptr) {
        bases_[kConstantBase] = program_.constants();
        bases_[kSlotBase] = slots_.data();
    }

    /// Visits the modules from `place` up to `end`. On a fault returns false, with its module in
    /// `place`.
    [[nodiscard]] bool up(ModulePlace& place, std::uint64_t end) {
        const SweepProgram::Row* const rows = program_.rows().data();
        for (; place.index < end; ++place.index) {
            const SweepProgram::Row& row = rows[view_.codes[place.index]];
            switch (row.role) {
            case ContextRole::Open:
                levels_.push({axis_, 0});
                continue;
            case ContextRole::Close:
                axis_ = levels_.top().axis;
                levels_.pop();
                continue;
            case ContextRole::Module:
            case ContextRole::Ignored:
                break;
            }
            if (row.kind != SweepProgram::Kind::Unchanged && !visit(row, place)) {
                return false;
            }
            if (row.role == ContextRole::Module) {
                axis_ = neighbour(row, place);
            }
            place.parameter += row.stored;
        }
        return true;
    }

    /// Visits the modules before `place` down to `end`. On a fault returns false, with its module
    /// in `place`.
    [[nodiscard]] bool down(ModulePlace& place, std::uint64_t end) {
        const SweepProgram::Row* const rows = program_.rows().data();
        while (place.index > end) {
            --place.index;
            const SweepProgram::Row& row = rows[view_.codes[place.index]];
            switch (row.role) {
            case ContextRole::Close:
                levels_.push({axis_, first_branch_});
                axis_ = {};
                first_branch_ = branches_.size();
                continue;
            case ContextRole::Open:
                leave_branch();
                continue;
            case ContextRole::Module:
            case ContextRole::Ignored:
                break;
            }
            place.parameter -= row.stored;
            if (row.kind != SweepProgram::Kind::Unchanged && !visit(row, place)) {
                return false;
            }
            if (row.role == ContextRole::Module) {
                axis_ = neighbour(row, place);
                branches_.cut(first_branch_);
            }
        }
        return true;
    }

private:
    /// The fields axis_ and first_branch_ as they were before the sweep entered a branch.
    struct Level {
        SweepNeighbour axis;
        std::size_t first_branch = 0;
    };

    /// Leaves a branch at its `[`, coming from the right, and adds its first module to branches_ of
    /// the outer level. A `[` without its `]` is a branch that reaches to the end of the word.
    void leave_branch() {
        const SweepNeighbour first = axis_;
        branches_.cut(first_branch_);
        const Level before = levels_.top();
        levels_.pop();
        axis_ = before.axis;
        first_branch_ = before.first_branch;
        branches_.push(first);
    }

    [[nodiscard]] SweepNeighbour neighbour(const SweepProgram::Row& row,
                                           const ModulePlace& place) const {
        return {row.symbol, row.constants == kNone
                                ? parameters_ + place.parameter
                                : plan_.bytecode().constants.data() + row.constants};
    }

    /// Gives the module at `place` its new parameters. Returns false on a fault.
    [[nodiscard]] bool visit(const SweepProgram::Row& row, const ModulePlace& place) {
        if (row.kind == SweepProgram::Kind::General) {
            return visit_general(place);
        }
        float* const own = parameters_ + place.parameter;
        bases_[kOwnBase] = own;
        for (std::uint32_t i = 0; i < row.candidates.count; ++i) {
            const SweepCandidate& candidate = program_.candidate(row.candidates.first + i);
            if (!matches_contexts(candidate)) {
                continue;
            }
            if (candidate.condition.count != 0) {
                const float value = program_.condition_value(candidate, bases_, slots_.data());
                if (!std::isfinite(value)) {
                    return false;
                }
                if (value == 0.0F) {
                    continue;
                }
            }
            return write(candidate, own);
        }
        return true;
    }

    [[nodiscard]] bool matches_contexts(const SweepCandidate& candidate) {
        if (candidate.has_axis) {
            if (axis_.symbol != candidate.axis.symbol) {
                return false;
            }
            bases_[candidate.axis.base] = axis_.parameters;
        }
        if (branches_.size() - first_branch_ < candidate.branches.count) {
            return false;
        }
        for (std::uint32_t i = 0; i < candidate.branches.count; ++i) {
            const SweepContext& branch = program_.branch(candidate.branches.first + i);
            const SweepNeighbour& found = branches_[branches_.size() - 1 - i];
            if (branch.symbol != kNoSymbol && found.symbol != branch.symbol) {
                return false;
            }
            bases_[branch.base] = found.parameters;
        }
        return true;
    }

    /// Computes all values before it stores the first, because they may read each other.
    [[nodiscard]] bool write(const SweepCandidate& candidate, float* own) {
        std::array<float, kMaxSweepParameters> values; // NOLINT: written before they are read
        bool finite = true;
        for (std::uint32_t i = 0; i < candidate.chains.count; ++i) {
            values[i] = program_.parameter_value(candidate, i, bases_, slots_.data());
            finite = finite && std::isfinite(values[i]);
        }
        if (finite) {
            std::copy_n(values.data(), candidate.chains.count, own);
        }
        return finite;
    }

    /// visit() for Kind::General: chooses and evaluates a production as rewriting does.
    [[nodiscard]] bool visit_general(const ModulePlace& place) {
        const Row& row = plan_.row(view_.codes[place.index]);
        std::uint32_t record = 0;
        if (row.copies && row.kind == RowKind::Fixed) {
            return true;
        }
        if (row.kind != RowKind::Fixed) {
            if (row.kind == RowKind::General && !chooser_.passes_guards(place.index, row)) {
                return true;
            }
            if (!chooser_.choose(place, row, record)) {
                return false;
            }
            if (record == 0) {
                return true;
            }
        }
        const Entry& entry =
            plan_.entries()[record == 0 ? view_.codes[place.index] : row.base + record];
        EvalFault fault;
        values_.resize(std::max<std::size_t>(values_.size(), entry.parameter_count));
        if (!evaluate_entry(plan_, keys_, chooser_.matcher(), place.index, place, entry,
                            values_.data(), fault)) {
            return false;
        }
        std::copy_n(values_.data(), entry.parameter_count, parameters_ + place.parameter);
        return true;
    }

    const Plan& plan_;
    const SweepProgram& program_;
    const PassKeys& keys_;
    const WordView<C>& view_;
    float* parameters_;
    Chooser<C> chooser_;
    std::vector<float> values_; // values computed by visit_general()
    SweepBases bases_{};
    std::array<float, kMaxSweepSlots> slots_{};
    SweepNeighbour axis_;            // the neighbour on the axis
    Stack<SweepNeighbour> branches_; // of this level: from first_branch_ on, the last first
    std::size_t first_branch_ = 0;   // index in branches_
    Stack<Level> levels_;            // one per open branch
};

template <typename C>
std::optional<Stop> Sweep::run_typed(const Word& word,
                                     const WordView<C>& view,
                                     float* parameters,
                                     const DeriveOptions& options,
                                     std::uint64_t other_bytes) {
    Run<C> pass(*this, view, parameters);
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
