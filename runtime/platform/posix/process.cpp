// SPDX-License-Identifier: MIT
#include "runtime/platform/process.h"

#include "runtime/platform/shell_program.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace lsys::platform {

namespace {

// Shells report a process that a signal ended with the status 128 plus the number of the signal.
constexpr int kSignalStatus = 128;

// Max seconds from SIGTERM or SIGHUP to the end of the process, which a full pipe may block.
constexpr unsigned kShutdownSeconds = 2;

std::atomic<bool> interrupted{false}; // the value of end_requested()
std::atomic<int> first_signal{0};     // the first signal received by on_end_signal(); 0: none
std::atomic<bool> has_alarm{false};   // on_end_signal() has set the alarm that ends the process
std::atomic<void (*)() noexcept> clean_up_before_exit{nullptr};
// Only lock-free atomics may be used in a signal handler.
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);
static_assert(std::atomic<void (*)() noexcept>::is_always_lock_free);

extern "C" void on_end_signal(int signal) {
    int none = 0;
    first_signal.compare_exchange_strong(none, signal);
    const bool again = interrupted.exchange(true);
    if (signal != SIGINT) {
        // A second SIGTERM or SIGHUP has no further effect, because timeout(1) and a closing
        // terminal send two.
        if (!has_alarm.exchange(true)) {
            ::alarm(kShutdownSeconds);
        }
    } else if (again) { // a second Ctrl-C ends the process at once
        clean_up_before_exit.load()();
        end_shell_programs();
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

extern "C" void on_alarm(int /*signal*/) {
    clean_up_before_exit.load()();
    end_shell_programs();
    ::_exit(kSignalStatus + first_signal);
}

} // namespace

std::vector<std::string> process_arguments(int argc, char** argv) {
    return {argv + 1, argv + argc};
}

std::uint64_t process_id() {
    return static_cast<std::uint64_t>(::getpid());
}

bool prepare_standard_streams() {
#if defined(O_PATH)
    constexpr int kMode = O_PATH | O_DIRECTORY;
#else
    constexpr int kMode = O_RDONLY | O_DIRECTORY;
#endif
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) {
            continue;
        }
        if (::open("/", kMode) != descriptor) {
            return false;
        }
    }
    return true;
}

bool error_stream_is_terminal() {
    const char* const kind = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) != 0 && kind != nullptr && std::strcmp(kind, "dumb") != 0;
}

void handle_end_requests(void (*clean_up)() noexcept) {
    clean_up_before_exit = clean_up;
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
    // A write beyond the file size limit (`ulimit -f`) then returns an error and sends no signal.
    std::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& end_requested() {
    return interrupted;
}

int end_status() {
    return first_signal == 0 ? 0 : kSignalStatus + first_signal;
}

} // namespace lsys::platform
