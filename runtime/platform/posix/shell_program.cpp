// SPDX-License-Identifier: MIT
#include "runtime/platform/shell_program.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

// POSIX; unistd.h declares it on some systems only.
extern char** environ; // NOLINT(readability-redundant-declaration)

namespace lsys::platform {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxMessages = 4096; // max characters of messages_
constexpr int kWait = 50;                  // milliseconds between two checks of `cancelled`

// Process groups that end_shell_programs() ends. Programs that find no free entry are not ended by
// it.
std::array<std::atomic<int>, 256> running{};
static_assert(std::atomic<int>::is_always_lock_free);

/// Adds a process group to `running`.
void remember(int process) {
    for (std::atomic<int>& each : running) {
        int none = 0;
        if (each.compare_exchange_strong(none, process)) {
            return;
        }
    }
}

/// Removes a process group from `running`.
void forget(int process) {
    for (std::atomic<int>& each : running) {
        int known = process;
        if (each.compare_exchange_strong(known, 0)) {
            return;
        }
    }
}

void close_descriptor(int& descriptor) {
    if (descriptor >= 0) {
        ::close(descriptor);
        descriptor = -1;
    }
}

struct Pipe {
    int read = -1;
    int write = -1;

    Pipe() = default;
    ~Pipe() {
        close_descriptor(read);
        close_descriptor(write);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    [[nodiscard]] bool open() {
        std::array<int, 2> ends{};
#if defined(__linux__)
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
            return false;
        }
#else
        if (::pipe(ends.data()) != 0) {
            return false;
        }
        ::fcntl(ends[0], F_SETFD, FD_CLOEXEC);
        ::fcntl(ends[1], F_SETFD, FD_CLOEXEC);
#endif
        read = ends[0];
        write = ends[1];
        return true;
    }
};

void set_non_blocking(int descriptor) {
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK);
}

/// write() without SIGPIPE, which would end this process.
ssize_t write_quietly(int descriptor, const char* bytes, std::size_t count) {
    sigset_t pipe_signal;
    sigset_t before;
    sigset_t waiting;
    ::sigemptyset(&pipe_signal);
    ::sigaddset(&pipe_signal, SIGPIPE);
    ::sigpending(&waiting);
    const bool was_waiting = ::sigismember(&waiting, SIGPIPE) == 1;
    ::pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
    const ssize_t written = ::write(descriptor, bytes, count);
    const int reason = errno;
    if (written < 0 && reason == EPIPE && !was_waiting) {
        int signal = 0;
        ::sigwait(&pipe_signal, &signal);
    }
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    errno = reason;
    return written;
}

/// Whether a read or write that failed with the errno `reason` may succeed later.
bool may_be_repeated(int reason) {
    return reason == EAGAIN || reason == EINTR;
}

} // namespace

/// The lines of one call of ask().
struct ShellProgram::Exchange {
    std::string out;             // bytes to be written
    std::size_t written = 0;     // number of bytes of `out` that have been written
    std::uint64_t max_bytes = 0; // max bytes of the answer
};

ShellProgram::~ShellProgram() {
    end();
}

Reason ShellProgram::start(const std::string& command) {
    Pipe input;
    Pipe output;
    Pipe error;
    if (!input.open() || !output.open() || !error.open()) {
        return errno;
    }
    posix_spawn_file_actions_t streams;
    ::posix_spawn_file_actions_init(&streams);
    ::posix_spawn_file_actions_adddup2(&streams, input.read, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&streams, output.write, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&streams, error.write, STDERR_FILENO);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    std::string shell = "/bin/sh";
    std::string option = "-c";
    std::string text = command;
    std::array<char*, 4> arguments{shell.data(), option.data(), text.data(), nullptr};
    pid_t process = 0;
    const int reason =
        ::posix_spawn(&process, shell.c_str(), &streams, &attributes, arguments.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&streams);
    if (reason != 0) {
        return reason;
    }
    process_ = process;
    remember(process_);
    input_ = std::exchange(input.write, -1);
    output_ = std::exchange(output.read, -1);
    error_ = std::exchange(error.read, -1);
    set_non_blocking(input_);
    set_non_blocking(output_);
    set_non_blocking(error_);
    return 0;
}

void ShellProgram::end() {
    if (process_ == 0) {
        return;
    }
    close_descriptor(input_);
    siginfo_t facts{};
    const bool has_ended =
        ::waitid(P_PID, static_cast<id_t>(process_), &facts, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        facts.si_pid != 0;
    ::kill(-process_, SIGKILL);
    int ended = 0;
    while (::waitpid(process_, &ended, 0) < 0 && errno == EINTR) {
    }
    if (exit_text_.empty() && has_ended) {
        exit_text_ = WIFEXITED(ended) ? "exit status " + std::to_string(WEXITSTATUS(ended))
                                      : "signal " + std::to_string(WTERMSIG(ended));
    }
    forget(process_);
    process_ = 0;
    read_messages();
    close_descriptor(output_);
    close_descriptor(error_);
}

/// Waits up to half a second for a program that has closed its output, or whose input is closed, so
/// that it can exit with its own status and messages before end() kills it.
void ShellProgram::wait_for_exit() {
    constexpr int kMaxPolls = 50;
    constexpr unsigned kPause = 10'000; // microseconds
    for (int i = 0; i < kMaxPolls; ++i) {
        siginfo_t facts{};
        if (::waitid(P_PID, static_cast<id_t>(process_), &facts, WEXITED | WNOHANG | WNOWAIT) !=
                0 ||
            facts.si_pid != 0) {
            return;
        }
        ::usleep(kPause);
    }
}

void ShellProgram::finish() {
    if (process_ != 0) {
        close_descriptor(input_);
        wait_for_exit();
        end();
    }
}

bool ShellProgram::write_some(Exchange& exchange) {
    const std::string_view rest = std::string_view(exchange.out).substr(exchange.written);
    const ssize_t count = write_quietly(input_, rest.data(), rest.size());
    if (count > 0) {
        exchange.written += static_cast<std::size_t>(count);
    }
    if (count < 0 && errno == EPIPE) { // the program reads no more, but may still answer
        close_descriptor(input_);
        exchange.written = exchange.out.size();
    }
    return count >= 0 || errno == EPIPE || may_be_repeated(errno);
}

/// Returns false at the end of the output, or after an error.
bool ShellProgram::read_some(Exchange& exchange) {
    std::array<char, 65536> bytes; // NOLINT(cppcoreguidelines-pro-type-member-init)
    while (read_.size() <= exchange.max_bytes) {
        const ssize_t count = ::read(output_, bytes.data(), bytes.size());
        if (count <= 0) {
            return count < 0 && may_be_repeated(errno);
        }
        read_.append(bytes.data(), static_cast<std::size_t>(count));
        if (read_.find('\n', read_.size() - static_cast<std::size_t>(count)) != std::string::npos) {
            return true;
        }
    }
    return true;
}

void ShellProgram::read_messages() {
    std::array<char, 4096> bytes; // NOLINT(cppcoreguidelines-pro-type-member-init)
    // Max reads per call, so that a flood of messages does not block it.
    constexpr int kMaxReads = 256;
    for (int i = 0; i < kMaxReads && error_ >= 0; ++i) {
        const ssize_t count = ::read(error_, bytes.data(), bytes.size());
        if (count <= 0) {
            if (count == 0) {
                close_descriptor(error_);
            }
            return;
        }
        messages_.append(bytes.data(), static_cast<std::size_t>(count));
        if (messages_.size() > kMaxMessages) {
            messages_.erase(0, messages_.size() - kMaxMessages);
        }
    }
}

ShellProgram::Reply ShellProgram::ask(const std::string& line,
                                      double seconds,
                                      std::uint64_t max_bytes,
                                      const std::atomic<bool>* cancelled,
                                      std::string& answer) {
    if (process_ == 0) {
        return Reply::Ended;
    }
    Exchange exchange{line + '\n', 0, max_bytes};
    const Clock::time_point deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                          std::chrono::duration<double>(seconds));
    const auto ended_with = [&](Reply reply) {
        end();
        return reply;
    };
    std::size_t searched = 0; // bytes of read_ without a line break
    for (bool is_open = true;;) {
        const std::size_t line_end = read_.find('\n', searched);
        searched = read_.size();
        if (line_end > max_bytes && read_.size() > max_bytes) {
            return ended_with(Reply::TooLong);
        }
        if (line_end != std::string::npos) {
            answer.assign(read_, 0, line_end);
            read_.erase(0, line_end + 1);
            return Reply::Line;
        }
        if (!is_open) {
            wait_for_exit();
            return ended_with(Reply::Ended);
        }
        if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
            return ended_with(Reply::Cancelled);
        }
        if (Clock::now() >= deadline) {
            return ended_with(Reply::TimedOut);
        }
        const bool has_more = exchange.written < exchange.out.size() && input_ >= 0;
        std::array<pollfd, 3> waits{pollfd{output_, POLLIN, 0}, pollfd{error_, POLLIN, 0},
                                    pollfd{has_more ? input_ : -1, POLLOUT, 0}};
        if (::poll(waits.data(), waits.size(), kWait) < 0 && errno != EINTR) {
            return ended_with(Reply::Failed);
        }
        read_messages();
        if (has_more && waits[2].revents != 0 && !write_some(exchange)) {
            return ended_with(Reply::Failed);
        }
        is_open = waits[0].revents == 0 || read_some(exchange);
    }
}

void end_shell_programs() noexcept {
    for (const std::atomic<int>& each : running) {
        if (const int process = each; process != 0) {
            ::kill(-process, SIGKILL);
        }
    }
}

} // namespace lsys::platform
