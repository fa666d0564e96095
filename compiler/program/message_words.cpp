// SPDX-License-Identifier: MIT
#include "compiler/program/message_words.h"

#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <array>

namespace lsys {

std::string parameters_text(std::uint32_t count) {
    return count == 0   ? std::string("no parameters")
           : count == 1 ? std::string("1 parameter")
                        : fmt::format("{} parameters", count);
}

std::string quoted(std::string_view name) {
    return fmt::format("`{}`", name);
}

std::string number_text(float value) {
    std::array<char, 32> buffer{};
    const auto result = number_to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), result.ptr};
}

} // namespace lsys
