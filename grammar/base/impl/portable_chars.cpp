// SPDX-License-Identifier: MIT
#include "grammar/base/impl/portable_chars.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fast_float/fast_float.h>
#include <string_view>

namespace lsys {

namespace {

template <typename Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
    Number number{};
    const auto [end, error] = fast_float::from_chars(first, last, number);
    if (error != std::errc()) {
        return {end, error};
    }
    // fast_float reads a number that is too large as infinity, and one that is too small as 0.
    const std::string_view text(first, static_cast<std::size_t>(end - first));
    const bool has_digits = text.find_first_of("0123456789") != std::string_view::npos;
    if (std::isinf(number) && has_digits) {
        return {end, std::errc::result_out_of_range};
    }
    if (number == 0 &&
        text.substr(0, text.find_first_of("eE")).find_first_of("123456789") != text.npos) {
        return {end, std::errc::result_out_of_range};
    }
    value = number;
    return {end, std::errc()};
}

std::to_chars_result put(char* first, char* last, std::string_view text) {
    if (static_cast<std::size_t>(last - first) < text.size()) {
        return {last, std::errc::value_too_large};
    }
    return {std::copy(text.begin(), text.end(), first), std::errc()};
}

/// The shortest decimal of a finite positive number: `count` digits, times 10^exponent.
struct Digits {
    std::array<char, 24> text{};
    int count = 0;
    int exponent = 0;
};

template <typename Number>
Digits shortest_digits(Number value) {
    std::array<char, 32> buffer{};
    const char* const end = fmt::format_to(buffer.data(), "{}", value);
    const char* at = buffer.data();
    Digits digits;
    bool is_fraction = false;
    for (; at != end && *at != 'e'; ++at) {
        if (*at == '.') {
            is_fraction = true;
            continue;
        }
        digits.exponent -= is_fraction ? 1 : 0;
        if (digits.count != 0 || *at != '0') { // skips leading zeros
            digits.text[static_cast<std::size_t>(digits.count++)] = *at;
        }
    }
    if (at != end) {
        const bool is_negative = at[1] == '-';
        int exponent = 0;
        for (at += 2; at != end; ++at) {
            exponent = exponent * 10 + (*at - '0');
        }
        digits.exponent += is_negative ? -exponent : exponent;
    }
    while (digits.count > 1 && digits.text[static_cast<std::size_t>(digits.count - 1)] == '0') {
        --digits.count;
        ++digits.exponent;
    }
    return digits;
}

/// Appends a number that is not whole, without an exponent.
void append_fraction(fmt::memory_buffer& out, const Digits& digits) {
    const std::string_view text(digits.text.data(), static_cast<std::size_t>(digits.count));
    const int whole = digits.count + digits.exponent; // digits before the point
    if (whole > 0) {
        out.append(text.substr(0, static_cast<std::size_t>(whole)));
        out.push_back('.');
        out.append(text.substr(static_cast<std::size_t>(whole)));
        return;
    }
    out.append(std::string_view("0."));
    for (int i = whole; i < 0; ++i) {
        out.push_back('0');
    }
    out.append(text);
}

void append_scientific(fmt::memory_buffer& out, const Digits& digits) {
    const std::string_view text(digits.text.data(), static_cast<std::size_t>(digits.count));
    out.push_back(text[0]);
    if (digits.count > 1) {
        out.push_back('.');
        out.append(text.substr(1));
    }
    const int exponent = digits.exponent + digits.count - 1;
    fmt::format_to(fmt::appender(out), "e{}{:02}", exponent < 0 ? '-' : '+', std::abs(exponent));
}

template <typename Number>
std::to_chars_result write(char* first, char* last, Number value, bool is_fixed) {
    fmt::memory_buffer out;
    if (std::signbit(value)) {
        out.push_back('-');
    }
    const Number magnitude = std::fabs(value);
    if (!std::isfinite(value)) {
        out.append(std::string_view(std::isnan(value) ? "nan" : "inf"));
        return put(first, last, {out.data(), out.size()});
    }
    if (magnitude == 0) {
        out.push_back('0');
        return put(first, last, {out.data(), out.size()});
    }
    const Digits digits = shortest_digits(magnitude);
    // The shorter of the forms with and without an exponent; the form without one if they have
    // equal length: `0.000123` for `1.23e-04`, `12300000` for `1.23e+07`. A single digit has no
    // point before its exponent.
    const int point = digits.count == 1 ? 1 : 0;
    if (!is_fixed &&
        (digits.exponent < point - (digits.count + 3) || digits.exponent > 5 - point)) {
        append_scientific(out, digits);
    } else if (digits.exponent >= 0) {
        fmt::format_to(fmt::appender(out), "{:.0f}", magnitude); // all digits of a whole number
    } else {
        append_fraction(out, digits);
    }
    return put(first, last, {out.data(), out.size()});
}

} // namespace

std::from_chars_result portable_from_chars(const char* first, const char* last, float& value) {
    return read(first, last, value);
}

std::from_chars_result portable_from_chars(const char* first, const char* last, double& value) {
    return read(first, last, value);
}

std::to_chars_result portable_to_chars(char* first, char* last, float value, bool is_fixed) {
    return write(first, last, value, is_fixed);
}

std::to_chars_result portable_to_chars(char* first, char* last, double value, bool is_fixed) {
    return write(first, last, value, is_fixed);
}

} // namespace lsys
