// SPDX-License-Identifier: MIT
// The forms of an expression that need no stack machine, found by abstract interpretation
// (compiler/bytecode/interpret.h): constants, one parameter times a factor plus an offset, and
// conjunctions of comparisons of such values, written with && or if(). They yield the same binary32
// values as evaluate(). Made when a derivation is prepared, read by the passes.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// input * scale + offset, in two roundings. A plain factor has offset -0, which changes nothing;
/// a plain sum has scale 1; so one form fits `x`, `x * 1.1`, `x - 1`, `-x` and `2 * x + 1` exactly.
struct AffineTerm {
    std::uint32_t input = 0; // index among the module's own parameters
    float scale = 1.0F;
    float offset = -0.0F;
};

/// `own`: the parameters of the module, also in holds().
[[nodiscard]] inline float value_of(const AffineTerm& term, const float* own) {
    return own[term.input] * term.scale + term.offset;
}

/// An affine term compared with a constant.
struct Comparison {
    static constexpr std::uint32_t kLess = 1;
    static constexpr std::uint32_t kEqual = 2;
    static constexpr std::uint32_t kGreater = 4;

    AffineTerm affine;
    float bound = 0.0F;         // the constant; never NaN
    std::uint32_t accepted = 0; // bits kLess, kEqual, kGreater of the results that hold
};

[[nodiscard]] inline bool holds(const Comparison& comparison, const float* own) {
    const float value = value_of(comparison.affine, own);
    const std::uint32_t order = value < comparison.bound    ? Comparison::kLess
                                : value == comparison.bound ? Comparison::kEqual
                                                            : Comparison::kGreater;
    return (order & comparison.accepted) != 0;
}

/// Inputs of an expression that are known while its shapes are found.
struct ShapeKnowledge {
    std::uint32_t own_first = 0;             // the first formal of the module's own parameters
    std::uint32_t own_count = 0;             // number of own parameters; other formals are unknown
    const float* folded_arguments = nullptr; // null: a stored module, values unknown
    const float* globals = nullptr;
    std::optional<float> step; // value of step(); none: unknown
    float steps = 0.0F;        // value of steps()
};

enum class ShapeKind : std::uint8_t { Constant, Affine, Comparisons, Other };

/// The shape of a value that an Emit or Test instruction takes.
struct ValueShape {
    ShapeKind kind = ShapeKind::Other;
    float constant = 0.0F;               // Constant; may be infinite or not a number
    AffineTerm affine;                   // Affine
    std::vector<Comparison> comparisons; // all must hold
};

inline constexpr std::uint32_t kMaxShapedInstructions = 4096;
/// The shapes of the values of the expression at `first`, in order; an empty list for expressions
/// longer than kMaxShapedInstructions. `locals`: the code that computes local values before it, or
/// kNone.
[[nodiscard]] std::vector<ValueShape> shapes_of(const Bytecode& bytecode,
                                                std::uint32_t locals,
                                                std::uint32_t first,
                                                const ShapeKnowledge& knowledge);

/// Whether the expression at `first` contains `opcode`; false for kNone.
[[nodiscard]] bool contains(const Bytecode& bytecode, std::uint32_t first, Opcode opcode);
/// Whether the arguments of a word or its local values contain `opcode`.
[[nodiscard]] bool contains(const Bytecode& bytecode, const WordTemplate& word, Opcode opcode);
/// Whether the parameters that a successor stores depend on random numbers.
[[nodiscard]] bool has_random_parameters(const Bytecode& bytecode, const WordTemplate& successor);
/// Whether the expression at `first` (kNone: none) uses a formal outside [begin, end).
[[nodiscard]] bool uses_formal_outside(const Bytecode& bytecode,
                                       std::uint32_t first,
                                       std::uint32_t begin,
                                       std::uint32_t end);

} // namespace lsys
