// SPDX-License-Identifier: MIT
#include "runtime/pipeline/constant_text.h"

#include "grammar/base/blanks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace lsys {

namespace {

/// The `//` comment that follows `place` on the same line, after at most one `;`. Empty: none.
std::string_view comment_after(std::string_view text, std::size_t place) {
    const std::string_view rest = text.substr(place, text.find_first_of("\r\n", place) - place);
    const std::size_t mark = rest.find("//");
    if (mark == std::string_view::npos) {
        return {};
    }
    const std::string_view before = rest.substr(0, mark);
    return std::count(before.begin(), before.end(), ';') <= 1
               ? without_blanks(rest.substr(mark + 2))
               : std::string_view();
}

} // namespace

std::string_view comment_of(const Constant& constant, const Grammar& grammar) {
    return constant.span.file == kNoFile
               ? std::string_view()
               : comment_after(grammar.sources->file(constant.span.file).text(), constant.span.end);
}

std::string describe_constant(const Constant& constant, const Grammar& grammar, bool is_replaced) {
    std::string text(comment_of(constant, grammar));
    text += text.empty() ? "" : "\n";
    text += constant.is_random ? "random in each run"
            : is_replaced ? fmt::format("{:g} instead of the value in the file", constant.value)
                          : fmt::format("{:g} in the file", constant.value);
    if (constant.is_param) {
        text += fmt::format("; from {:g} to {:g}", constant.minimum, constant.maximum);
    }
    return text;
}

} // namespace lsys
