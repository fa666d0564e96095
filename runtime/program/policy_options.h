// SPDX-License-Identifier: MIT
// The options for grammars and scenes that are not trusted: --untrusted, --root, --max-time,
// --max-output. SECURITY.md states what they promise.
#pragma once

#include "runtime/program/run_options.h"
#include "runtime/program/usage.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lsys {

/// Whether files of grammars and scenes are trusted if the command line does not tell.
enum class Trust : std::uint8_t { Trusted, Untrusted };

/// Adds --untrusted and --root, and --trusted to a command that does not trust files by default.
void add_file_policy(CLI::App& app, RunOptions& run, Trust trust);
/// Adds --max-time with the help `text`.
void add_time_limit(CLI::App& app, RunOptions& run, const char* text);
/// Adds --max-time, for the whole command, and --max-output.
void add_run_policy(CLI::App& app, RunOptions& run);

/// Completes the options after the command line has been read: the limits that --untrusted implies,
/// and `named`, the files that the user names. Returns a mistake in the combination of options.
[[nodiscard]] std::optional<UsageError>
apply_policy(const CLI::App& app, std::vector<std::string> named, RunOptions& run);

} // namespace lsys
