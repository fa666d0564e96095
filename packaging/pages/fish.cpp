// SPDX-License-Identifier: MIT
#include "packaging/pages/completion.h"

#include <fmt/format.h>

namespace lsys::pages {

namespace {

std::string quoted(const std::string& text) {
    std::string escaped = "'";
    for (const char c : text) {
        escaped += c == '\'' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
    }
    return escaped + '\'';
}

/// The options of `complete` that offer the values of `option`; may be empty.
std::string value_options(const std::string& program, const OptionText& option) {
    std::string text;
    if (!option.words.empty()) {
        text += fmt::format(" -a {}", quoted(fmt::format("{}", fmt::join(option.words, " "))));
    }
    if (option.kind == ValueKind::Folder) {
        return text + " -a '(__fish_complete_directories)'";
    }
    if (option.kind == ValueKind::File && !option.extensions.empty()) {
        // `string match` would print a group as a match of its own.
        std::string pattern = name_pattern(option.extensions);
        pattern.insert(pattern.find('(') + 1, "?:");
        return text + " -a " + quoted(fmt::format("(__{}_files {})", program, quoted(pattern)));
    }
    return text;
}

constexpr const char* kBegin = R"(# Completion of {0} for fish.

# Files whose names match a pattern, and folders.
function __{0}_files
    set -l current (commandline -ct)
    complete -C "__fish_command_without_completions $current" | string match -e -r -- "$argv[1]|/\$"
end
complete -c {0} -f
)";

/// Whether the option takes any file, which fish offers with -F instead of value_options().
bool takes_any_file(const OptionText& option) {
    return option.kind == ValueKind::File && option.extensions.empty();
}

/// The lines of a command. `begin`: `complete -c lsc -n CONDITION`.
std::string
command_lines(const std::string& program, const CommandText& command, const std::string& begin) {
    std::string text;
    for (const OptionText& option : command.options) {
        text += begin;
        for (const std::string& name : option.names) {
            text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
        }
        if (option.kind != ValueKind::None) {
            text += takes_any_file(option) ? " -r -F" : " -x";
            text += value_options(program, option);
        } else if (option.optional_value) {
            text += " -f" + value_options(program, option);
        }
        text += fmt::format(" -d {}\n", quoted(short_text(option.description)));
    }
    for (const OptionText& option : command.positionals) {
        const std::string values = value_options(program, option);
        if (!values.empty()) {
            text += begin + values + '\n';
        } else if (takes_any_file(option)) {
            text += begin + " -F\n";
        }
    }
    return text;
}

} // namespace

std::string fish_completion(const ProgramText& program) {
    const std::string& name = program.program.name;
    std::string text = fmt::format(kBegin, name);
    if (program.commands.empty()) {
        return text + command_lines(name, program.program, "complete -c " + name);
    }
    const std::string begin = fmt::format("complete -c {} -n __fish_use_subcommand", name);
    for (const CommandText& command : program.commands) {
        text += fmt::format("{} -a {} -d {}\n", begin, command.name,
                            quoted(short_text(command.description)));
    }
    text += command_lines(name, program.program, begin);
    for (const CommandText& command : program.commands) {
        text += command_lines(
            name, command,
            fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", name, command.name));
    }
    return text;
}

} // namespace lsys::pages
