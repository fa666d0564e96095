// SPDX-License-Identifier: MIT
// Queries and answers of environments that functions of the caller answer.
#pragma once

#include "runtime/environment/environment.h"

#include <cstddef>
#include <cstdint>
#include <lsys/project.h>
#include <optional>
#include <vector>

namespace lsys::v0 {

/// The query about the places of a word. It views the word.
[[nodiscard]] EnvironmentQuery query_of(const SensedWord& word);

/// Converts the answers to `count` places to those of an Environment. Returns a failure if they are
/// too few or too many, or if the function gave a reason for not answering.
[[nodiscard]] std::optional<EnvironmentFailure> take_answers(const EnvironmentAnswers& given,
                                                             std::size_t count,
                                                             std::vector<float>& answers,
                                                             std::vector<std::uint32_t>& sizes);

} // namespace lsys::v0
