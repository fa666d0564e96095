// SPDX-License-Identifier: MIT
// SweepVisitor: gives modules of a sweep their new parameters, one after the other. Most of the time
// of a sweep is spent in pass(), once per module.
#pragma once

#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/sweep_program.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lsys {

class SweepVisitor {
public:
    /// All arguments outlive the object.
    SweepVisitor(const Plan& plan, const SweepProgram& program, const PassKeys& keys);

    [[nodiscard]] SweepNeighbours& neighbours() { return neighbours_; }
    /// Makes the draws of the next `count` modules that draw. `positions` has room for kSweepLanes.
    void draw(const std::uint64_t* positions, std::size_t count);

    /// Gives a module its new parameters, and makes it a neighbour of those that follow.
    [[gnu::always_inline]] bool pass(const SweepProgram::Row& row, float* own) {
        if (row.draws) {
            machine_.set_base(kDrawBase, units_.data() + lane_++);
        }
        if (row.candidates.count != 0 && !visit(row, own)) {
            return false;
        }
        if (row.role == ContextRole::Module) {
            neighbours_.pass(row.symbol, row.constants == kNone ? own : folded_ + row.constants);
        }
        return true;
    }

private:
    static constexpr std::size_t kWordsPerBlock = 4;

    /// Applies the first production that matches. Returns false on a fault.
    [[gnu::always_inline]] bool visit(const SweepProgram::Row& row, float* own) {
        machine_.set_base(kOwnBase, own);
        const SweepCandidate* const first = candidates_ + row.candidates.first;
        const SweepCandidate* const end = first + row.candidates.count;
        for (const SweepCandidate* each = first; each != end; ++each) {
            if (!matches_context(*each)) {
                continue;
            }
            if (each->is_certain) {
                return write(*each, own);
            }
            bool holds = true;
            if (!condition(*each, holds)) {
                return false;
            }
            if (holds) {
                if (each->outcomes.count != 0) {
                    each = candidates_ + outcome(*each);
                } else if (each->is_stochastic && !choose_among(each, end)) {
                    return false;
                }
                return each == nullptr || write(*each, own);
            }
        }
        return true;
    }

    [[gnu::always_inline]] bool matches_context(const SweepCandidate& candidate) {
        if (candidate.kind == SweepCandidate::Context::None) {
            return true;
        }
        if (candidate.kind == SweepCandidate::Context::Items) {
            return matches_items(candidate);
        }
        const float* parameters = nullptr;
        if (!neighbours_.is_nearest(candidate.module.symbol, parameters)) {
            return false;
        }
        machine_.set_base(candidate.module.base, parameters);
        return true;
    }

    /// matches_context() for Context::Items.
    [[gnu::always_inline]] bool matches_items(const SweepCandidate& candidate) {
        const SweepItem* item = program_.items() + candidate.context.first;
        const SweepItem* const end = item + candidate.context.count;
        std::uint32_t list = neighbours_.here();
        lists_.clear();
        for (; item != end; ++item) {
            if (item->kind == PatternKind::Close) {
                list = lists_.back();
                lists_.pop_back();
                continue;
            }
            const bool is_branch = item->kind == PatternKind::Open;
            list = is_branch ? list : neighbours_.module_of(list);
            if (list == SweepNeighbours::kEnd) {
                return false;
            }
            const SweepNeighbours::Cell& cell = neighbours_.cell(list);
            if (cell.symbol != (is_branch ? kNoSymbol : item->symbol)) {
                return false;
            }
            if (is_branch) {
                lists_.push_back(cell.rest);
                list = cell.inner;
            } else {
                machine_.set_base(item->base, cell.parameters);
                list = cell.rest;
            }
        }
        return true;
    }

    /// Sets `holds` to whether the condition of a candidate holds. Returns false on a fault.
    [[nodiscard]] bool condition(const SweepCandidate& candidate, bool& holds) {
        if (candidate.condition == kNone) {
            return true;
        }
        const float value = machine_.run(operations_ + candidate.condition);
        holds = value != 0.0F;
        return std::isfinite(value);
    }

    /// The candidate that a random choice with SweepCandidate::outcomes takes.
    [[nodiscard]] std::uint32_t outcome(const SweepCandidate& candidate) const;
    /// The draw that chooses among the productions of a rule.
    [[nodiscard]] float choice_draw(std::uint32_t rule) const;

    /// Replaces `chosen`, the first candidate that matches, by a random one of its group, or by
    /// nullptr if all weights are 0. Returns false on a fault.
    [[nodiscard]] bool choose_among(const SweepCandidate*& chosen, const SweepCandidate* end);

    /// Computes all values before it stores the first, because they may read each other.
    [[gnu::always_inline]] bool write(const SweepCandidate& candidate, float* own) {
        const float result = machine_.run(operations_ + candidate.successor);
        if (machine_.is_faulty()) {
            return false;
        }
        if (candidate.value_count == 1) {
            if (!std::isfinite(result)) {
                return false;
            }
            *own = result;
            return true;
        }
        return write_several(candidate.value_count, own);
    }

    [[nodiscard]] bool write_several(std::uint32_t count, float* own) const;

    /// A candidate that matches, and its weight.
    struct Matching {
        const SweepCandidate* candidate = nullptr;
        float weight = 0.0F;
    };

    const Plan& plan_;
    const SweepProgram& program_;
    const PassKeys& keys_;
    const float* folded_; // parameters of folded modules
    const SweepCandidate* candidates_;
    const SweepOperation* operations_;
    SweepMachine machine_;
    SweepNeighbours neighbours_;
    std::vector<std::uint32_t> lists_; // matches_items(): the list after each branch entered
    std::vector<float> units_;         // draws of the next modules, see SweepCode::draw_blocks
    std::size_t lane_ = 0;             // in units_, of the next module that draws
    std::vector<Matching> matching_;   // used by choose_among()
};

} // namespace lsys
