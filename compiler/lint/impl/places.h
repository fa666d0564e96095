// SPDX-License-Identifier: MIT
// Places that a Program does not store, found again in the source text for messages.
#pragma once

#include "compiler/lint/checks.h"
#include "compiler/program/message_words.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// The place of module `index` of Program::modules with its arguments. Precondition, here and
/// below: the module belongs to `word`.
[[nodiscard]] SourceSpan
module_span(const CheckInput& input, const ProgramWord& word, std::size_t index);

/// The places of the arguments of module `index`.
[[nodiscard]] std::vector<SourceSpan>
argument_spans(const CheckInput& input, const ProgramWord& word, std::size_t index);

/// Whether the condition is a number between 0 and 1, which is meant as a probability.
[[nodiscard]] bool is_meant_as_probability(const CheckInput& input, const Production& production);

/// The place of an item of a context or predecessor.
[[nodiscard]] SourceSpan item_span(const Production& production, const ProgramPatternItem& item);

/// "(0, 0, 0, 0)": first values for an answer of `count` numbers.
[[nodiscard]] std::string zero_arguments(std::uint32_t count);

} // namespace lsys
