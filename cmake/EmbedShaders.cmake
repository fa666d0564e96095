# SPDX-License-Identifier: MIT
# Writes shaders as string literals into a C++ source file, so that lsview needs no shader files.
# Usage: cmake -D OUTPUT=F.cpp -D "SHADERS=A.glsl;B.glsl" -P EmbedShaders.cmake
set(text "// Written by EmbedShaders.cmake.\n#include \"viewer/gl/impl/program.h\"\n\nnamespace lsys::view {\n\n")
string(APPEND text "std::optional<std::string> built_in_shader(std::string_view name) {\n")
foreach(shader ${SHADERS})
  get_filename_component(name "${shader}" NAME)
  file(READ "${shader}" content)
  # Lines keep their numbers for messages. Comments and indentation would only make the program larger.
  string(REGEX REPLACE "[ \t]*//[^\n]*" "" content "${content}")
  string(REGEX REPLACE "\n[ \t]+" "\n" content "${content}")
  string(APPEND text "    if (name == \"${name}\") {\n        return std::string(R\"glsl(${content})glsl\");\n    }\n")
endforeach()
string(APPEND text "    return std::nullopt;\n}\n\n} // namespace lsys::view\n")
file(WRITE "${OUTPUT}" "${text}")
