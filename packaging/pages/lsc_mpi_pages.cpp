// SPDX-License-Identifier: MIT
// Writes the man pages and completions of lsc-mpi: lsc_mpi_pages FOLDER DATE VERSION.
#include "packaging/pages/lsc_values.h"
#include "packaging/pages/write_pages.h"
#include "runtime/mpi/command_line.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
    using namespace lsys::pages;
    PageInfo info;
    info.statuses = {
        {"0", "success"},
        {"1", "errors in a grammar, or of a process while it writes"},
        {"2", "a mistake in the command line, or a file that cannot be read or written"},
        {"3", "a limit: `--max-modules`, `--max-memory`, or one of the file format"},
        {"130", "interrupted"}};
    info.see_also = {"lsc-mpi", "lsc-mpi-tiles", "lsc-tiles", "mpirun"};
    ProgramText text;
    lsys::mpi::visit_command([&text](const CLI::App& program, const CLI::App& command) {
        text.program = describe(program, add_lsc_values);
        text.commands.push_back(describe(command, add_lsc_values));
    });
    return write_pages(argc, argv, text, info);
}
