// SPDX-License-Identifier: MIT
// Evaluation of expressions before a derivation, where some values are known and others are not.
// Used by the growth analysis and by the checks of conditions. A known result is exactly the value
// that the runtime computes.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/bytecode/verify.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::analysis {

struct KnownValue {
    float value = 0.0F;
    bool known = false;
};

/// Inputs of an expression. Formals beyond the span are not known.
struct ExpressionInputs {
    std::span<const KnownValue> formals;
    std::optional<std::uint32_t> step;  // value of step(): age of the word being rewritten
    std::optional<std::uint32_t> steps; // value of steps(): requested generations
};

/// Runs expressions in the domain of known and unknown values (interpret.h).
class Evaluator {
public:
    /// `stack_depth`, `slots`: the max stack depth and number of slots of the code to run.
    explicit Evaluator(std::size_t stack_depth = kUsualStack, std::size_t slots = 0)
        : stack_(std::max<std::size_t>(stack_depth, 1)), slots_(slots) {}

    /// The value of the expression at `first` up to the next Emit or Test. `locals`: first
    /// instruction of the code that sets the local values, or kNone.
    KnownValue run(std::span<const std::uint32_t> instructions,
                   std::uint32_t first,
                   const ExpressionInputs& inputs,
                   std::uint32_t locals = kNone);
    /// Instructions run so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

private:
    std::vector<KnownValue> stack_;
    std::vector<KnownValue> slots_; // local values
    std::uint64_t work_ = 0;
};

} // namespace lsys::analysis
