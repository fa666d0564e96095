// Project: what all calls share: where files come from, how much may be used, and how a long call is
// watched and ended.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <lsys/api.h>
#include <string>
#include <vector>

namespace lsys::LSYS_INTERFACE {

/// The bytes of a file, or the reason why it cannot be read ("no such file or directory").
struct FileContents {
    bool found = false;
    std::string bytes;
    std::string reason;
};

/// How far a derivation is.
struct Progress {
    std::uint32_t generation = 0; // being derived
    std::uint32_t generations = 0;
    std::uint64_t modules = 0; // written so far of this generation
};

/// Functions of the caller. They are called from any thread, but never from two at once. An
/// exception that one throws ends the call, which throws it on.
struct Host {
    /// Reads a file: grammars, their includes, meshes, pictures, scenes. Unset: the files of the
    /// system.
    std::function<FileContents(const std::string& path)> read_file;
    /// Called some times a second and after each generation; returns false to end the call with
    /// Status::Cancelled. May be unset.
    std::function<bool(const Progress& progress)> progress;
    /// Another thread sets it to true to end the call with Status::Cancelled; the call does so itself
    /// if a function ends it. May be null.
    std::atomic<bool>* cancelled = nullptr;
};

struct Limits {
    std::uint64_t max_modules = std::uint64_t{1} << 32; // of one word
    /// Of one word, skeleton, mesh and file. 0: half of the memory of the machine.
    std::uint64_t max_bytes = 0;
};

struct Project {
    Host host;
    Limits limits;
    std::uint32_t threads = 0;      // 0: as many as the machine has
    std::vector<std::string> deny;  // codes of warnings that are errors; "warnings": all
    std::vector<std::string> allow; // codes that are not reported
};

} // namespace lsys::LSYS_INTERFACE
