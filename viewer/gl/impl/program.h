// SPDX-License-Identifier: MIT
// Compiles and links the shaders of viewer/shaders. Shaders may contain `#include "name.glsl"`;
// errors are reported with file and line.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <string>
#include <string_view>

namespace lsys::view {

/// Makes a program of a vertex and a fragment shader. `defines`: lines of `#define`, inserted
/// before the text of each shader.
[[nodiscard]] Result<ProgramObject> make_program(Device& device,
                                                 const ShaderSource& source,
                                                 std::string_view vertex,
                                                 std::string_view fragment,
                                                 std::string_view defines = "");

/// Makes a program of a compute shader.
[[nodiscard]] Result<ProgramObject> make_compute_program(Device& device,
                                                         const ShaderSource& source,
                                                         std::string_view name,
                                                         std::string_view defines);

} // namespace lsys::view
