// SPDX-License-Identifier: MIT
#include "packaging/pages/completion.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys::pages {

namespace {

std::string joined(const std::vector<std::string>& texts, const char* separator) {
    return fmt::format("{}", fmt::join(texts, separator));
}

/// The command that completes a value. `prefix`: prefix of the names of helper functions.
std::string completer(const OptionText& option, const std::string& prefix) {
    std::vector<std::string> parts;
    if (!option.words.empty()) {
        parts.push_back(fmt::format("{}_words '{}'", prefix, joined(option.words, " ")));
    }
    if (option.kind == ValueKind::File) {
        parts.push_back(fmt::format("{}_files '{}'", prefix, name_pattern(option.extensions)));
    } else if (option.kind == ValueKind::Folder) {
        parts.push_back(prefix + "_folders");
    }
    return parts.empty() ? ":" : joined(parts, "; ");
}

/// A function that completes the arguments of one command.
std::string
command_function(const std::string& name, const CommandText& command, const std::string& prefix) {
    std::string text = fmt::format("{}() {{\n    case $option in\n", name);
    std::vector<std::string> names;
    for (const OptionText& option : command.options) {
        names.insert(names.end(), option.names.begin(), option.names.end());
        if (option.kind != ValueKind::None || option.optional_value) {
            text += fmt::format("        {}) {} ;;\n", joined(option.names, "|"),
                                completer(option, prefix));
        }
    }
    text += fmt::format("        *)\n            if [[ $current == -* ]]; then\n"
                        "                {}_words '{}'\n",
                        prefix, joined(names, " "));
    text += fmt::format(
        "            else\n                {}\n            fi\n            ;;\n    esac\n}}\n",
        command.positionals.empty() ? ":" : completer(command.positionals.front(), prefix));
    return text;
}

constexpr const char* kHelpers = R"(# Completion of {0} for bash.

{1}_words() {{
    COMPREPLY+=($(compgen -W "$1" -- "$current"))
}}
# Files whose names match a pattern, and folders.
{1}_files() {{
    local name
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do
        [[ -z $1 || -d $name || $name =~ $1 ]] && COMPREPLY+=("$name")
    done < <(compgen -f -- "$current")
}}
{1}_folders() {{
    local name
    compopt -o filenames 2>/dev/null
    while IFS= read -r name; do
        COMPREPLY+=("$name")
    done < <(compgen -d -- "$current")
}}
)";

/// The beginning of the function that bash calls. bash splits words at `=`: `--stage=word` is the
/// option `--stage` with the value `word`. {2} drops an option whose value must follow a `=`.
constexpr const char* kEntry = R"({1}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} option=
    COMPREPLY=()
    if ((COMP_CWORD >= 2)) && [[ ${{COMP_WORDS[COMP_CWORD - 1]}} == "=" ]]; then
        option=${{COMP_WORDS[COMP_CWORD - 2]}}
    elif ((COMP_CWORD >= 2)) && [[ $current == "=" ]]; then
        option=${{COMP_WORDS[COMP_CWORD - 1]}} current=
    elif ((COMP_CWORD >= 1)) && [[ ${{COMP_WORDS[COMP_CWORD - 1]}} == -* ]]; then
        option=${{COMP_WORDS[COMP_CWORD - 1]}}
        {2}
    fi
)";

/// Names of options whose value may be missing, of all commands.
std::vector<std::string> optional_names(const ProgramText& program) {
    std::vector<std::string> names;
    const auto add = [&names](const CommandText& command) {
        for (const OptionText& option : command.options) {
            if (option.optional_value) {
                names.insert(names.end(), option.names.begin(), option.names.end());
            }
        }
    };
    add(program.program);
    std::for_each(program.commands.begin(), program.commands.end(), add);
    return names;
}

} // namespace

std::string bash_completion(const ProgramText& program) {
    const std::string& name = program.program.name;
    const std::string prefix = "_" + name;
    std::string text = fmt::format(kHelpers, name, prefix);
    text += command_function(prefix + "__program", program.program, prefix);
    std::vector<std::string> names;
    for (const CommandText& command : program.commands) {
        names.push_back(command.name);
        text += command_function(fmt::format("{}__{}", prefix, command.name), command, prefix);
    }
    const std::vector<std::string> optional = optional_names(program);
    const std::string drop = optional.empty() ? ":"
                                              : fmt::format("case $option in {}) option= ;; esac",
                                                            joined(optional, "|"));
    std::string entry = fmt::format(kEntry, name, prefix, drop);
    if (program.commands.empty()) {
        entry += fmt::format("    {}__program\n}}\n", prefix);
    } else {
        entry += "    if ((COMP_CWORD == 1)) && [[ $current != -* ]]; then\n";
        entry += fmt::format("        {}_words '{}'\n        return\n    fi\n", prefix,
                             joined(names, " "));
        entry += "    case ${COMP_WORDS[1]} in\n";
        for (const std::string& command : names) {
            entry += fmt::format("        {0}) {1}__{0} ;;\n", command, prefix);
        }
        entry += fmt::format("        *) {}__program ;;\n    esac\n}}\n", prefix);
    }
    return text + entry + fmt::format("complete -F {} {}\n", prefix, name);
}

} // namespace lsys::pages
