// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/program.h"

#include "viewer/gl/impl/shader_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

struct Assembly {
    std::string text;
    std::vector<std::string> files; // its index is the file number in `#line`
};

/// Appends a file and the files that it includes to `assembly`, each once.
Result<void> assemble(const ShaderSource& source, std::string_view name, Assembly& assembly) {
    if (std::find(assembly.files.begin(), assembly.files.end(), name) != assembly.files.end()) {
        return {};
    }
    const std::optional<std::string> text = source(name);
    if (!text) {
        return Error{fmt::format("there is no shader `{}`", name)};
    }
    const std::size_t number = assembly.files.size();
    assembly.files.emplace_back(name);
    assembly.text += fmt::format("#line 1 {}\n", number);
    std::size_t line = 0;
    for (std::size_t at = 0; at < text->size();) {
        const std::size_t end = std::min(text->find('\n', at), text->size());
        const std::string_view row = std::string_view(*text).substr(at, end - at);
        at = end + 1;
        ++line;
        constexpr std::string_view kInclude = "#include \"";
        if (row.starts_with(kInclude)) {
            const std::string_view rest = row.substr(kInclude.size());
            const Result<void> included =
                assemble(source, rest.substr(0, rest.find('"')), assembly);
            if (!included) {
                return Error{fmt::format("{}:{}: {}", name, line, included.error().message)};
            }
            assembly.text += fmt::format("#line {} {}\n", line + 1, number);
        } else {
            assembly.text += row;
            assembly.text += '\n';
        }
    }
    return {};
}

struct ShaderKind {
    static void destroy(GLuint name) { glDeleteShader(name); }
};
using ShaderObject = Object<ShaderKind>;

Result<ShaderObject> compile_shader(Device& device,
                                    const ShaderSource& source,
                                    std::string_view name,
                                    GLenum stage,
                                    std::string_view defines) {
    Assembly assembly;
    assembly.text =
        fmt::format("#version 450 core\n#define QUALITY {}\n{}", device.quality(), defines);
    if (const Result<void> done = assemble(source, name, assembly); !done) {
        return done.error();
    }
    ShaderObject shader(device, glCreateShader(stage));
    const GLchar* const text = assembly.text.data();
    const auto length = static_cast<GLint>(assembly.text.size());
    glShaderSource(shader.name(), 1, &text, &length);
    glCompileShader(shader.name());
    GLint compiled = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        std::array<GLchar, 4096> log{};
        GLsizei written = 0;
        glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), &written, log.data());
        return Error{fmt::format(
            "shader `{}`: {}", name,
            name_files({log.data(), static_cast<std::size_t>(written)}, assembly.files))};
    }
    return shader;
}

Result<ProgramObject>
link(Device& device, std::string_view name, std::initializer_list<const ShaderObject*> shaders) {
    ProgramObject program(device, glCreateProgram());
    for (const ShaderObject* shader : shaders) {
        glAttachShader(program.name(), shader->name());
    }
    glLinkProgram(program.name());
    for (const ShaderObject* shader : shaders) {
        glDetachShader(program.name(), shader->name());
    }
    GLint linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<GLchar, 4096> log{};
        GLsizei written = 0;
        glGetProgramInfoLog(program.name(), static_cast<GLsizei>(log.size()), &written, log.data());
        return Error{fmt::format("shader `{}`: {}", name,
                                 std::string(log.data(), static_cast<std::size_t>(written)))};
    }
    return program;
}

} // namespace

Result<ProgramObject> make_program(Device& device,
                                   const ShaderSource& source,
                                   std::string_view vertex,
                                   std::string_view fragment,
                                   std::string_view defines) {
    Result<ShaderObject> first = compile_shader(device, source, vertex, GL_VERTEX_SHADER, defines);
    if (!first) {
        return first.error();
    }
    Result<ShaderObject> second =
        compile_shader(device, source, fragment, GL_FRAGMENT_SHADER, defines);
    if (!second) {
        return second.error();
    }
    return link(device, vertex, {&first.value(), &second.value()});
}

Result<ProgramObject> make_compute_program(Device& device,
                                           const ShaderSource& source,
                                           std::string_view name,
                                           std::string_view defines) {
    Result<ShaderObject> shader = compile_shader(device, source, name, GL_COMPUTE_SHADER, defines);
    if (!shader) {
        return shader.error();
    }
    return link(device, name, {&shader.value()});
}

} // namespace lsys::view
