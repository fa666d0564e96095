// SPDX-License-Identifier: MIT
#include "runtime/platform/child.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

// POSIX; unistd.h declares it on some systems only.
extern char** environ; // NOLINT(readability-redundant-declaration)

namespace lsys::platform {

std::string find_program(const std::string& name) {
    const char* const variable = std::getenv("PATH");
    std::string_view folders = variable == nullptr ? "" : variable;
    while (!folders.empty()) {
        const std::size_t end = folders.find(':');
        std::string path = std::string(folders.substr(0, end)) + '/' + name;
        if (facts_of(path).type == FileType::Regular && ::access(path.c_str(), X_OK) == 0) {
            return path;
        }
        folders.remove_prefix(end == std::string_view::npos ? folders.size() : end + 1);
    }
    return {};
}

namespace {

/// Starts a program without standard input and output. `messages`: the file of its standard error.
Reason spawn(const std::vector<std::string>& arguments,
             const std::string& messages,
             bool has_own_session,
             pid_t& child) {
    constexpr mode_t kMode = 0600;
    posix_spawn_file_actions_t streams;
    ::posix_spawn_file_actions_init(&streams);
    ::posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, messages.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, kMode);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
#ifdef POSIX_SPAWN_SETSID
    if (has_own_session) {
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    }
#else
    static_cast<void>(has_own_session);
#endif
    std::vector<char*> texts;
    texts.reserve(arguments.size() + 1);
    for (const std::string& each : arguments) {
        texts.push_back(const_cast<char*>(each.c_str())); // posix_spawn() does not change it
    }
    texts.push_back(nullptr);
    const int reason =
        ::posix_spawn(&child, texts[0], &streams, &attributes, texts.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&streams);
    return reason;
}

/// The exit status of a program that has ended; -1 if a signal ended it.
int exit_status(int ended) {
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
}

} // namespace

Reason run_program(const std::vector<std::string>& arguments,
                   const std::string& messages,
                   const std::atomic<bool>& cancelled,
                   int& status) {
    constexpr unsigned kWait = 20'000; // microseconds between two checks of the program
    pid_t child = 0;
    if (const Reason reason = spawn(arguments, messages, false, child); reason != 0) {
        return reason;
    }
    int ended = 0;
    bool is_told = false;
    for (pid_t done = 0; done == 0;) {
        done = ::waitpid(child, &ended, WNOHANG);
        if (done < 0 && errno != EINTR) {
            return errno;
        }
        done = done < 0 ? 0 : done;
        if (done == 0) {
            if (cancelled && !is_told) {
                is_told = true;
                ::kill(child, SIGKILL);
            }
            ::usleep(kWait);
        }
    }
    status = exit_status(ended);
    return 0;
}

Reason start_program(const std::vector<std::string>& arguments, Child& child) {
    return spawn(arguments, "/dev/null", true, child.process_id);
}

bool has_ended(Child& child, int& status) {
    int ended = 0;
    if (child.process_id == 0 || ::waitpid(child.process_id, &ended, WNOHANG) != child.process_id) {
        return false;
    }
    status = exit_status(ended);
    child = {};
    return true;
}

} // namespace lsys::platform
