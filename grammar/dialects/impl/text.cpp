// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/text.h"

#include "grammar/ast/number.h"
#include "grammar/base/number_chars.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

template <typename Number>
std::string fixed_digits(Number value) {
    std::array<char, 64> digits{};
    const auto [end, error] =
        number_to_fixed_chars(digits.data(), digits.data() + digits.size(),
                              value == Number{0} ? Number{0} : value); // no -0
    return error == std::errc() ? std::string(digits.data(), end) : "0";
}

} // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

bool is_one_of(char c, std::string_view set) {
    return set.find(c) != std::string_view::npos;
}

std::size_t length_up_to(std::string_view text, std::string_view stops) {
    return std::min(text.find_first_of(stops), text.size());
}

bool is_number(std::string_view text, std::string_view signs) {
    const bool has_sign = !text.empty() && signs.find(text[0]) != std::string_view::npos;
    text.remove_prefix(has_sign ? 1 : 0);
    return !text.empty() && literal_length(text) == text.size();
}

std::string lowered(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return out;
}

std::string text_of(float value) {
    std::array<char, 32> digits{};
    const auto [end, error] = number_to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), end};
}

std::string fixed_text(float value) {
    return fixed_digits(value);
}

std::string decimal_text(double value) {
    return fixed_digits(std::round(value * 1e6) / 1e6);
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

} // namespace lsys
