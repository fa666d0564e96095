// SPDX-License-Identifier: MIT
// Conversion of queries and answers of environments whose answers come from functions of the
// caller.
#pragma once

#include "runtime/environment/environment.h"

#include <cstddef>
#include <cstdint>
#include <lsys/project.h>
#include <optional>
#include <vector>

namespace lsys::v0 {

/// The query about the places of a word. The result refers to the data of `word`.
[[nodiscard]] EnvironmentQuery query_of(const SensedWord& word);

/// Converts the answers to `count` places to those of an Environment. `answers` receives all
/// numbers, `sizes` the count of numbers per place. Returns a failure if the answers are too few or
/// too many, or if the function gave a reason for not answering.
[[nodiscard]] std::optional<EnvironmentFailure> take_answers(const EnvironmentAnswers& given,
                                                             std::size_t count,
                                                             std::vector<float>& answers,
                                                             std::vector<std::uint32_t>& sizes);

} // namespace lsys::v0
