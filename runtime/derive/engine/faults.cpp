// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/faults.h"

#include "compiler/bytecode/instructions.h"
#include "runtime/derive/engine/instantiate.h"
#include "runtime/derive/engine/write.h"

#include <vector>

namespace lsys {

namespace {

RuntimeErrorKind kind_of(Fault fault) {
    switch (fault) {
    case Fault::RangeReversed:
        return RuntimeErrorKind::RangeReversed;
    case Fault::RangeTooWide:
        return RuntimeErrorKind::RangeTooWide;
    case Fault::BadDistribution:
        return RuntimeErrorKind::BadDistribution;
    case Fault::NegativeWeight:
        return RuntimeErrorKind::NegativeWeight;
    case Fault::WeightsTooLarge:
        return RuntimeErrorKind::WeightsTooLarge;
    case Fault::None:
    case Fault::NotFinite:
        break;
    }
    return RuntimeErrorKind::NotFinite;
}

} // namespace

RuntimeError error_of(const Bytecode& bytecode, const EvalFault& fault) {
    RuntimeError error;
    error.kind = kind_of(fault.kind);
    error.site = site_of(bytecode, fault.instruction);
    error.value = fault.value;
    error.first_argument = fault.first_argument;
    error.second_argument = fault.second_argument;
    error.opcode = opcode_of(bytecode.instructions[fault.instruction]);
    return error;
}

namespace {

template <typename C>
RuntimeError make_error(const Plan& plan,
                        const PassKeys& keys,
                        const WordView<C>& word,
                        ModulePlace place,
                        const float* own,
                        const Candidate& candidate,
                        const EvalFault& fault,
                        bool in_condition) {
    const Bytecode& bytecode = plan.bytecode();
    RuntimeError error = error_of(bytecode, fault);
    error.production = static_cast<ProductionId>(candidate.production);
    error.generation = keys.generation;
    error.position = word.first_position + place.index;
    error.symbol = bytecode.symbol_of(word.codes[place.index]);
    error.parameters.assign(own, own + bytecode.symbol(error.symbol).parameter_count);
    error.in_condition = in_condition;
    return error;
}

} // namespace

template <typename C>
std::optional<RuntimeError> find_fault(const Plan& plan,
                                       const PassKeys& keys,
                                       const WordView<C>& word,
                                       const ContextTables* contexts,
                                       ModulePlace begin,
                                       std::uint64_t end) {
    Chooser<C> chooser(plan, keys, word, contexts);
    Matcher<C>& matcher = chooser.matcher();
    std::vector<float> values;
    ModulePlace place = begin;
    while (place.index < end) {
        const C code = word.codes[place.index];
        const Row& row = plan.row(code);
        std::uint32_t record = 0;
        if (row.kind != RowKind::Fixed && !chooser.choose(place, row, record)) {
            RuntimeError error =
                make_error(plan, keys, word, place, matcher.own_parameters(place),
                           plan.candidate(chooser.faulty_candidate()), chooser.fault(), true);
            error.in_weight = chooser.fault_in_weight();
            return error;
        }
        const Entry& entry = plan.entries()[record == 0 ? code : row.base + record];
        if (entry.candidate != kNone && (entry.parameter_count != 0 || entry.general)) {
            EvalFault fault;
            values.resize(entry.parameter_count);
            if (!evaluate_entry(plan, keys, matcher, word.first_position + place.index, place,
                                entry, values.data(), fault)) {
                return make_error(plan, keys, word, place, matcher.own_parameters(place),
                                  plan.candidate(entry.candidate), fault, false);
            }
        }
        const std::uint32_t modules = record != 0 ? plan.replaced_modules(entry) : 1;
        for (std::uint32_t i = 0; i < modules; ++i, ++place.index) {
            place.parameter += plan.row(word.codes[place.index]).stored;
        }
    }
    return std::nullopt;
}

#define LSYS_FIND_FAULT(C)                                                                         \
    template std::optional<RuntimeError> find_fault<C>(const Plan&, const PassKeys&,               \
                                                       const WordView<C>&, const ContextTables*,   \
                                                       ModulePlace, std::uint64_t);
LSYS_FOR_CODES(LSYS_FIND_FAULT)
#undef LSYS_FIND_FAULT

} // namespace lsys
