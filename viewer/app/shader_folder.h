// SPDX-License-Identifier: MIT
// Sources of shaders: a folder, or the texts embedded in the program.
#pragma once

#include "grammar/base/result.h"
#include "runtime/program/console.h"
#include "viewer/gl/renderer.h"

#include <string>
#include <vector>

namespace lsys::view {

/// Shaders in `folder`; the built-in shaders if `folder` is empty.
[[nodiscard]] ShaderSource shaders_of(const std::string& folder, const Console& console);
/// A mistake in these shaders, with the name of the folder.
[[nodiscard]] Error shader_error(const std::string& folder, const Error& error);
/// Paths of all `.glsl` files in `folder`, sorted.
[[nodiscard]] std::vector<std::string> shader_files(const std::string& folder);

} // namespace lsys::view
