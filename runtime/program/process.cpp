#include "runtime/program/process.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace lsys {

namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free); // or a handler may not touch it

extern "C" void on_interrupt(int signal) {
    // The second Ctrl-C does not wait.
    if (interrupted.exchange(true)) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

bool is_capable_terminal(int descriptor) {
    const char* const kind = std::getenv("TERM");
    return ::isatty(descriptor) != 0 && kind != nullptr && std::strcmp(kind, "dumb") != 0;
}

} // namespace

int run_process(int argc,
                char** argv,
                const char* program,
                int (*run)(std::span<const std::string> arguments, const Io& io)) {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    ::sigaction(SIGINT, &action, nullptr); // without SA_RESTART, so that a blocked read returns
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return run(arguments, {std::cin, std::cout, std::cerr, is_capable_terminal(STDERR_FILENO),
                           &interrupted, program});
}

} // namespace lsys
