// SPDX-License-Identifier: MIT
// Checks whether productions of a stage still match after its max number of passes.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/engine/choose.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Whether the current rows of the plan may rewrite some module of the word.
template <typename C>
[[nodiscard]] bool may_rewrite(const Plan& plan, const WordView<C>& word) {
    const Row* const rows = plan.rows().data();
    for (std::uint64_t i = 0; i < word.count; ++i) {
        if (!rows[word.codes[i]].copies) {
            return true;
        }
    }
    return false;
}

/// The first module that a production matches, or for which a condition has no finite value.
template <typename C>
[[nodiscard]] std::optional<ModulePlace>
find_match(const Plan& plan, Chooser<C>& chooser, const WordView<C>& word) {
    ModulePlace place;
    for (; place.index < word.count; ++place.index) {
        const Row& row = plan.row(word.codes[place.index]);
        if (!row.copies) {
            std::uint32_t record = 0;
            if (row.kind == RowKind::Fixed || !chooser.choose(place, row, record) || record != 0) {
                return place;
            }
        }
        place.parameter += row.stored;
    }
    return std::nullopt;
}

/// The error TooDeep for the module at `place`, which a production still matches.
template <typename C>
[[nodiscard]] RuntimeError too_deep(const Plan& plan,
                                    Chooser<C>& chooser,
                                    const PassKeys& keys,
                                    const WordView<C>& word,
                                    const ModulePlace& place) {
    const Bytecode& bytecode = plan.bytecode();
    const Code code = word.codes[place.index];
    const Row& row = plan.row(code);
    std::uint32_t record = 0;
    const bool chosen = row.kind == RowKind::Fixed || chooser.choose(place, row, record);
    const std::uint32_t candidate =
        chosen ? plan.entries()[record == 0 ? code : row.base + record].candidate
               : chooser.faulty_candidate();
    RuntimeError error;
    error.kind = RuntimeErrorKind::TooDeep;
    error.generation = keys.generation;
    error.position = word.first_position + place.index;
    error.symbol = bytecode.symbol_of(code);
    const float* const own = chooser.matcher().own_parameters(place);
    error.parameters.assign(own, own + bytecode.symbol(error.symbol).parameter_count);
    if (candidate != kNone) {
        const std::uint32_t production = plan.candidate(candidate).production;
        error.production = static_cast<ProductionId>(production);
        error.site = bytecode.productions[production].name_site;
    }
    return error;
}

} // namespace lsys
