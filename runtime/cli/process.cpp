#include "runtime/cli/process.h"

#include "runtime/cli/console.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace lsys::lsc {

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

/// Opens the standard streams that are closed, or the first files of the run would take their
/// numbers and get what is meant for them. In the opposite direction, so that using them fails.
void fill_standard_streams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) {
            continue;
        }
        const int direction = descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        if (::open("/dev/null", direction) != descriptor &&
            ::open("/", O_RDONLY | O_DIRECTORY) != descriptor) {
            ::_exit(static_cast<int>(Status::Failure)); // nowhere to say why
        }
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
    fill_standard_streams();
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    ::sigaction(SIGINT, &action, nullptr); // without SA_RESTART, so that a blocked read returns
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    return run(arguments, {std::cin, std::cout, std::cerr, is_capable_terminal(STDERR_FILENO),
                           &interrupted, program});
}

} // namespace lsys::lsc
