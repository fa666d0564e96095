// SPDX-License-Identifier: MIT
#include "runtime/program/process.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/platform/process.h"
#include "runtime/platform/shell_program.h"
#include "runtime/program/console.h"
#include "runtime/program/temporaries.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

namespace lsys {

namespace {

/// Ends the process although other threads still work, so no stream may be used or destroyed.
void end_at_limit(const char* line) {
    remove_temporaries();
    platform::end_shell_programs();
    std::fputs(line, stderr);
    std::_Exit(static_cast<int>(ExitStatus::Limit));
}

} // namespace

int run_process(int argc,
                char** argv,
                const char* program,
                const char* revision,
                int (*run)(std::span<const std::string> arguments, const Io& io)) {
    if (!platform::prepare_standard_streams()) {
        std::_Exit(static_cast<int>(ExitStatus::Failure)); // no stream is left for a message
    }
    platform::handle_end_requests(remove_temporaries);
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    Io io{std::cin,
          std::cout,
          std::cerr,
          platform::error_stream_is_terminal(),
          &platform::end_requested(),
          program,
          revision};
    io.end_at_limit = end_at_limit;
    const int status =
        catch_out_of_memory([&] { return run(platform::process_arguments(argc, argv), io); },
                            [&] { return report_out_of_memory(io); });
    const int end_status = platform::end_status();
    const bool was_ended = status == static_cast<int>(ExitStatus::Interrupted) && end_status != 0;
    return was_ended ? end_status : status;
}

int report_out_of_memory(const Io& io) {
    io.err << io.program << ": error: out of memory\n" << std::flush;
    return static_cast<int>(ExitStatus::Limit);
}

} // namespace lsys
