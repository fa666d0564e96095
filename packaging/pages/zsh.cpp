// SPDX-License-Identifier: MIT
#include "packaging/pages/completion.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys::pages {

namespace {

/// Escapes a text for a specification of _arguments between single quotes.
std::string quoted(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\'') {
            escaped += "'\\''";
        } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
            escaped += {'\\', c};
        } else {
            escaped += c;
        }
    }
    return escaped;
}

/// `:message:action` of a specification for `_arguments`: `:file:_files -g "*.(lsys)(-.)"`.
std::string message_and_action(const OptionText& option) {
    const std::string words = fmt::format("({})", fmt::join(option.words, " "));
    switch (option.kind) {
    case ValueKind::None:
        return option.optional_value ? "::value:" + words : std::string();
    case ValueKind::Text:
        return fmt::format(":{}:{}", quoted(option.value), option.words.empty() ? " " : words);
    case ValueKind::Words:
        return ":value:" + words;
    case ValueKind::Folder:
        return ":folder:_files -/";
    case ValueKind::File:
        break;
    }
    return option.extensions.empty()
               ? ":file:_files"
               : fmt::format(":file:_files -g \"*.({})(-.)\"", fmt::join(option.extensions, "|"));
}

/// The specifications of an option, one for each of its names.
std::string option_lines(const OptionText& option) {
    std::string text;
    const std::string others =
        option.repeatable ? "*" : fmt::format("({})", fmt::join(option.names, " "));
    for (const std::string& name : option.names) {
        const bool is_long = name.starts_with("--");
        const char* mark = "";
        if (option.optional_value) {
            mark = "=-";
        } else if (option.kind != ValueKind::None) {
            mark = is_long ? "=" : "+";
        }
        text += fmt::format(" \\\n        '{}{}{}[{}]{}'", others, name, mark,
                            quoted(short_text(option.description)), message_and_action(option));
    }
    return text;
}

std::string arguments(const CommandText& command) {
    std::string text = "    _arguments -s -S";
    for (const OptionText& option : command.options) {
        text += option_lines(option);
    }
    for (const OptionText& option : command.positionals) {
        text += fmt::format(" \\\n        '{}{}'", option.repeatable ? "*" : "",
                            message_and_action(option));
    }
    return text + '\n';
}

} // namespace

std::string zsh_completion(const ProgramText& program) {
    const std::string& name = program.program.name;
    std::string text = fmt::format("#compdef {0}\n# Completion of {0} for zsh.\n\n", name);
    if (program.commands.empty()) {
        return text + arguments(program.program);
    }
    for (const CommandText& command : program.commands) {
        text += fmt::format("_{}__{}() {{\n{}}}\n", name, command.name, arguments(command));
    }
    text += fmt::format("_{0}() {{\n    local -a commands=(\n", name);
    for (const CommandText& command : program.commands) {
        text +=
            fmt::format("        '{}:{}'\n", command.name, quoted(short_text(command.description)));
    }
    text += "    )\n    if ((CURRENT == 2)) && [[ ${words[2]} != -* ]]; then\n"
            "        _describe command commands\n        return\n    fi\n"
            "    local command=${words[2]}\n"
            "    if ((CURRENT > 2)) && ((${+functions[_" +
            name +
            "__$command]})); then\n"
            "        shift words\n        ((CURRENT--))\n        _" +
            name + "__$command\n        return\n    fi\n" + arguments(program.program) + "}\n";
    return text + fmt::format("_{} \"$@\"\n", name);
}

} // namespace lsys::pages
