# SPDX-License-Identifier: MIT
# Writes shaders as string literals into a C++ source file, so that lsview needs no shader files.
# Usage: cmake -D OUTPUT=F.cpp -D "SHADERS=A.glsl;B.glsl" -P EmbedShaders.cmake
set(text "// Written by EmbedShaders.cmake.\n#include \"viewer/gl/impl/program.h\"\n\nnamespace lsys::view {\n\n")
string(APPEND text "std::optional<std::string> built_in_shader(std::string_view wanted) {\n")
string(APPEND text "    struct Shader {\n        const char* name;\n        const char* text;\n    };\n")
string(APPEND text "    static constexpr Shader kShaders[] = {\n")
foreach(shader ${SHADERS})
  get_filename_component(name "${shader}" NAME)
  file(READ "${shader}" content)
  # Lines keep their numbers for messages. Comments and indentation would only make the program larger.
  string(REGEX REPLACE "[ \t]*//[^\n]*" "" content "${content}")
  string(REGEX REPLACE "\n[ \t]+" "\n" content "${content}")
  string(APPEND text "        {\"${name}\", R\"glsl(${content})glsl\"},\n")
endforeach()
string(APPEND text "    };\n    for (const Shader& shader : kShaders) {\n        if (wanted == shader.name) {\n")
string(APPEND text "            return shader.text;\n        }\n    }\n")
string(APPEND text "    return std::nullopt;\n}\n\n} // namespace lsys::view\n")
file(WRITE "${OUTPUT}" "${text}")
