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

// Shells show a process that a signal ended as 128 and the signal's number.
constexpr int kSignalStatus = 128;
static_assert(kSignalStatus + SIGINT == static_cast<int>(ExitStatus::Interrupted));

// Seconds to end in after SIGTERM or SIGHUP; a run that waits for a pipe does not see them.
constexpr unsigned kShutdownSeconds = 2;

std::atomic<bool> interrupted{false};
std::atomic<int> first_signal{0}; // that asked the process to end
std::atomic<bool> has_alarm{false};
// Or a handler may not touch them.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void on_end_signal(int signal) {
    int none = 0;
    first_signal.compare_exchange_strong(none, signal);
    const bool again = interrupted.exchange(true);
    if (signal != SIGINT) {
        // Sent twice by timeout(1) and by shells that lose their terminal, so a second one says
        // nothing new.
        if (!has_alarm.exchange(true)) {
            ::alarm(kShutdownSeconds);
        }
    } else if (again) { // the second Ctrl-C does not wait
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
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) { // as nohup(1) has it
            ::sigaction(signal, &action, nullptr);
        }
    }
    action.sa_handler = on_alarm;
    ::sigaction(SIGALRM, &action, nullptr);
    // A file that grows beyond `ulimit -f` is an error of the write, which is reported.
    std::signal(SIGXFSZ, SIG_IGN);
}

/// Opens the standard streams that are closed, or the first files of the run would take their
/// numbers and get what is meant for them. What they become can be neither read nor written, nor
/// opened anew as /dev/stdout: /dev/null would swallow the output.
void fill_standard_streams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) {
            continue;
        }
        if (::open("/", O_PATH | O_DIRECTORY) != descriptor) {
            ::_exit(static_cast<int>(ExitStatus::Failure)); // nowhere to say why
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
    handle_signals();
    std::ios::sync_with_stdio(false);
    std::cin.tie(nullptr);
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const int status = run(arguments, {std::cin, std::cout, std::cerr,
                                       is_capable_terminal(STDERR_FILENO), &interrupted, program});
    const bool was_ended = status == static_cast<int>(ExitStatus::Interrupted) && first_signal != 0;
    return was_ended ? kSignalStatus + first_signal : status;
}

} // namespace lsys
