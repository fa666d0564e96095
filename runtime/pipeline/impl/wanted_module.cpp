// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/wanted_module.h"

#include "grammar/base/blanks.h"
#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <cmath>

namespace lsys {

namespace {

/// A name without its back quotes.
std::string name_in(std::string_view text) {
    text = without_blanks(text);
    const bool quoted = text.size() > 2 && text.front() == '`' && text.back() == '`';
    return std::string(quoted ? text.substr(1, text.size() - 2) : text);
}

} // namespace

Result<WantedModule> parse_wanted_module(std::string_view text, bool has_values) {
    const std::string_view trimmed = without_blanks(text);
    WantedModule wanted;
    // Other dialects have a module named `(`, which users write in back quotes.
    const std::size_t open =
        has_values ? trimmed.find('(', trimmed.starts_with('`') ? trimmed.find('`', 1) : 0)
                   : std::string_view::npos;
    wanted.name = name_in(trimmed.substr(0, open));
    if (wanted.name.empty()) {
        return Error{fmt::format("`{}` is no module; one is written like `A(3)`", text)};
    }
    if (open == std::string_view::npos) {
        return wanted;
    }
    if (!trimmed.ends_with(')')) {
        return Error{fmt::format("`{}` has no `)` at its end", text)};
    }
    std::string_view rest = without_blanks(trimmed.substr(open + 1, trimmed.size() - open - 2));
    while (!rest.empty()) {
        const std::size_t comma = rest.find(',');
        const std::string_view number = without_blanks(rest.substr(0, comma));
        float value = 0.0F;
        const auto [end, error] =
            number_from_chars(number.data(), number.data() + number.size(), value);
        if (number.empty() || error != std::errc() || end != number.data() + number.size() ||
            !std::isfinite(value)) {
            return Error{fmt::format("`{}` in `{}` is no number", number, text)};
        }
        wanted.values.push_back(value);
        rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
    }
    return wanted;
}

} // namespace lsys
