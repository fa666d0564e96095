// SPDX-License-Identifier: MIT
// The files that a command or call writes together: on disk, all of them appear or none; a receiver
// gets them in order.
#pragma once

#include "runtime/export/export.h"
#include "runtime/program/console.h"
#include "runtime/program/files.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// A piece of a file. Pieces of one file are consecutive; the last one is empty.
struct FilePiece {
    std::string_view name;
    std::string_view bytes;
    bool is_last = false;
};
/// Receives files instead of a folder; returns false to stop the export.
using FileReceiver = std::function<bool(const FilePiece& piece)>;

/// The context of a call that writes files. All parts must outlive the call.
struct OutputContext {
    const Console& console;
    const Project& project;
    std::string generator;                     // program and version, written into the files
    const FileReceiver* receiver = nullptr;    // null: files on disk
    std::vector<std::string>* paths = nullptr; // if not null, gets the paths of the files

    /// Whether other files can be written beside `path`: `path` is or will be a regular file, or a
    /// receiver takes the files.
    [[nodiscard]] bool can_write_beside(const std::string& path) const;
};

/// The name of a `.mtl` file as an OBJ file writes it, in a line of its own. An Error for a name
/// with control characters or bytes that are not UTF-8, which OBJ cannot express.
[[nodiscard]] Result<std::string> mtl_name(const std::filesystem::path& path);

/// An Error if `prefix`, the name of the output without its extension, cannot begin the names of
/// pictures beside it: the pictures of two outputs could have one name.
[[nodiscard]] Result<void> check_picture_names(const std::vector<PictureFile>& pictures,
                                               const std::string& prefix);

class OutputSet {
public:
    /// `context` must outlive the set.
    explicit OutputSet(const OutputContext& context) : context_(context) {}

    /// Writes a file that appears on disk at commit(), and prints the messages of `write`. `write`
    /// passes the bytes to the given sink, which returns false after a failure or an interrupt.
    [[nodiscard]] ExitStatus add(const std::string& path,
                                 const std::function<Outcome<void>(const ByteSink&)>& write);
    /// Adds a file with these bytes.
    [[nodiscard]] ExitStatus add_text(const std::string& path, std::string_view text);
    /// Makes all files appear on disk.
    [[nodiscard]] ExitStatus commit() {
        return report_result(commit_all(outputs_), context_.console);
    }
    /// Total size of all files.
    [[nodiscard]] std::uint64_t byte_count() const { return byte_count_; }

private:
    /// Passes a file to the receiver.
    [[nodiscard]] ExitStatus hand_over(const std::string& path,
                                       const std::function<Outcome<void>(const ByteSink&)>& write);

    const OutputContext& context_;
    std::vector<Output> outputs_;
    std::uint64_t byte_count_ = 0;
};

} // namespace lsys
