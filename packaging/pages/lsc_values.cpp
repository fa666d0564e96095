// SPDX-License-Identifier: MIT
#include "packaging/pages/lsc_values.h"

#include "packaging/pages/write_pages.h"
#include "runtime/cli/command_line.h"
#include "runtime/export/export.h"

#include <CLI/CLI.hpp>

#include <initializer_list>

namespace lsys::pages {

namespace {

std::vector<std::string> and_also(std::vector<std::string> extensions,
                                  std::initializer_list<const char*> others) {
    extensions.insert(extensions.end(), others.begin(), others.end());
    return extensions;
}

std::vector<std::string> plant_formats() {
    std::vector<std::string> names;
    for (const ExportFormat format : export_formats()) {
        names.emplace_back(traits_of(format).name);
    }
    return names;
}

/// Formats of `lsc forest`: those with instances, with --bake all formats of meshes, and JSON.
std::vector<std::string> forest_formats() {
    std::vector<std::string> names;
    for (const ExportFormat format : export_formats()) {
        if (traits_of(format).write_forest != nullptr || traits_of(format).uses_mesh) {
            names.emplace_back(traits_of(format).name);
        }
    }
    return and_also(std::move(names), {"json"});
}

/// Extensions of the files that a command reads.
std::vector<std::string> input_extensions(std::string_view command) {
    if (command == "forest" || command == "place" || command == "serve" || command == "tiles") {
        return and_also(grammar_extensions(), {"toml"});
    }
    if (command == "dump" || command == "export" || command == "stats" || command == "trace") {
        return and_also(grammar_extensions(), {"lsb"});
    }
    return grammar_extensions();
}

/// Extensions of the files that a command writes; empty: any.
std::vector<std::string> output_extensions(std::string_view command) {
    if (command == "export") {
        return plant_formats();
    }
    if (command == "forest") {
        return forest_formats();
    }
    if (command == "place") {
        return {"trees"};
    }
    if (command == "compile") {
        return {"lsb"};
    }
    if (command == "import") {
        return {"lsys"};
    }
    return {};
}

} // namespace

void add_lsc_values(std::string_view command, OptionText& option) {
    add_common_values(option);
    const std::string& name = main_name(option);
    if (name == "FILE") {
        option.extensions = input_extensions(command);
    } else if (name == "--output") {
        option.extensions = output_extensions(command);
    } else if (name == "--save-state" || name == "--from") {
        option.extensions = {"lss"};
    } else if (name == "--trees") {
        option.extensions = {"trees"};
    } else if (name == "--fix") {
        option.words = {"certain", "offered"};
    }
}

ProgramText describe_lsc() {
    ProgramText text;
    lsc::visit_commands([&text](const CLI::App& program, const CLI::App& command) {
        if (text.commands.empty()) {
            text.program = describe(program, add_lsc_values);
        }
        text.commands.push_back(describe(command, add_lsc_values));
    });
    for (CommandText& command : text.commands) {
        for (OptionText& argument : command.positionals) {
            if (argument.value == "COMMAND") {
                for (const CommandText& each : text.commands) {
                    argument.words.push_back(each.name);
                }
                argument.kind = ValueKind::Words;
            }
        }
    }
    return text;
}

} // namespace lsys::pages
