// SPDX-License-Identifier: MIT
#include "grammar/ast/number.h"

#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "grammar/base/number_chars.h"

#include <cmath>
#include <limits>
#include <system_error>

namespace lsys {

namespace {

/// Whether the value of `text` is at least 1, by its order of magnitude. Precondition: the value is
/// outside the range of binary32.
bool is_large(std::string_view text) {
    std::int64_t magnitude = 0; // power of ten, plus 1, of the first digit that is not 0
    bool seen_point = false;
    bool seen_digit = false;
    std::size_t at = 0;
    for (; at < text.size() && text[at] != 'e' && text[at] != 'E'; ++at) {
        if (text[at] == '.') {
            seen_point = true;
        } else {
            seen_digit = seen_digit || text[at] != '0';
            magnitude += seen_digit ? (seen_point ? 0 : 1) : (seen_point ? -1 : 0);
        }
    }
    std::int64_t exponent = 0;
    if (at < text.size()) {
        ++at;
        const bool negative = at < text.size() && text[at] == '-';
        at += at < text.size() && (text[at] == '-' || text[at] == '+') ? 1u : 0u;
        constexpr std::int64_t kMaxExponent = std::int64_t{1}
                                              << 40; // more digits than any file has
        for (; at < text.size() && exponent < kMaxExponent; ++at) {
            exponent = exponent * 10 + (text[at] - '0');
        }
        exponent = negative ? -exponent : exponent;
    }
    return magnitude + exponent > 0;
}

} // namespace

Literal read_literal(std::string_view text) {
    if (text.size() <= 7) { // small whole numbers are exact
        std::uint32_t whole = 0;
        std::size_t at = 0;
        for (; at < text.size() && is_digit(text[at]); ++at) {
            whole = whole * 10 + static_cast<std::uint32_t>(text[at] - '0');
        }
        if (at == text.size()) {
            return {static_cast<float>(whole), LiteralRange::Normal};
        }
    }
    float value = 0.0F;
    const auto [end, error] = number_from_chars(text.data(), text.data() + text.size(), value);
    LSYS_CHECK(error == std::errc::result_out_of_range ||
               (error == std::errc{} && end == text.data() + text.size()));
    if (error == std::errc::result_out_of_range || std::isinf(value)) {
        return {0.0F, is_large(text) ? LiteralRange::Overflow : LiteralRange::Underflow};
    }
    if (value < std::numeric_limits<float>::min()) {
        const std::string_view digits = text.substr(0, text.find_first_of("eE"));
        const bool is_zero = digits.find_first_of("123456789") == std::string_view::npos;
        return {value, is_zero ? LiteralRange::Normal : LiteralRange::Underflow};
    }
    return {value, LiteralRange::Normal};
}

std::size_t literal_length(std::string_view text) {
    const auto digits = [&](std::size_t at) {
        while (at < text.size() && is_digit(text[at])) {
            ++at;
        }
        return at;
    };
    std::size_t end = digits(0);
    const bool whole = end != 0;
    if (end < text.size() && text[end] == '.') {
        const std::size_t after = digits(end + 1);
        if (!whole && after == end + 1) {
            return 0;
        }
        end = after;
    } else if (!whole) {
        return 0;
    }
    if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
        std::size_t first = end + 1;
        first += first < text.size() && (text[first] == '+' || text[first] == '-') ? 1u : 0u;
        if (const std::size_t after = digits(first); after != first) {
            end = after;
        }
    }
    return end;
}

} // namespace lsys
