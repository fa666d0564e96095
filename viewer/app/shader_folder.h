// Where shaders come from: a folder, or the program itself.
#pragma once

#include "runtime/program/console.h"
#include "viewer/gl/renderer.h"

#include <string>
#include <vector>

namespace lsys::view {

/// Those of `folder`; those that are built in if its name is empty.
[[nodiscard]] ShaderSource shaders_of(const std::string& folder, const Console& console);
/// The files of `folder` that may be shaders.
[[nodiscard]] std::vector<std::string> shader_files(const std::string& folder);

} // namespace lsys::view
