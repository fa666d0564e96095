#include "runtime/program/process.h"

#include "runtime/program/console.h"
#include "runtime/program/temporaries.h"

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

namespace lsys {

namespace {

// Shells report a process that a signal ended with the status 128 plus the number of the signal.
constexpr int kSignalStatus = 128;
static_assert(kSignalStatus + SIGINT == static_cast<int>(ExitStatus::Interrupted));

// Max seconds from SIGTERM or SIGHUP to the end of the process, which a full pipe may block.
constexpr unsigned kShutdownSeconds = 2;

std::atomic<bool> interrupted{false};
std::atomic<int> first_signal{0}; // the first signal received by on_end_signal(); 0: none
std::atomic<bool> has_alarm{false};
// Only lock-free atomics may be used in a signal handler.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void on_end_signal(int signal) {
    int none = 0;
    first_signal.compare_exchange_strong(none, signal);
    const bool again = interrupted.exchange(true);
    if (signal != SIGINT) {
        // A second SIGTERM or SIGHUP has no further effect, since timeout(1) and a closing terminal
        // send two.
        if (!has_alarm.exchange(true)) {
            ::alarm(kShutdownSeconds);
        }
    } else if (again) { // a second Ctrl-C ends the process at once
        remove_temporaries();
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

extern "C" void on_alarm(int /*signal*/) {
    remove_temporaries();
    ::_exit(kSignalStatus + first_signal);
}

void handle_signals() {
    struct sigaction action {};
    action.sa_handler = on_end_signal; // without SA_RESTART, so that a blocked read returns
    ::sigaction(SIGINT, &action, nullptr);
    for (const int signal : {SIGTERM, SIGHUP}) {
        struct sigaction inherited {};
        ::sigaction(signal, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) { // nohup(1) sets SIG_IGN, which stays in effect
            ::sigaction(signal, &action, nullptr);
        }
    }
    action.sa_handler = on_alarm;
    ::sigaction(SIGALRM, &action, nullptr);
    // Then a write beyond the file size limit (`ulimit -f`) returns an error instead of a signal.
    std::signal(SIGXFSZ, SIG_IGN);
}

/// Opens standard streams that are closed, so that no other file gets their descriptors. The opened
/// streams can be neither read nor written, nor reopened as /dev/stdout. They are not /dev/null,
/// which would silently drop output.
void fill_standard_streams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) {
            continue;
        }
        if (::open("/", O_PATH | O_DIRECTORY) != descriptor) {
            ::_exit(static_cast<int>(ExitStatus::Failure)); // without a stream for a message
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
                const char* revision,
                int (*run)(std::span<const std::string> arguments, const Io& io)) {
    fill_standard_streams();
    handle_signals();
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const int status =
        run(arguments, {std::cin, std::cout, std::cerr, is_capable_terminal(STDERR_FILENO),
                        &interrupted, program, revision});
    const bool was_ended = status == static_cast<int>(ExitStatus::Interrupted) && first_signal != 0;
    return was_ended ? kSignalStatus + first_signal : status;
}

int report_out_of_memory(const Io& io) {
    io.err << io.program << ": error: out of memory\n" << std::flush;
    return static_cast<int>(ExitStatus::Limit);
}

} // namespace lsys
