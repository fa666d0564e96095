// Compiles and links the shaders of viewer/shaders. Shaders may contain `#include "name.glsl"`;
// errors are reported with file and line.
#pragma once

#include "grammar/base/result.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/gl/renderer.h"

#include <string>
#include <string_view>

namespace lsys::view {

/// `defines`: lines of `#define`, put before the text.
[[nodiscard]] Result<ProgramObject> make_program(Device& device,
                                                 const ShaderSource& source,
                                                 std::string_view vertex,
                                                 std::string_view fragment,
                                                 std::string_view defines = "");

} // namespace lsys::view
