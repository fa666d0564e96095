// SPDX-License-Identifier: MIT
// SweepMachine: computes the values of a production for one module. It is an accumulator machine:
// an operation computes a new result from the result so far and up to two operands, each of which
// is a parameter of a module, a constant, a random draw, or a value stored in a slot. A choice
// computes both sides and takes one, because a processor predicts jumps that depend on parameters
// badly. Each operation is a function that ends with a call of the next operation's function, a
// tail call, so that the processor predicts each jump by itself (threaded code, Bell 1973).
// sweep_compiler.h makes the operations.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace lsys {

/// Arrays that operands are read from: the module's own parameters, the constants, the draws of the
/// module, the slots, then the parameters of each module of the context.
inline constexpr std::uint32_t kOwnBase = 0;
inline constexpr std::uint32_t kConstantBase = 1;
inline constexpr std::uint32_t kDrawBase = 2;
inline constexpr std::uint32_t kSlotBase = 3;
inline constexpr std::uint32_t kFirstContextBase = 4;

struct SweepOperand {
    std::uint32_t base = kConstantBase;
    std::uint32_t index = 0;
};

class SweepMachine;
struct SweepOperation;
/// Computes the result of the operation at `at` from the result so far, and goes on with the next.
/// `bases`: the arrays that operands are read from.
using SweepFunction = float (*)(const SweepOperation* at,
                                float result,
                                const float* const* bases,
                                SweepMachine& machine);

struct SweepOperation {
    SweepFunction run = nullptr;
    SweepOperand x;
    SweepOperand y;
    Opcode opcode = Opcode::End; // the opcode, if `run` serves several opcodes
};

/// Functions of operations; r is the result so far.
namespace sweep_functions {
[[nodiscard]] SweepFunction load();   // x
[[nodiscard]] SweepFunction store();  // r, which is also stored in slot x.index
[[nodiscard]] SweepFunction emit();   // r, which is also value x.index of the production
[[nodiscard]] SweepFunction end();    // r is the result of the run
[[nodiscard]] SweepFunction pause();  // r; SweepMachine::run() goes on
[[nodiscard]] SweepFunction choose(); // x if r is not 0, else y
[[nodiscard]] SweepFunction mix();    // mix(x, y, r)
[[nodiscard]] SweepFunction curve();  // the value at r of curve x.index
[[nodiscard]] SweepFunction check();  // r; a fault if y, the guard of a draw, is not 0 and
                                      // the draw opcode(x, r) has invalid arguments
[[nodiscard]] SweepFunction range();  // a draw of the range [x, r), with y as u in [0, 1)
[[nodiscard]] SweepFunction draw();   // a draw of the distribution opcode(x, r), with y as u
[[nodiscard]] SweepFunction unary(Opcode opcode);   // opcode(r)
[[nodiscard]] SweepFunction binary(Opcode opcode);  // opcode(r, x)
[[nodiscard]] SweepFunction swapped(Opcode opcode); // opcode(x, r)
[[nodiscard]] SweepFunction both(Opcode opcode);    // opcode(x, y)
} // namespace sweep_functions

class SweepMachine {
public:
    explicit SweepMachine(const Bytecode& bytecode) : bytecode_(bytecode) {}

    /// Makes room for `base_count` bases, `slot_count` slots and `value_count` values.
    void reserve(std::size_t base_count, std::size_t slot_count, std::size_t value_count) {
        bases_.resize(base_count);
        slots_.resize(slot_count);
        values_.resize(value_count);
        bases_[kSlotBase] = slots_.data();
    }
    void set_base(std::uint32_t base, const float* values) { bases_[base] = values; }
    [[nodiscard]] float value(SweepOperand operand) const {
        return bases_[operand.base][operand.index];
    }
    /// The values that the last run emitted.
    [[nodiscard]] const float* values() const { return values_.data(); }
    /// Whether a draw was invalid in any run.
    [[nodiscard]] bool is_faulty() const { return faulty_; }

    /// Runs the operations from `at`; returns the last result.
    [[nodiscard]] float run(const SweepOperation* at) {
        float result = at->run(at, 0.0F, bases_.data(), *this);
        while (paused_ != nullptr) {
            at = std::exchange(paused_, nullptr);
            result = at->run(at, result, bases_.data(), *this);
        }
        return result;
    }

private:
    friend struct SweepSteps; // the functions of operations

    const Bytecode& bytecode_;
    std::vector<const float*> bases_;
    std::vector<float> slots_;
    std::vector<float> values_;
    const SweepOperation* paused_ = nullptr; // where to go on after a pause
    bool faulty_ = false;
};

} // namespace lsys
