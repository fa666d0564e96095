// SPDX-License-Identifier: MIT
// Writes the man page and completions of lsview: lsview_pages FOLDER DATE VERSION.
#include "packaging/pages/write_pages.h"
#include "viewer/app/options.h"

#include <CLI/CLI.hpp>

#include <string_view>

namespace {

using namespace lsys::pages;

void add_values(std::string_view /*command*/, OptionText& option) {
    add_common_values(option);
    const std::string& name = main_name(option);
    if (name == "FILE") {
        option.extensions = grammar_extensions();
        option.extensions.insert(option.extensions.end(), {"lsb", "toml"});
    } else if (name == "--screenshot") {
        option.extensions = {"png"};
    } else if (name == "--stats") {
        option.extensions = {"json"};
    }
}

} // namespace

int main(int argc, char** argv) {
    PageInfo info;
    info.statuses = {{"0", "success"},
                     {"1", "errors in a grammar"},
                     {"2", "a mistake in the command line, a file, or the display"},
                     {"3", "a limit: `--max-modules` or `--max-memory`"},
                     {"130", "interrupted"}};
    info.see_also = {"lsview", "lsc"};
    ProgramText program;
    lsys::view::visit_options(
        [&program](const CLI::App& app) { program.program = describe(app, add_values); });
    return write_pages(argc, argv, program, info);
}
