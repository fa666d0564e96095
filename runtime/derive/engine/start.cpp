// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/start.h"

#include "compiler/bytecode/instructions.h"
#include "runtime/derive/engine/eval.h"
#include "runtime/derive/engine/faults.h"

namespace lsys {

namespace {

RuntimeError make_error(const Bytecode& bytecode, const EvalFault& fault) {
    RuntimeError error = error_of(bytecode, fault);
    error.generation = kStartGeneration;
    return error;
}

} // namespace

std::optional<RuntimeError>
draw_globals(const Bytecode& bytecode, std::uint64_t seed, std::vector<float>& globals) {
    globals.clear();
    globals.reserve(bytecode.globals.size());
    for (std::uint32_t i = 0; i < bytecode.globals.size(); ++i) {
        const BytecodeGlobal& global = bytecode.globals[i];
        RangeDraws draws = RangeDraws::at_start(seed, global.draw_position);
        const EvalFrame frame{nullptr, globals.data(), 0.0F, 0.0F};
        float value = 0.0F;
        EvalFault fault;
        if (!evaluate(bytecode, global.instruction, frame, &draws, &value, fault)) {
            RuntimeError error = make_error(bytecode, fault);
            error.global = i;
            return error;
        }
        if (global.has_bounds && !(global.minimum <= value && value <= global.maximum)) {
            RuntimeError error;
            error.kind = RuntimeErrorKind::OutOfBounds;
            error.generation = kStartGeneration;
            error.site = global.site;
            error.value = value;
            error.global = i;
            return error;
        }
        globals.push_back(value);
    }
    return std::nullopt;
}

const BytecodeAxiom& chosen_axiom(const Bytecode& bytecode, std::uint64_t seed) {
    constexpr std::uint64_t kPosition = ~std::uint64_t{0};
    const std::vector<BytecodeAxiom>& axioms = bytecode.axioms;
    if (axioms.size() == 1) {
        return axioms.front();
    }
    float sum = 0.0F;
    for (const BytecodeAxiom& axiom : axioms) {
        sum += axiom.weight;
    }
    const float u = unit_interval(draw_block(seed, kStartGeneration, kPosition, 0)[0]);
    float cumulative = 0.0F;
    for (const BytecodeAxiom& axiom : axioms) {
        cumulative += axiom.weight / sum;
        if (cumulative > u) {
            return axiom;
        }
    }
    return axioms.back();
}

std::optional<RuntimeError> axiom_parameters(const Bytecode& bytecode,
                                             std::uint64_t seed,
                                             const std::vector<float>& globals,
                                             std::vector<float>& parameters) {
    const BytecodeAxiom& chosen = chosen_axiom(bytecode, seed);
    const WordTemplate& axiom = chosen.word;
    parameters.assign(axiom.parameter_count, 0.0F);
    if (axiom.arguments == kNone) {
        return std::nullopt;
    }
    RangeDraws draws = RangeDraws::at_start(seed, chosen.draw_position);
    const EvalFrame frame{nullptr, globals.data(), 0.0F, 0.0F};
    EvalFault fault;
    if (evaluate(bytecode, axiom.arguments, frame, &draws, parameters.data(), fault)) {
        return std::nullopt;
    }
    RuntimeError error = make_error(bytecode, fault);
    std::uint32_t emitted = 0; // parameters evaluated before the fault
    for (const Instruction each :
         InstructionRange(bytecode.instructions, axiom.arguments, fault.instruction)) {
        emitted += each.opcode == Opcode::Emit ? 1 : 0;
    }
    std::uint32_t stored = 0;
    for (std::uint32_t i = 0; i < axiom.codes.count; ++i) {
        const Code code = bytecode.template_codes[axiom.codes.first + i];
        const std::uint32_t count = bytecode.stored_parameters(code);
        if (emitted < stored + count) {
            error.position = i;
            error.symbol = bytecode.symbol_of(code);
            break;
        }
        stored += count;
    }
    return error;
}

} // namespace lsys
