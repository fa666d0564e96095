// SPDX-License-Identifier: MIT
#include "runtime/cli/lsc.h"
#include "runtime/program/exit_status.h"
#include "runtime/program/process.h"
#include "runtime/program/temporaries.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <revision.h>

namespace {

std::terminate_handler default_handler = nullptr;

/// Called for exceptions that nothing can catch. Memory may run out in functions of libraries that
/// are declared noexcept, and before main() begins, when libraries make their global objects.
[[noreturn]] void end_program() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        lsys::remove_temporaries();
        std::fputs("lsc: error: out of memory\n", stderr);
        std::_Exit(static_cast<int>(lsys::ExitStatus::Limit));
    } catch (...) { // an internal error
    }
    default_handler();
    std::abort();
}

/// Runs before the constructors of global objects: 101 is the first priority of programs.
[[gnu::constructor(101)]] void set_terminate_handler() {
    default_handler = std::set_terminate(end_program);
}

} // namespace

int main(int argc, char** argv) {
    return lsys::run_process(argc, argv, "lsc", LSYS_REVISION, lsys::lsc::run);
}
