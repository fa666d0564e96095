// SPDX-License-Identifier: MIT
// Tropisms whose strength the word changes: the setting `tropisms` (docs/language.md section 7.9).
// Used by the Turtle and by the SensingTurtle, so that both compute the same axes. The arithmetic
// is binary64, with correctly rounded sines and cosines.
#pragma once

#include "compiler/bytecode/settings.h"
#include "compiler/bytecode/turtle_operation.h"
#include "runtime/turtle/impl/pose.h"
#include "runtime/turtle/impl/sensing_pose.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lsys {

class Tropisms {
public:
    explicit Tropisms(const StepTropisms& settings);

    /// Whether the grammar sets `tropisms`.
    [[nodiscard]] bool any() const { return any_; }
    /// Returns to the strengths of the settings.
    void begin();
    /// Turns the axes before a step.
    void before_step(SensingPose& pose);
    void before_step(Pose& pose);
    /// Turns the axes after a step. `draws`: whether the step draws a segment.
    void after_step(SensingPose& pose, bool draws);
    void after_step(Pose& pose, bool draws);
    /// Executes an operation from SetSusceptibility to KeepTwist.
    void execute(TurtleOperation operation,
                 std::uint32_t argument_count,
                 const float* arguments,
                 SensingPose& pose);
    void execute(TurtleOperation operation,
                 std::uint32_t argument_count,
                 const float* arguments,
                 Pose& pose);
    /// `[` and `]`; may throw std::bad_alloc.
    void save() { stack_.push_back(now_); }
    void restore();

private:
    /// The state that `[` saves.
    struct State {
        std::array<double, std::tuple_size_v<StepTropisms>> strengths{}; // by row
        SensingVector heading{0.0, 1.0, 0.0}; // at the end of the last segment
        SensingVector up{0.0, 0.0, 1.0};
    };

    void turn_heading(SensingPose& pose); // by the tropisms of kind Before
    void twist(SensingPose& pose);        // turns the up axis by the tropisms of kind Twist
    /// Turns up and right with the heading, without twist.
    void untwist(SensingPose& pose) const;
    /// Stores heading and up axis as those at the end of the last segment.
    void keep(const SensingPose& pose);
    /// Index of the row that has number `number`, from 1 on, among the rows of the kinds Before and
    /// Twist; the count of all rows if there is none.
    [[nodiscard]] std::size_t row_of(float number) const;

    StepTropisms rows_; // the rows of the setting
    State now_;
    std::vector<State> stack_;
    bool any_ = false; // any()
};

} // namespace lsys
