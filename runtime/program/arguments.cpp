// SPDX-License-Identifier: MIT
#include "runtime/program/arguments.h"

#include "grammar/base/names.h"
#include "grammar/base/number_chars.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <system_error>
#include <vector>

namespace lsys {

namespace {

template <typename T>
struct Parsed {
    std::errc error{};
    T value{};
};

/// Parses `text` as a number without anything before or after it.
template <typename T>
Parsed<T> parse_all(std::string_view text) {
    Parsed<T> parsed;
    const char* const end = text.data() + text.size();
    const auto [last, error] = number_from_chars(text.data(), end, parsed.value);
    parsed.error = error == std::errc() && last != end ? std::errc::invalid_argument : error;
    return parsed;
}

/// Parses numbers with commas between them. Empty unless all are finite.
template <typename T>
std::vector<T> parse_numbers(std::string_view text) {
    std::vector<T> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const Parsed<T> parsed = parse_all<T>(text.substr(0, comma));
        if (parsed.error != std::errc() || !std::isfinite(parsed.value)) {
            return {};
        }
        numbers.push_back(parsed.value);
        if (comma == std::string_view::npos) {
            return numbers;
        }
        text.remove_prefix(comma + 1);
    }
}

} // namespace

Result<std::uint64_t> parse_integer(std::string_view text, std::uint64_t low, std::uint64_t high) {
    const Parsed<std::uint64_t> parsed = parse_all<std::uint64_t>(text);
    if (parsed.error != std::errc() || parsed.value < low || parsed.value > high) {
        return Error{fmt::format("`{}` is not a whole number from {} to {}", text, low, high)};
    }
    return parsed.value;
}

Result<float> parse_number(std::string_view text, float low, float high) {
    const Parsed<float> parsed = parse_all<float>(text);
    if (parsed.error != std::errc() || !(parsed.value >= low && parsed.value <= high)) {
        return Error{fmt::format("`{}` is not a number from {} to {}", text, low, high)};
    }
    return parsed.value;
}

Result<Wind> parse_wind(std::string_view text) {
    const std::vector<float> values = parse_numbers<float>(text);
    if (values.size() == 3 || (values.size() == 4 && values[3] >= 0.0F)) {
        return Wind{{values[0], values[1], values[2]}, values.size() == 4 ? values[3] : 0.0F};
    }
    return Error{fmt::format("`{}` is not a wind such as 5,0,0 or 5,0,0,0.5", text)};
}

Result<SunPlace> parse_sun(std::string_view text) {
    const auto is_within = [](double value, double low, double high) {
        return value >= low && value <= high;
    };
    const std::vector<double> values = parse_numbers<double>(text);
    if (values.size() == 2 && is_within(values[0], -360.0, 360.0) &&
        is_within(values[1], -90.0, 90.0)) {
        return SunPlace{values[0], values[1]};
    }
    if (values.size() == 3 && is_within(values[0], 1.0, 366.0) && is_within(values[1], 0.0, 24.0) &&
        is_within(values[2], -90.0, 90.0)) {
        return sun_at(values[0], values[1], values[2]);
    }
    return Error{
        fmt::format("`{}` is neither azimuth and elevation in degrees, such as 225,30, nor "
                    "day of the year, hour and latitude, such as 172,18.5,52",
                    text)};
}

Result<glm::vec3> parse_place(std::string_view text) {
    const std::vector<float> values = parse_numbers<float>(text);
    if (values.size() == 3) {
        return glm::vec3(values[0], values[1], values[2]);
    }
    return Error{fmt::format("`{}` is not a place such as 0,2,50", text)};
}

Result<std::uint64_t> parse_size(std::string_view text) {
    std::string_view digits = text;
    double unit = 1.0;
    for (const std::string_view suffix : {"iB", "B"}) {
        if (digits.size() > suffix.size() + 1 && digits.ends_with(suffix)) {
            digits.remove_suffix(suffix.size());
            break;
        }
    }
    constexpr std::string_view kPrefixes = "KMGT";
    if (!digits.empty()) {
        const char last = digits.back() == 'k' ? 'K' : digits.back();
        if (const std::size_t power = kPrefixes.find(last); power != std::string_view::npos) {
            unit = std::ldexp(1.0, 10 * static_cast<int>(power + 1));
            digits.remove_suffix(1);
        }
    }
    const Parsed<double> parsed = parse_all<double>(digits);
    const double bytes = parsed.value * unit;
    constexpr double kMaxBytes = 9.2e18;
    const bool whole = unit > 1.0 || bytes == std::floor(bytes);
    if (parsed.error != std::errc() || !(bytes >= 1.0) || !(bytes < kMaxBytes) || !whole) {
        return Error{fmt::format("`{}` is not a size such as 500M, 1.5G or 1048576", text)};
    }
    return static_cast<std::uint64_t>(bytes);
}

Result<EnvironmentCommand> parse_environment(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
        return Error{fmt::format("`{}` is not NAME=COMMAND", text)};
    }
    std::string_view name = text.substr(0, equals);
    name.remove_prefix(name.starts_with('?') ? 1 : 0);
    if (!is_identifier(name)) {
        return Error{fmt::format("`{}` is not the name of an environment", name)};
    }
    const std::string_view command = text.substr(equals + 1);
    if (command.find_first_not_of(" \t") == std::string_view::npos) {
        return Error{fmt::format("`{}` names no program", text)};
    }
    return EnvironmentCommand{std::string(name), std::string(command)};
}

Result<Definition> parse_definition(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
        return Error{fmt::format("`{}` is not of the form NAME=number", text)};
    }
    Definition definition{std::string(text.substr(0, equals)), 0.0F};
    if (!is_identifier(definition.name)) {
        return Error{fmt::format("`{}` is not the name of a constant", definition.name)};
    }
    const std::string_view number = text.substr(equals + 1);
    const Parsed<float> parsed = parse_all<float>(number);
    if (parsed.error == std::errc::result_out_of_range) {
        // An underflow is no error: it gives the nearest binary32, which may be zero.
        const Parsed<double> wide = parse_all<double>(number);
        if (wide.error == std::errc() && std::abs(wide.value) < 1.0) {
            definition.value = static_cast<float>(wide.value);
            return definition;
        }
        return Error{fmt::format("`{}` does not fit into binary32", number)};
    }
    if (parsed.error != std::errc() || !std::isfinite(parsed.value)) {
        return Error{fmt::format("`{}` is not a number", number)};
    }
    definition.value = parsed.value;
    return definition;
}

} // namespace lsys
