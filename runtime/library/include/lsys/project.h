// SPDX-License-Identifier: MIT
// Project: the input that all calls share: the source of files, limits, and functions to observe
// and cancel long calls.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <lsys/api.h>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace lsys::LSYS_INTERFACE {

/// The bytes of a file, or the reason why it cannot be read ("no such file or directory").
struct FileContents {
    bool found = false;
    std::string bytes;
    std::string reason;
};

/// Progress of a derivation.
struct Progress {
    std::uint32_t generation = 0;  // generation being derived
    std::uint32_t generations = 0; // number of generations to derive
    std::uint64_t modules = 0;     // modules of this generation written so far
};

/// The pose of the turtle at a module `?NAME`, in the plant's own axes, +Y up.
struct SensePlace {
    std::array<double, 3> position{}; // m
    std::array<double, 3> heading{};  // unit vector
    std::array<double, 3> up{};       // unit vector
};

/// All modules `?NAME` of one word, in word order. The spans are valid during the call.
struct EnvironmentQuery {
    std::uint32_t generation = 0;       // age of the word
    std::span<const SensePlace> places; // places of the modules; at least one
    std::span<const float> parameters;  // parameters of the modules, one after the other
    /// By module: index of its first parameter; last: the size.
    std::span<const std::uint32_t> offsets;
};

/// The answers to a query: `size` numbers for each place, in the order of the places. They
/// overwrite the first parameters of the module.
struct EnvironmentAnswers {
    std::size_t size = 0;
    std::vector<double> numbers; // size * places
    std::string failure;         // not empty: the reason why there are no answers
};

using EnvironmentFunction = std::function<EnvironmentAnswers(const EnvironmentQuery& query)>;

/// Functions of the caller. They are called from any thread, but never from two at once. An
/// exception thrown by one of them ends the library call, which rethrows it.
struct Host {
    /// Reads a file: grammars, their includes, meshes, pictures, scenes. Unset: files are read from
    /// disk.
    std::function<FileContents(const std::string& path)> read_file;
    /// Called several times per second and after each generation; returns false to end the call
    /// with Status::Cancelled. May be unset.
    std::function<bool(const Progress& progress)> progress;
    /// Set to true by another thread to end the call with Status::Cancelled. The library sets it to
    /// true if `progress` or an exception of a callback ends the call. May be null.
    std::atomic<bool>* cancelled = nullptr;
    /// Functions that answer environments of `#sense NAME program;`, by NAME, in place of programs
    /// of `lsc --environment`.
    std::map<std::string, EnvironmentFunction> environments;
};

struct Limits {
    std::uint64_t max_modules = std::uint64_t{1} << 32; // max modules of one word
    /// Max bytes of one word, skeleton, mesh and file. 0: half of the memory of the machine.
    std::uint64_t max_bytes = 0;
};

/// Restrictions for grammars and scenes that are not trusted.
struct Policy {
    /// Grammars and scenes name only files in `root` or below: no absolute path, `..` or symbolic
    /// link leads out, and only regular files are read. Limits that are not set get defaults: for
    /// max_seconds and max_output see below, for Limits::max_bytes 1 GiB. Host::read_file is not
    /// restricted.
    bool untrusted = false;
    /// The folder of the files; empty: the folder of the grammar or scene, none for a text.
    std::string root;
    double max_seconds = 0.0;     // max duration of each call; 0: none, or 60 if untrusted
    std::uint64_t max_output = 0; // max bytes of the files of a call; 0: none, or 2^30 if untrusted
};

struct Project {
    Host host;
    Limits limits;
    std::uint32_t threads = 0;      // 0: as many as the machine has
    std::vector<std::string> deny;  // codes of warnings that count as errors; "warnings": all
    std::vector<std::string> allow; // codes that are not reported
    Policy policy{};
};

} // namespace lsys::LSYS_INTERFACE
