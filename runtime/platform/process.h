// SPDX-License-Identifier: MIT
// The process and its environment: arguments, standard streams, terminal, and requests to end it.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys::platform {

/// The arguments after the program's name, in UTF-8. `argc` and `argv`: the parameters of main().
[[nodiscard]] std::vector<std::string> process_arguments(int argc, char** argv);

[[nodiscard]] std::uint64_t process_id();

/// Makes the standard streams binary, and opens closed standard streams, so that no other file gets
/// their descriptors. The opened streams can be neither read nor written, nor reopened as
/// /dev/stdout. They are not /dev/null, which would silently drop output. Returns false if a stream
/// cannot be opened.
[[nodiscard]] bool prepare_standard_streams();

/// Whether standard error is a terminal that can move its cursor and has colours.
[[nodiscard]] bool error_stream_is_terminal();

/// Handles Ctrl-C, and requests to end the process (SIGTERM, SIGHUP, a closing console). The first
/// of them sets end_requested(), and blocked reads return. A second Ctrl-C calls `clean_up` and
/// ends the process at once; a request other than Ctrl-C does so after two seconds. `clean_up` runs
/// in a signal handler or another thread. A write beyond the file size limit becomes an error. Call
/// handle_end_requests() at most once per process.
void handle_end_requests(void (*clean_up)() noexcept);
/// True after the first request to end the process.
[[nodiscard]] const std::atomic<bool>& end_requested();
/// Exit status of a process that ends because of a request, 128 plus the number of the signal: 130
/// for Ctrl-C, 143 for SIGTERM, 129 for SIGHUP. 0 without a request.
[[nodiscard]] int end_status();

} // namespace lsys::platform
