// SPDX-License-Identifier: MIT
// The general evaluator of conditions and arguments: a stack machine over Bytecode instructions.
// It can evaluate every expression; the common forms are also evaluated faster, with equal results,
// by shape.h.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/random.h"

#include <cstdint>

namespace lsys {

/// Inputs of an expression besides random ranges.
struct EvalFrame {
    const float* formals = nullptr;
    const float* globals = nullptr;
    float step = 0.0F;  // age of the word being rewritten
    float steps = 0.0F; // number of generations of the derivation
};

/// Number of the draw of branch 0: the first of the four draws of block 2^31.
inline constexpr std::uint64_t kFirstBranchDraw = std::uint64_t{4} << 31;

/// Source of the draws of random ranges: one module, or the start of the derivation.
class RangeDraws {
public:
    /// Range i is draw `first + i` of the module.
    [[nodiscard]] static RangeDraws of_module(std::uint64_t seed,
                                              std::uint32_t generation,
                                              std::uint64_t position,
                                              std::uint64_t first) {
        return {seed, generation, position, first};
    }
    /// Range i is draw 0 at position `position + i` in generation kStartGeneration.
    [[nodiscard]] static RangeDraws at_start(std::uint64_t seed, std::uint32_t position) {
        return {seed, kStartGeneration, position, 0};
    }
    /// The draw of range number `range`, as u in [0, 1).
    [[nodiscard]] float draw(std::uint32_t range);
    /// The draw that decides whether a recorded branch replaces branch `branch` of the module's
    /// successor (instancing). These draws have blocks of their own, from block 2^31 on.
    [[nodiscard]] float draw_branch(std::uint32_t branch);

private:
    RangeDraws(std::uint64_t seed,
               std::uint32_t generation,
               std::uint64_t position,
               std::uint64_t first)
        : source_(seed, generation, position), seed_(seed), position_(position), first_(first),
          generation_(generation) {}

    DrawSource source_;
    std::uint64_t seed_;
    std::uint64_t position_;
    std::uint64_t first_; // number of the draw of range 0
    std::uint32_t generation_;
};

/// The enumerators of RuntimeErrorKind that an evaluation can cause.
enum class Fault : std::uint8_t {
    None,
    NotFinite,
    RangeReversed,
    RangeTooWide,
    BadDistribution,
    NegativeWeight,
    WeightsTooLarge
};

/// The fault that stopped an evaluation, and its instruction.
struct EvalFault {
    Fault kind = Fault::None;
    std::uint32_t instruction = 0; // index in Bytecode::instructions
    float value = 0.0F;            // for NotFinite and faults of weights
    float first_argument = 0.0F;   // of the range or distribution
    float second_argument = 0.0F;
};

/// The fault of the range `{minimum, maximum}`; None if it can be drawn from.
[[nodiscard]] Fault check_range(float minimum, float maximum);

/// Runs the instructions from `first` to End. Operands of Emit and Test are appended at `out`, in
/// order. On failure returns false with the cause in `fault` and the earlier values in `out`.
/// `draws` may be null if there is no random range, distribution or branch.
[[nodiscard]] bool evaluate(const Bytecode& bytecode,
                            std::uint32_t first,
                            const EvalFrame& frame,
                            RangeDraws* draws,
                            float* out,
                            EvalFault& fault);
/// evaluate() for a word: its local values first, then its arguments.
[[nodiscard]] bool evaluate(const Bytecode& bytecode,
                            const WordTemplate& word,
                            const EvalFrame& frame,
                            RangeDraws* draws,
                            float* out,
                            EvalFault& fault);

} // namespace lsys
