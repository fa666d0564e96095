// SPDX-License-Identifier: MIT
#include "runtime/export/impl/text.h"

#include "grammar/base/contract.h"
#include "grammar/base/exponentials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace lsys {

namespace {

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_control(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7F;
}

/// Bytes of the first character of `text`; 0 if it is not UTF-8 (RFC 3629, section 4).
std::size_t character_length(std::string_view text) {
    const auto byte = [&text](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto tail = [&byte](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    const unsigned first = byte(0);
    if (first < 0x80) {
        return 1;
    }
    if (first >= 0xC2 && first <= 0xDF) {
        return tail(1) ? 2 : 0;
    }
    if (first >= 0xE0 && first <= 0xEF) {
        const bool shortest = first != 0xE0 || byte(1) >= 0xA0;
        const bool surrogate = first == 0xED && byte(1) >= 0xA0;
        return tail(1) && tail(2) && shortest && !surrogate ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        const bool in_range =
            (first != 0xF0 || byte(1) >= 0x90) && (first != 0xF4 || byte(1) < 0x90);
        return tail(1) && tail(2) && tail(3) && in_range ? 4 : 0;
    }
    return 0;
}

} // namespace

std::string_view unit_text(LengthUnit unit) {
    switch (unit) {
    case LengthUnit::Centimetres:
        return "centimetres";
    case LengthUnit::Millimetres:
        return "millimetres";
    case LengthUnit::Metres:
        break;
    }
    return "metres";
}

std::string_view metres_per_unit(LengthUnit unit) {
    switch (unit) {
    case LengthUnit::Centimetres:
        return "0.01";
    case LengthUnit::Millimetres:
        return "0.001";
    case LengthUnit::Metres:
        break;
    }
    return "1";
}

std::string plant_name(const ExportInfo& info) {
    return info.name.empty() ? "plant" : one_line(info.name);
}

std::string valid_utf8(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        valid += length == 0 ? "\xEF\xBF\xBD" : text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return valid;
}

char* put_rounded(char* at, float value, int decimals) {
    constexpr std::array<double, 10> kPowers{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
    constexpr double kMaxWhole = 1e15; // integers up to here are exact as doubles
    LSYS_CHECK(decimals >= 0 && static_cast<std::size_t>(decimals) < kPowers.size(), decimals);
    const double scaled = static_cast<double>(value) * kPowers[static_cast<std::size_t>(decimals)];
    if (!(std::fabs(scaled) < kMaxWhole)) {
        return put_number(at, value);
    }
    const std::int64_t rounded = std::llround(scaled);
    if (rounded < 0) {
        *at++ = '-';
    }
    auto left = static_cast<std::uint64_t>(std::abs(rounded));
    std::array<char, 10> fraction{};
    std::size_t count = 0; // digits of the fraction, without trailing zeros
    for (int i = decimals; i > 0; --i, left /= 10) {
        const auto digit = static_cast<char>('0' + left % 10);
        fraction[static_cast<std::size_t>(i - 1)] = digit;
        if (count == 0 && digit != '0') {
            count = static_cast<std::size_t>(i);
        }
    }
    at = put_number(at, left);
    if (count > 0) {
        *at++ = '.';
        at = put_text(at, {fraction.data(), count});
    }
    return at;
}

std::string one_line(std::string_view text) {
    std::string line = valid_utf8(text);
    std::replace_if(line.begin(), line.end(), is_control, ' ');
    return line;
}

std::string origin_line(const ExportInfo& info) {
    return fmt::format("{}, seed {}, {} generations", one_line(info.grammar), info.seed,
                       info.generations);
}

std::string json_text(std::string_view text) {
    std::string escaped;
    for (const char c : valid_utf8(text)) {
        if (c == '"' || c == '\\') {
            escaped += '\\';
            escaped += c;
        } else if (is_control(c)) {
            escaped += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string xml_text(std::string_view text) {
    std::string escaped;
    for (const char c : one_line(text)) {
        switch (c) {
        case '&':
            escaped += "&amp;";
            break;
        case '<':
            escaped += "&lt;";
            break;
        case '>':
            escaped += "&gt;";
            break;
        case '"':
            escaped += "&quot;";
            break;
        default:
            escaped += c;
        }
    }
    return escaped;
}

std::string uri_text(std::string_view name) {
    std::string text;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
        if (plain) {
            text += c;
        } else {
            text += fmt::format("%{:02X}", static_cast<unsigned char>(c));
        }
    }
    return text;
}

std::string obj_identifier(std::string_view text) {
    std::string name = one_line(text);
    std::replace(name.begin(), name.end(), ' ', '_');
    return name.empty() ? "_" : name;
}

std::string identifier(std::string_view text) {
    std::string name;
    for (const char c : text) {
        name += is_letter(c) || is_digit(c) ? c : '_';
    }
    return name.empty() || is_digit(name[0]) ? '_' + name : name;
}

std::string unique_name(const std::vector<std::string>& taken, const std::string& name) {
    std::string unique = name;
    for (int i = 2; std::find(taken.begin(), taken.end(), unique) != taken.end(); ++i) {
        unique = fmt::format("{}_{}", name, i);
    }
    return unique;
}

float srgb(float linear) {
    const float c = std::clamp(linear, 0.0F, 1.0F);
    const auto root = static_cast<float>(power(static_cast<double>(c), 1.0 / 2.4));
    return c <= 0.0031308F ? 12.92F * c : 1.055F * root - 0.055F;
}

std::uint8_t srgb_byte(float linear) {
    return static_cast<std::uint8_t>(std::lround(255.0F * srgb(linear)));
}

} // namespace lsys
