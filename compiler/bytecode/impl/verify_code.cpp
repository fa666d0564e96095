// SPDX-License-Identifier: MIT
#include "compiler/bytecode/impl/verify_code.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

std::optional<std::string>
CodeVerifier::problem(CodePlace place, std::uint32_t first, const CodeBounds& bounds) {
    const std::vector<std::uint32_t>& instructions = bytecode_.instructions;
    if (first != next_instruction_) {
        return fmt::format("the code at {} does not follow the code before it", first);
    }
    const bool numbered_by_pass = (place == CodePlace::Successor || place == CodePlace::Locals) &&
                                  bytecode_.settings.rewriting == RewritingMode::Sequential;
    if (bounds.draws > (numbered_by_pass ? kMaxSequentialDraws : kMaxOperand)) {
        return fmt::format("the code at {} draws {} times", first, bounds.draws);
    }
    std::uint32_t depth = 0;
    std::uint32_t taken_count = 0; // number of values that Emit or Test took
    choices_.clear();
    while (next_instruction_ < instructions.size()) {
        const std::uint64_t at = next_instruction_++;
        const std::uint32_t operand = instructions[at] >> 8;
        if ((instructions[at] & 0xFF) >= kOpcodeCount) {
            return fmt::format("instruction {} does not exist", at);
        }
        const auto opcode = static_cast<Opcode>(instructions[at] & 0xFF);
        const OpcodeInfo& row = info(opcode);
        if (!fits(opcode, operand, bounds) || !allowed(place, opcode)) {
            return fmt::format("instruction {} ({}) is not allowed there", at, row.mnemonic);
        }
        if (row.pops > depth) {
            return fmt::format("instruction {} ({}) lacks values", at, row.mnemonic);
        }
        depth = depth - row.pops + row.pushes;
        if (!choice(opcode, at, operand, depth)) {
            return fmt::format("instruction {} ({}) does not fit its choice", at, row.mnemonic);
        }
        if (opcode == Opcode::Emit || opcode == Opcode::Test) {
            ++taken_count;
        }
        if (opcode == Opcode::End) {
            if (depth == 0 && taken_count == bounds.emits && choices_.empty()) {
                return std::nullopt;
            }
            return fmt::format("the code at {} leaves a wrong number of values", first);
        }
    }
    return fmt::format("the code at {} has no end", first);
}

/// Whether the operand of an instruction is within its limits. Skips the number behind Literal.
bool CodeVerifier::fits(Opcode opcode, std::uint32_t operand, const CodeBounds& bounds) {
    switch (info(opcode).operand) {
    case OperandKind::None:
        return operand == 0;
    case OperandKind::Literal:
        return operand == 0 && next_instruction_++ < bytecode_.instructions.size();
    case OperandKind::Formal:
        return operand < bounds.formals;
    case OperandKind::Global:
        return operand < bytecode_.globals.size() && operand < bounds.globals;
    case OperandKind::Draw:
        return operand < bounds.draws && record_draw(operand);
    case OperandKind::Local:
        return operand < bytecode_.local_count && slot(opcode, operand);
    case OperandKind::Curve:
        return operand < bytecode_.curves.size();
    case OperandKind::Branch:
    case OperandKind::Skip: // choice() checks the operand
        return true;
    }
    return false;
}

/// Records the use of draw `number`. Returns false if this word or constant has used it
/// already. Numbers of draws that constant folding removed stay unused.
bool CodeVerifier::record_draw(std::uint32_t number) {
    draw_is_seen_.resize(std::max<std::size_t>(draw_is_seen_.size(), std::size_t{number} + 1));
    const bool is_first = !draw_is_seen_[number];
    draw_is_seen_[number] = true;
    return is_first;
}

void CodeVerifier::begin_piece() {
    end_slots(0);
    draw_is_seen_.clear();
}

/// Sets the slot if `opcode` is SetLocal; returns whether the slot has a value. Values set in
/// one side of a choice are lost at the end of that side.
bool CodeVerifier::slot(Opcode opcode, std::uint32_t index) {
    is_set_.resize(std::max<std::size_t>(is_set_.size(), std::size_t{index} + 1));
    if (opcode == Opcode::SetLocal && !is_set_[index]) {
        is_set_[index] = true;
        set_slots_.push_back(index);
    }
    return is_set_[index];
}

/// Clears all slots but the `count` that were set first.
void CodeVerifier::end_slots(std::size_t count) {
    for (; set_slots_.size() > count; set_slots_.pop_back()) {
        is_set_[set_slots_.back()] = false;
    }
}

/// Whether an instruction fits the open choices: If skips to the instruction after its Else,
/// Else to the one after its EndIf, each side leaves one value, and Emit and Test are outside
/// of choices. `depth`: stack depth after the instruction.
bool CodeVerifier::choice(Opcode opcode,
                          std::uint64_t at,
                          std::uint32_t operand,
                          std::uint32_t depth) {
    if (opcode == Opcode::If) {
        choices_.push_back({at + operand + 1, depth, set_slots_.size(), false});
        return true;
    }
    if (opcode != Opcode::Else && opcode != Opcode::EndIf) {
        return (opcode != Opcode::Emit && opcode != Opcode::Test) || choices_.empty();
    }
    if (choices_.empty()) {
        return false;
    }
    Choice& open = choices_.back();
    end_slots(open.slots);
    if (opcode == Opcode::Else) {
        const bool fits = !open.has_else && open.next == at + 1 && depth == open.depth + 1;
        open.has_else = true;
        open.next = at + operand + 1;
        return fits;
    }
    const bool fits = open.has_else && open.next == at + 1 && depth == open.depth;
    choices_.pop_back();
    return fits;
}

bool CodeVerifier::allowed(CodePlace place, Opcode opcode) const {
    const bool in_production = place == CodePlace::Condition || place == CodePlace::Locals ||
                               place == CodePlace::Successor;
    switch (opcode) {
    case Opcode::Step:
        return in_production;
    case Opcode::BranchDraw:
        return place == CodePlace::Successor;
    case Opcode::Steps:
        return bytecode_.uses_steps && in_production;
    case Opcode::Emit:
        return place != CodePlace::Condition && place != CodePlace::Locals;
    case Opcode::Test:
        return place == CodePlace::Condition;
    default:
        return true;
    }
}

} // namespace lsys
