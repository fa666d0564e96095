// SPDX-License-Identifier: MIT
#include "packaging/pages/write_pages.h"

#include "grammar/base/diagnostic.h"
#include "grammar/dialects/dialect.h"
#include "packaging/pages/completion.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace lsys::pages {

namespace {

constexpr int kArguments = 4;

bool write_file(const std::filesystem::path& path, const std::string& text) {
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        std::cerr << "cannot write " << path << '\n';
    }
    return !file.fail();
}

} // namespace

std::vector<std::string> grammar_extensions() {
    std::vector<std::string> extensions;
    for (const DialectRow& row : dialects()) {
        std::istringstream words{std::string(row.extensions)};
        for (std::string word; words >> word;) {
            extensions.push_back(word.substr(1));
        }
    }
    return extensions;
}

void add_common_values(OptionText& option) {
    const std::string& name = main_name(option);
    if (option.value == "CODE") {
        for (std::uint32_t i = 0; i < diagnostic_code_count(); ++i) {
            const DiagnosticInfo& row = info(static_cast<DiagnosticCode>(i));
            // Options cannot change the level of errors; the argument of `lsc explain` is any code.
            if (option.names.empty() || row.severity != Severity::Error) {
                option.words.emplace_back(row.name);
            }
        }
        if (name == "--allow" || name == "--deny") {
            option.words.emplace_back("warnings");
        }
        if (!option.names.empty()) {
            option.words.emplace_back("notes");
        }
        option.kind = ValueKind::Words;
    } else if (name == "--stdin-name") {
        option.extensions = grammar_extensions();
    } else if (name == "--density-map" || name == "--ground-picture" ||
               name == "--ground-normals") {
        option.extensions = {"png"};
    }
}

int write_pages(int argc, char** argv, const ProgramText& program, PageInfo info) {
    if (argc != kArguments) {
        std::cerr << "usage: " << argv[0] << " FOLDER DATE VERSION\n";
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    info.date = argv[2];
    info.version = argv[3];
    const std::string& name = program.program.name;
    bool written = write_file(folder / "man" / (name + ".1"), program_page(program, info));
    for (const CommandText& command : program.commands) {
        written = write_file(folder / "man" / (name + "-" + command.name + ".1"),
                             command_page(name, command, info)) &&
                  written;
    }
    written = write_file(folder / "bash" / name, bash_completion(program)) && written;
    written = write_file(folder / "zsh" / ("_" + name), zsh_completion(program)) && written;
    written = write_file(folder / "fish" / (name + ".fish"), fish_completion(program)) && written;
    return written ? 0 : 2;
}

} // namespace lsys::pages
