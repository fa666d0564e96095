// SPDX-License-Identifier: MIT
// Values of options: numbers, sizes, definitions. Error messages state the allowed values.
#pragma once

#include "compiler/program/compile_options.h"
#include "grammar/base/result.h"
#include "runtime/physics/physics.h"
#include "runtime/pipeline/project.h"
#include "runtime/scene/sun.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

/// Maximum number of generations (docs/language.md section 2).
inline constexpr std::uint64_t kMaxGenerations = 0xFFFF'FFFEu;

/// A whole number from `low` to `high`, in decimal digits.
[[nodiscard]] Result<std::uint64_t>
parse_integer(std::string_view text, std::uint64_t low, std::uint64_t high);

/// A number from `low` to `high`.
[[nodiscard]] Result<float> parse_number(std::string_view text, float low, float high);

/// `x,y,z` or `x,y,z,gust`: velocity in metres per second, and amplitude of gusts as a fraction of
/// the velocity.
[[nodiscard]] Result<Wind> parse_wind(std::string_view text);
/// AZIMUTH,ELEVATION in degrees, or DAY,HOUR,LATITUDE as for sun_at().
[[nodiscard]] Result<SunPlace> parse_sun(std::string_view text);

/// `X,Y,Z`: a place in metres.
[[nodiscard]] Result<glm::vec3> parse_place(std::string_view text);

/// A number of bytes: a whole number, or a number with a suffix K, M, G or T, which may be followed
/// by `B` or `iB`. All suffixes are powers of 1024.
[[nodiscard]] Result<std::uint64_t> parse_size(std::string_view text);

/// `NAME=number`.
[[nodiscard]] Result<Definition> parse_definition(std::string_view text);
/// NAME=COMMAND of --environment. NAME may begin with `?`.
[[nodiscard]] Result<EnvironmentCommand> parse_environment(std::string_view text);

} // namespace lsys
