// Evaluation of bytecode expressions before a derivation, where some values are known and others
// are not. Read by the growth analysis and by the checks of conditions. A result that is known is
// exactly the value the runtime computes.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::analysis {

struct KnownValue {
    float value = 0.0F;
    bool known = false;
};

/// What an expression can see. Formals beyond the span are not known.
struct Surroundings {
    std::span<const KnownValue> formals;
    std::optional<std::uint32_t> step;  // the age of the word being rewritten
    std::optional<std::uint32_t> steps; // the number of generations asked for
};

/// Runs expressions; keeps its stack from run to run.
class Evaluator {
public:
    /// Runs `instructions` from `first` up to and with the next Emit or Test, or up to End.
    /// Afterwards next() is where to go on.
    KnownValue run(std::span<const std::uint32_t> instructions,
                   std::uint32_t first,
                   const Surroundings& surroundings);
    /// Runs the instructions [first, last), which make one value.
    KnownValue run_part(std::span<const std::uint32_t> instructions,
                        TableRange part,
                        const Surroundings& surroundings);
    [[nodiscard]] std::uint32_t next() const { return next_; }
    /// Instructions run so far.
    [[nodiscard]] std::uint64_t work() const { return work_; }

private:
    void execute(std::span<const std::uint32_t> instructions,
                 std::uint32_t& at,
                 const Surroundings& surroundings);

    std::vector<KnownValue> stack_;
    std::uint32_t next_ = 0;
    std::uint64_t work_ = 0;
};

/// The words an instruction takes: 1, or 2 with a literal.
[[nodiscard]] constexpr std::uint32_t instruction_length(Opcode opcode) {
    return opcode == Opcode::Literal ? 2 : 1;
}
[[nodiscard]] constexpr Opcode opcode_of(std::uint32_t instruction) {
    return static_cast<Opcode>(instruction & 0xFFU);
}
[[nodiscard]] constexpr std::uint32_t operand_of(std::uint32_t instruction) {
    return instruction >> 8;
}

} // namespace lsys::analysis
