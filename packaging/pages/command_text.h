// SPDX-License-Identifier: MIT
// The command line of a program as data, read from its CLI11 tree. Man pages and completions of
// shells are written from it, so they name the commands, options and values that the program takes.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace lsys::pages {

enum class ValueKind { None, Text, Words, File, Folder };

/// An option or a positional argument.
struct OptionText {
    std::vector<std::string> names; // `-o`, `--output`; empty for a positional
    std::string value;              // `FILE`, `human|short|json`; empty for a flag
    std::string description;
    std::string group; // heading in --help
    ValueKind kind = ValueKind::None;
    std::vector<std::string> words;      // literal values, such as `human`; possible with any kind
    std::vector<std::string> extensions; // for ValueKind::File, without dots; empty: any file
    bool required = false;
    bool repeatable = false;
    bool optional_value = false; // the value may be missing: `--fix`, `--fix=offered`
};

/// A command, or a program.
struct CommandText {
    std::string name; // name of the command, `export`, or of the program, `lsc`
    std::string description;
    std::vector<OptionText> positionals;
    std::vector<OptionText> options; // in the order of --help
    std::string footer;              // lines as in --help
};

struct ProgramText {
    CommandText program;
    std::vector<CommandText> commands; // may be empty
};

/// Adds the data of an option that CLI11 lacks: words and extensions. `command`: the name of the
/// command or program.
using AddValues = std::function<void(std::string_view command, OptionText& option)>;

[[nodiscard]] CommandText describe(const CLI::App& app, const AddValues& add_values);

/// The most descriptive name: `--output` of `-o,--output`, `FILE` of a positional.
[[nodiscard]] const std::string& main_name(const OptionText& option);

} // namespace lsys::pages
