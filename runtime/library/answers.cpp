// SPDX-License-Identifier: MIT
#include "runtime/library/impl/answers.h"

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <type_traits>

namespace lsys::v0 {

// The public SensePlace has the layout of the pipeline's SensePlace.
static_assert(sizeof(SensePlace) == sizeof(::lsys::SensePlace));
static_assert(alignof(SensePlace) == alignof(::lsys::SensePlace));
static_assert(offsetof(SensePlace, position) == offsetof(::lsys::SensePlace, position));
static_assert(offsetof(SensePlace, heading) == offsetof(::lsys::SensePlace, heading));
static_assert(offsetof(SensePlace, up) == offsetof(::lsys::SensePlace, up));
static_assert(std::is_standard_layout_v<SensePlace> && std::is_trivially_copyable_v<SensePlace>);

EnvironmentQuery query_of(const SensedWord& word) {
    return {word.generation,
            {reinterpret_cast<const SensePlace*>(word.places.data()), word.places.size()},
            word.parameters,
            word.first};
}

std::optional<EnvironmentFailure> take_answers(const EnvironmentAnswers& given,
                                               std::size_t count,
                                               std::vector<float>& answers,
                                               std::vector<std::uint32_t>& sizes) {
    EnvironmentFailure failure;
    if (!given.failure.empty()) {
        failure.text = fmt::format("its function has failed: {}", given.failure);
        return failure;
    }
    const std::size_t numbers = given.numbers.size();
    const bool fits =
        given.size == 0 ? numbers == 0 : numbers / given.size == count && numbers % given.size == 0;
    if (!fits || given.size > std::numeric_limits<std::uint32_t>::max()) {
        failure.text = fmt::format("its function answered {} numbers to {} queries, {} for each",
                                   numbers, count, given.size);
        return failure;
    }
    answers.resize(numbers);
    for (std::size_t i = 0; i < numbers; ++i) {
        answers[i] = static_cast<float>(given.numbers[i]) + 0.0F; // -0 becomes 0
    }
    sizes.assign(count, static_cast<std::uint32_t>(given.size));
    return std::nullopt;
}

} // namespace lsys::v0
