// SPDX-License-Identifier: MIT
// EditHistory: earlier and undone values of settings, for undo and redo.
#pragma once

#include <utility>
#include <vector>

namespace lsys::view {

template <typename Value>
class EditHistory {
public:
    explicit EditHistory(Value value) : current_(std::move(value)) {}

    /// Makes `value` the current value. If it differs from the previous value, the change becomes a
    /// step of undo(). Returns whether it became a step.
    bool record(const Value& value) {
        if (value == current_) {
            return false;
        }
        earlier_.push_back(std::exchange(current_, value));
        undone_.clear();
        return true;
    }
    /// The current value. Changes through this reference do not become steps.
    [[nodiscard]] Value& current() { return current_; }

    [[nodiscard]] bool can_undo() const { return !earlier_.empty(); }
    [[nodiscard]] bool can_redo() const { return !undone_.empty(); }
    /// Undoes the last step and returns the value before it. Precondition: can_undo().
    const Value& undo() { return move_step(earlier_, undone_); }
    /// Repeats the step that was undone last. Precondition: can_redo().
    const Value& redo() { return move_step(undone_, earlier_); }

private:
    const Value& move_step(std::vector<Value>& from, std::vector<Value>& to) {
        to.push_back(std::exchange(current_, std::move(from.back())));
        from.pop_back();
        return current_;
    }

    Value current_;
    std::vector<Value> earlier_; // oldest first
    std::vector<Value> undone_;  // the step that was undone first comes first
};

} // namespace lsys::view
