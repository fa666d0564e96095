// SPDX-License-Identifier: MIT
// SweepRun: one sweep of a word. Most of the time of a sweep is spent in pass(), once per module.
#pragma once

#include "runtime/base/random.h"
#include "runtime/derive/engine/choose.h"
#include "runtime/derive/engine/sweep_program.h"
#include "runtime/derive/word.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace lsys {

/// One pass over `word`, whose parameters are `parameters`.
template <typename C>
class SweepRun {
public:
    /// All arguments outlive the object.
    SweepRun(const Plan& plan,
             const SweepProgram& program,
             const PassKeys& keys,
             const WordView<C>& word,
             float* parameters)
        : plan_(plan), program_(program), keys_(keys), codes_(word.codes), parameters_(parameters),
          rows_(program_.rows().data()), candidates_(program_.candidates()),
          items_(program_.items()), operations_(program_.operations()), machine_(plan_.bytecode()),
          neighbours_(program_.reach()), draw_blocks_(program_.draw_blocks()),
          units_(draw_blocks_.size() * kWordsPerBlock * kSweepLanes) {
        program_.prepare(machine_);
    }

    /// Visits the modules from `place` up to `end`. On a fault returns false, with its module in
    /// `place`.
    [[nodiscard]] bool up(ModulePlace& place, std::uint64_t end) {
        while (place.index < end) {
            const std::uint64_t stop =
                draw_blocks_.empty() ? end
                                     : std::min<std::uint64_t>(end, place.index + kSweepLanes);
            draw_for(stop - place.index, [&](std::uint64_t i) { return place.index + i; });
            if (!up_to(place, stop)) {
                return false;
            }
        }
        return true;
    }

    /// Visits the modules before `place` down to `end`. On a fault returns false, with its module
    /// in `place`.
    [[nodiscard]] bool down(ModulePlace& place, std::uint64_t end) {
        while (place.index > end) {
            const std::uint64_t count = place.index - end;
            const std::uint64_t stop =
                place.index -
                (draw_blocks_.empty() ? count : std::min<std::uint64_t>(count, kSweepLanes));
            draw_for(place.index - stop, [&](std::uint64_t i) { return place.index - 1 - i; });
            if (!down_to(place, stop)) {
                return false;
            }
        }
        return true;
    }

private:
    static constexpr std::size_t kWordsPerBlock = 4;

    /// Makes the draws of the next `count` modules, which are at index_of(0), index_of(1), ...
    template <typename IndexOf>
    void draw_for(std::uint64_t count, IndexOf index_of) {
        if (draw_blocks_.empty()) {
            return;
        }
        std::size_t lanes = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            positions_[lanes] = index_of(i);
            lanes += rows_[codes_[positions_[lanes]]].draws ? 1U : 0U;
        }
        lane_ = 0;
        DrawKey key{keys_.seed, keys_.generation, 0, 0};
        float* units = units_.data();
        for (const std::uint32_t block : draw_blocks_) {
            key.block = block;
            draw_all_units(key, positions_.data(), lanes, units, kSweepLanes);
            units += kWordsPerBlock * kSweepLanes;
        }
    }

    /// up() for modules whose draws are made.
    [[nodiscard]] bool up_to(ModulePlace& at, std::uint64_t end) {
        ModulePlace place = at; // a copy stays in registers
        bool ok = true;
        for (; ok && place.index < end; ++place.index) {
            const SweepProgram::Row& row = rows_[codes_[place.index]];
            if (row.role < ContextRole::Open) {
                ok = pass(row, parameters_ + place.parameter);
                place.parameter += ok ? row.stored : 0;
            } else if (row.role == ContextRole::Open) {
                neighbours_.enter_at_begin();
            } else {
                neighbours_.leave_at_end();
            }
        }
        place.index -= ok ? 0 : 1; // back to the module with the fault
        at = place;
        return ok;
    }

    /// down() for modules whose draws are made.
    [[nodiscard]] bool down_to(ModulePlace& at, std::uint64_t end) {
        ModulePlace place = at;
        bool ok = true;
        while (ok && place.index > end) {
            --place.index;
            const SweepProgram::Row& row = rows_[codes_[place.index]];
            if (row.role < ContextRole::Open) {
                place.parameter -= row.stored;
                ok = pass(row, parameters_ + place.parameter);
            } else if (row.role == ContextRole::Close) {
                neighbours_.enter_at_end();
            } else {
                neighbours_.leave_at_begin();
            }
        }
        at = place;
        return ok;
    }

    /// Gives a module its new parameters, and makes it a neighbour of those that follow.
    [[gnu::always_inline]] bool pass(const SweepProgram::Row& row, float* own) {
        if (row.draws) {
            machine_.set_base(kDrawBase, units_.data() + lane_++);
        }
        if (row.candidates.count != 0 && !visit(row, own)) {
            return false;
        }
        if (row.role == ContextRole::Module) {
            neighbours_.pass(row.symbol, row.constants == kNone
                                             ? own
                                             : plan_.bytecode().constants.data() + row.constants);
        }
        return true;
    }

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
    [[nodiscard]] bool matches_items(const SweepCandidate& candidate) {
        const SweepItem* item = items_ + candidate.context.first;
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
    [[nodiscard]] std::uint32_t outcome(const SweepCandidate& candidate) const {
        const SweepOutcome* const first = program_.outcomes() + candidate.outcomes.first;
        std::uint32_t taken = 0;
        if (candidate.outcomes.count > 1) {
            const float u = choice_draw(candidate.rule);
            for (std::uint32_t i = 0; i + 1 < candidate.outcomes.count; ++i) {
                taken += first[i].threshold > u ? 0U : 1U; // thresholds ascend
            }
        }
        return first[taken].candidate;
    }
    /// The draw that chooses among the productions of a rule.
    [[nodiscard]] float choice_draw(std::uint32_t rule) const {
        return plan_.bytecode().settings.choice == ChoiceScope::Generation
                   ? plan_.rule_draw(rule, keys_.generation)
                   : machine_.value(program_.choice_draw());
    }

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
        const float* const values = machine_.values();
        bool is_finite = true;
        for (std::uint32_t i = 0; i < candidate.value_count; ++i) {
            is_finite = is_finite && std::isfinite(values[i]);
        }
        std::copy_n(values, is_finite ? candidate.value_count : 0, own);
        return is_finite;
    }

    const Plan& plan_;
    const SweepProgram& program_;
    const PassKeys& keys_;
    const C* codes_;
    float* parameters_;
    const SweepProgram::Row* rows_; // by code
    const SweepCandidate* candidates_;
    const SweepItem* items_;
    const SweepOperation* operations_;
    SweepMachine machine_;
    SweepNeighbours neighbours_;
    std::vector<std::uint32_t> lists_; // used by matches_context(): after the branches entered
    const std::vector<std::uint32_t>& draw_blocks_;
    std::vector<float> units_; // draws of the next modules, see SweepCode::draw_blocks
    std::array<std::uint64_t, kSweepLanes> positions_{}; // of the modules that draw
    std::size_t lane_ = 0;                               // of the next module that draws
    /// A candidate that matches, and its weight.
    struct Matching {
        const SweepCandidate* candidate = nullptr;
        float weight = 0.0F;
    };
    std::vector<Matching> matching_; // used by choose_among()
};

// As Chooser::choose_among() chooses: the order of the sums decides their rounding.
template <typename C>
bool SweepRun<C>::choose_among(const SweepCandidate*& chosen, const SweepCandidate* end) {
    matching_.clear();
    for (const SweepCandidate* each = chosen; each != end; ++each) {
        bool holds = each->group == chosen->group && each->is_stochastic;
        if (holds && each != chosen && !condition(*each, holds)) {
            return false;
        }
        if (holds) {
            matching_.push_back({each, each->weight});
        }
    }
    float sum = 0.0F;
    for (Matching& each : matching_) {
        if (each.candidate->weight_code != kNone) {
            each.weight = machine_.run(operations_ + each.candidate->weight_code);
        }
        sum += each.weight;
        if (!std::isfinite(sum) || each.weight < 0.0F) {
            return false;
        }
    }
    std::erase_if(matching_, [](const Matching& each) { return each.weight == 0.0F; });
    chosen = matching_.empty() ? nullptr : matching_.front().candidate;
    if (matching_.size() <= 1) {
        return true; // without a weight above 0 the module counts as not matched
    }
    const float u = choice_draw(chosen->rule);
    float cumulative = 0.0F;
    for (const Matching& each : matching_) {
        chosen = each.candidate;
        cumulative += each.weight / sum;
        if (cumulative > u) {
            break;
        }
    }
    return true;
}

} // namespace lsys
