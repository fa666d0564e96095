// The host of the pipeline in a program: files of the disk and of standard input, Ctrl-C.
#pragma once

#include "runtime/pipeline/project.h"
#include "runtime/program/console.h"
#include "runtime/program/run_options.h"

#include <atomic>

namespace lsys {

/// Reads files of the disk. `cancelled` may be null.
[[nodiscard]] Host make_file_host(const std::atomic<bool>* cancelled);
/// Reads files of the disk, and standard input for `-`. `console` outlives it.
[[nodiscard]] Host make_host(const Console& console);

/// A project with that host, without progress.
[[nodiscard]] Project make_project(const Console& console, const RunOptions& run);

} // namespace lsys
