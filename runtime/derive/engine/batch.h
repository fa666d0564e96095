// SPDX-License-Identifier: MIT
// Batches: parameters that need the stack machine, evaluated for 64 modules of a production at
// once. Each value of the machine is a row of 64 numbers, so an instruction is decoded once per
// batch and computed with vector instructions. Rows hold the same binary32 values that evaluate()
// in eval.h computes. The writing pass adds modules to batches and leaves gaps in the word for
// their parameters. A batch writes the parameters when it is full or when the pass ends.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys {

/// Modules per batch.
inline constexpr std::size_t kLanes = 64;

/// One value of the stack machine for each module of a batch.
struct alignas(64) Lanes {
    std::array<float, kLanes> values;
};

/// A production whose parameters are computed in batches, with the number of rows it needs.
struct BatchProgram {
    std::uint32_t production = 0;
    std::vector<std::uint32_t> formals; // formals that are read, ascending
    // Rows, in this order:
    std::uint32_t formal_rows = 0;  // one more than the highest formal that is read
    std::uint32_t stack_rows = 0;   // max depth of the stack
    std::uint32_t slot_rows = 0;    // slots of local values
    std::uint32_t choice_draws = 0; // 1 if draw 0 of the module chooses the production
    bool gathers = false;           // formals come from several modules and must be copied
};

/// The program of a production; none if it would need too many rows.
[[nodiscard]] std::optional<BatchProgram>
batch_program(const Bytecode& bytecode, std::uint32_t production, bool gathers);

/// Inputs that all modules of a pass share.
struct BatchInputs {
    const float* globals = nullptr;
    float steps = 0.0F; // value of steps()
    std::uint64_t seed = 0;
    std::uint32_t generation = 0;
    std::uint64_t first_draw = 0; // number of the first draw of each module
};

/// The modules of a batch, by lane.
struct BatchModules {
    std::array<const float*, kLanes> formals;
    std::array<std::uint64_t, kLanes> positions;
    std::array<float*, kLanes> out; // parameters to write
};

/// Refers to the plan and to the inputs of the pass; each thread has its own object.
class Batches {
public:
    Batches(const Bytecode& bytecode,
            const std::vector<BatchProgram>& programs,
            const BatchInputs& inputs)
        : bytecode_(bytecode), programs_(programs), inputs_(inputs), queues_(programs.size()) {}

    /// Adds a module to the batch of program `index`. Its parameters are written to `out` at the
    /// latest by finish(); until then `formals` must stay valid, unless the program gathers formals
    /// (BatchProgram).
    [[gnu::always_inline]] void
    add(std::uint32_t index, const float* formals, std::uint64_t position, float* out) {
        Queue& queue = queues_[index];
        if (queue.count == kLanes) {
            make_room(index);
        }
        const std::size_t lane = queue.count++;
        queue.modules->formals[lane] = formals;
        queue.modules->positions[lane] = position;
        queue.modules->out[lane] = out;
    }
    /// add() for a program that gathers formals: copies them.
    void add_copy(std::uint32_t index, const float* formals, std::uint64_t position, float* out);
    /// Runs all unfinished batches. Returns false if a random range or distribution of any added
    /// module is invalid. Parameters may still be infinite or not a number.
    [[nodiscard]] bool finish();

private:
    struct Queue {
        std::size_t count = kLanes;            // kLanes, as if full, until `modules` exists
        std::unique_ptr<BatchModules> modules; // null until a module is added
        std::vector<float> copies;             // formals, if the program gathers them
    };

    /// Allocates the first batch of a program, or runs its full batch.
    void make_room(std::uint32_t index);
    /// Runs the batch of a program and empties it.
    void run(std::uint32_t index);
    /// Evaluates the modules of a small batch one after the other.
    void run_each(const BatchProgram& program, const BatchModules& modules, std::size_t count);

    const Bytecode& bytecode_;
    const std::vector<BatchProgram>& programs_;
    BatchInputs inputs_;
    std::vector<Queue> queues_; // by program
    std::vector<Lanes> rows_;   // rows of the program that runs
    bool faulty_ = false;       // some random range or distribution was invalid
};

} // namespace lsys
