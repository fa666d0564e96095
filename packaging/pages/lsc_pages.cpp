// SPDX-License-Identifier: MIT
// Writes the man pages and completions of lsc: lsc_pages FOLDER DATE VERSION.
#include "packaging/pages/lsc_values.h"
#include "packaging/pages/write_pages.h"

int main(int argc, char** argv) {
    using namespace lsys::pages;
    PageInfo info;
    info.statuses = {
        {"0", "success"},
        {"1", "errors in a grammar"},
        {"2", "a mistake in the command line, or a file that cannot be read or written"},
        {"3", "a limit: `--max-modules`, `--max-memory`, `--max-time`, `--max-output`, or one of "
              "the file "
              "format"},
        {"130", "interrupted"}};
    const ProgramText program = describe_lsc();
    info.see_also.push_back("lsc");
    for (const CommandText& command : program.commands) {
        info.see_also.push_back("lsc-" + command.name);
    }
    info.see_also.push_back("lsview");
    return write_pages(argc, argv, program, info);
}
