// Program: shaders of viewer/shaders, compiled and linked. A shader's text may include another one
// by a line `#include "name.glsl"`; faults are shown with the file and line where they are.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <string>
#include <string_view>

namespace lsys::view {

/// `defines` are lines of `#define`, put before the text.
[[nodiscard]] Result<ProgramObject> make_program(Device& device,
                                                 const ShaderSource& source,
                                                 std::string_view vertex,
                                                 std::string_view fragment,
                                                 std::string_view defines = "");

} // namespace lsys::view
