// SPDX-License-Identifier: MIT
// Replaces file numbers in compiler logs of shaders that consist of several files.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lsys::view {

/// Replaces the file numbers at the start of lines of a driver's `log` by names: `0:12(3): error`
/// of Mesa becomes `plant.glsl:12(3): error`, `0(12) : error` of NVIDIA `plant.glsl:12: error`.
/// `files`: names by the numbers used in `#line`. Other lines stay unchanged.
[[nodiscard]] std::string name_files(std::string_view log, std::span<const std::string> files);

} // namespace lsys::view
