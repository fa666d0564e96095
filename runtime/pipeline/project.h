// Project: what all steps of the pipeline share: the host that gives files and takes progress, and
// the limits of a run.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/limits.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys {

/// How far a derivation has come.
struct DerivationProgress {
    std::uint32_t generation = 0;  // the one that is being written
    std::uint32_t generations = 0; // asked for
    std::uint64_t modules = 0;     // written of it
    /// Modules expected of each generation from 0 on; empty where that is not known.
    const std::vector<double>& expected;
};

////// How much of a file may be read.
struct ReadLimit {
    std::uint64_t max_bytes = 0;              // of a file of its kind
    std::uint64_t memory = ~std::uint64_t{0}; // left for it: more is an Error of ErrorKind::Limit
};

/// What the pipeline asks of the program around it. The functions may be called from any thread,
/// but never from two at once.
struct Host {
    ///    /// The bytes of a file that the user names, which may be a pipe. An Error is the reason
    ///    alone:
    /// "no such file or directory".
    std::function<Result<std::string>(const std::string& path, const ReadLimit& limit)> read_file;
    /// The same of a file that another file names: a regular one, so that nobody waits for it.
    std::function<Result<std::string>(const std::string& path, const ReadLimit& limit)>
        read_named_file;
    std::function<bool(const std::string& path)> file_exists;
    /// Becomes true when the result is no longer wanted; may be null.
    const std::atomic<bool>* cancelled = nullptr;
    /// May be empty.
    std::function<void(const DerivationProgress& progress)> progress;
};

struct Project {
    Host host;
    Limits limits;             // modules of one word; bytes of each word, skeleton, mesh and file
    std::uint32_t threads = 0; // 0: as many as the machine has
    bool deny_warnings = false;

    [[nodiscard]] bool is_cancelled() const {
        return host.cancelled != nullptr && host.cancelled->load(std::memory_order_relaxed);
    }
};

} // namespace lsys
