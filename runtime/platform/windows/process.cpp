// SPDX-License-Identifier: MIT
#include "runtime/platform/process.h"

#include "runtime/platform/windows/wide_text.h"

#include <cstdio>
#include <fcntl.h>
#include <io.h>

// shellapi.h needs windows.h before it.
// clang-format off
#include <windows.h>
#include <shellapi.h>
// clang-format on

namespace lsys::platform {

namespace {

// Exit statuses as on other systems: 128 plus the number of a signal.
constexpr int kInterruptedStatus = 130;
constexpr int kTerminatedStatus = 143;
constexpr int kHungUpStatus = 129;

std::atomic<bool> interrupted{false}; // the value of end_requested()
std::atomic<int> first_status{0};     // exit status of the first request to end; 0: none
std::atomic<void (*)() noexcept> clean_up_before_exit{nullptr};

/// Called by the system in a thread of its own. After the console was closed, the system ends the
/// process when this function returns, or after five seconds.
BOOL WINAPI on_console_event(DWORD event) {
    constexpr DWORD kShutdownMilliseconds = 2000;
    int none = 0;
    switch (event) {
    case CTRL_C_EVENT:
        first_status.compare_exchange_strong(none, kInterruptedStatus);
        if (interrupted.exchange(true)) { // a second Ctrl-C ends the process at once
            clean_up_before_exit.load()();
            ::ExitProcess(kInterruptedStatus);
        }
        return TRUE;
    case CTRL_BREAK_EVENT:
        first_status.compare_exchange_strong(none, kTerminatedStatus);
        break;
    default: // the console is closed, the user logs off, the system shuts down
        first_status.compare_exchange_strong(none, kHungUpStatus);
        break;
    }
    interrupted = true;
    ::Sleep(kShutdownMilliseconds);
    clean_up_before_exit.load()();
    ::ExitProcess(static_cast<UINT>(first_status.load()));
}

} // namespace

std::vector<std::string> process_arguments(int argc, char** argv) {
    int count = 0;
    LPWSTR* const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    if (words == nullptr) {
        return {argv + 1, argv + argc};
    }
    std::vector<std::string> arguments;
    for (int i = 1; i < count; ++i) {
        arguments.push_back(utf8_text(words[i]));
    }
    ::LocalFree(words);
    return arguments;
}

std::uint64_t process_id() {
    return ::GetCurrentProcessId();
}

bool prepare_standard_streams() {
    // Closed streams stay closed: Windows gives their descriptors to no other file. Open streams
    // become binary: text mode would write CR LF for each LF and end input at Ctrl-Z.
    for (std::FILE* const stream : {stdin, stdout, stderr}) {
        const int descriptor = ::_fileno(stream);
        if (descriptor >= 0) {
            ::_setmode(descriptor, _O_BINARY);
        }
    }
    return true;
}

bool error_stream_is_terminal() {
    const HANDLE handle = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return ::GetConsoleMode(handle, &mode) != 0 &&
           ::SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0 &&
           ::SetConsoleOutputCP(CP_UTF8) != 0;
}

void handle_end_requests(void (*clean_up)() noexcept) {
    clean_up_before_exit = clean_up;
    ::SetConsoleCtrlHandler(on_console_event, TRUE);
}

const std::atomic<bool>& end_requested() {
    return interrupted;
}

int end_status() {
    return first_status;
}

} // namespace lsys::platform
