// SPDX-License-Identifier: MIT
// The host of the pipeline in a program: files on disk, standard input, Ctrl-C.
#pragma once

#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"
#include "runtime/program/console.h"
#include "runtime/program/run_options.h"

#include <atomic>
#include <string>

namespace lsys {

/// A host that reads files on disk. `cancelled` may be null.
[[nodiscard]] Host make_file_host(const std::atomic<bool>* cancelled);
/// A host that reads the files on disk that `policy` allows.
[[nodiscard]] Host make_file_host(const std::atomic<bool>* cancelled, const FilePolicy& policy);
/// A host that reads files on disk, and standard input for the paths `-` and `standard_input`.
/// `console` must outlive the host.
[[nodiscard]] Host
make_host(const Console& console, const std::string& standard_input, const FilePolicy& policy);

/// A project with make_host(), without progress.
[[nodiscard]] Project make_project(const Console& console, const RunOptions& run);

/// A loader of files for #include. All files together may take half of the memory. The memory is
/// queried at the first file, because the query takes as long as checking a small grammar.
/// `project` must outlive the loader.
[[nodiscard]] FileLoader make_include_loader(const Project& project);

} // namespace lsys
