// SPDX-License-Identifier: MIT
// SweepRun: one sweep of a word.
#pragma once

#include "runtime/derive/engine/sweep_visitor.h"
#include "runtime/derive/word.h"

#include <algorithm>
#include <array>
#include <cstdint>

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
        : visitor_(plan, program, keys), codes_(word.codes), parameters_(parameters),
          rows_(program.rows().data()), draws_(!program.draw_blocks().empty()) {}

    /// Visits the modules from `place` up to `end`. On a fault returns false, with its module in
    /// `place`.
    [[nodiscard]] bool up(ModulePlace& place, std::uint64_t end) {
        while (place.index < end) {
            const std::uint64_t stop =
                !draws_ ? end : std::min<std::uint64_t>(end, place.index + kSweepLanes);
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
                place.index - (!draws_ ? count : std::min<std::uint64_t>(count, kSweepLanes));
            draw_for(place.index - stop, [&](std::uint64_t i) { return place.index - 1 - i; });
            if (!down_to(place, stop)) {
                return false;
            }
        }
        return true;
    }

private:
    /// Makes the draws of the next `count` modules, which are at index_of(0), index_of(1), ...
    template <typename IndexOf>
    void draw_for(std::uint64_t count, IndexOf index_of) {
        if (!draws_) {
            return;
        }
        std::size_t lanes = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            positions_[lanes] = index_of(i);
            lanes += rows_[codes_[positions_[lanes]]].draws ? 1U : 0U;
        }
        visitor_.draw(positions_.data(), lanes);
    }

    /// up() for modules whose draws are made.
    [[nodiscard]] bool up_to(ModulePlace& at, std::uint64_t end) {
        ModulePlace place = at; // a copy stays in registers
        bool ok = true;
        for (; ok && place.index < end; ++place.index) {
            const SweepProgram::Row& row = rows_[codes_[place.index]];
            if (row.role < ContextRole::Open) {
                ok = visitor_.pass(row, parameters_ + place.parameter);
                place.parameter += ok ? row.stored : 0;
            } else if (row.role == ContextRole::Open) {
                visitor_.neighbours().enter_at_begin();
            } else {
                visitor_.neighbours().leave_at_end();
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
                ok = visitor_.pass(row, parameters_ + place.parameter);
            } else if (row.role == ContextRole::Close) {
                visitor_.neighbours().enter_at_end();
            } else {
                visitor_.neighbours().leave_at_begin();
            }
        }
        at = place;
        return ok;
    }

    SweepVisitor visitor_;
    const C* codes_;
    float* parameters_;
    const SweepProgram::Row* rows_; // by code
    bool draws_;                    // whether some production uses random draws
    std::array<std::uint64_t, kSweepLanes> positions_{}; // of the modules that draw
};

} // namespace lsys
