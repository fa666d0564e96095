// SPDX-License-Identifier: MIT
// Reading and writing of whole files. A file is written under a temporary name and renamed when it
// is complete. `-` is standard input or output. Errors name the file unless noted.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/project.h"
#include "runtime/platform/file.h"
#include "runtime/program/console.h"
#include "runtime/program/temporaries.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The bytes of a file that the user named, or of standard input for `-`. Pipes and terminals are
/// allowed, other devices are not.
[[nodiscard]] Result<std::string>
read_file(const std::string& path, const ReadLimit& limit, const Console& console);

/// The kinds of files that may be read.
enum class FileKind : std::uint8_t {
    Named,   // a file that the user names; may be a pipe or a terminal
    Regular, // a file that another file names; a regular file or /dev/null, which never block
};
/// The bytes of a file. The Error is the reason without the name of the file. `cancelled` may be
/// null.
[[nodiscard]] Result<std::string> read_bytes(const std::string& path,
                                             FileKind kind,
                                             const ReadLimit& limit,
                                             const std::atomic<bool>* cancelled);
/// The bytes of an open file; otherwise as read_bytes().
[[nodiscard]] Result<std::string> read_opened(const platform::File& file,
                                              FileKind kind,
                                              const ReadLimit& limit,
                                              const std::atomic<bool>* cancelled);
/// The bytes of standard input. The Error is the reason without a name.
[[nodiscard]] Result<std::string> read_standard_input(const ReadLimit& limit,
                                                      const Console& console);

/// The text of an errno value, beginning with a lower-case letter.
[[nodiscard]] std::string errno_text(int reason);

/// The path of a numbered file: tree.0012.glb for tree.glb and 12.
[[nodiscard]] std::string numbered_path(const std::string& path, std::uint32_t number);
/// Prints that the first `done` of `count` numbered files are complete.
void report_complete_frames(const std::string& path,
                            std::uint32_t done,
                            std::uint32_t count,
                            const Console& console);

/// When the bytes of a file are put on the disk.
enum class Storing : std::uint8_t {
    BeforeNaming, // a power failure never leaves an incomplete file
    BySystem,     // later, for files of a set that is stored as a whole
};

/// A file being written. A regular file appears under its name, or replaces an existing one, only
/// at commit(); without a commit() nothing changes. Move only.
class Output {
public:
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    Output(Output&& other) noexcept;
    Output& operator=(Output&&) = delete;
    ~Output();

    /// Opens `path`; `-` is standard output. An Error for a file that the run has read, or has
    /// opened before (Io::files).
    [[nodiscard]] static Result<Output> open(const std::string& path, const Console& console);
    /// Opens a file of a set whose paths all differ. Does not remember its path, so that the set
    /// may be large. An Error for a file that the run has read.
    [[nodiscard]] static Result<Output> open_one_of_many(const std::string& path,
                                                         const Console& console);
    /// Opens a file to replace it, even if the run has read it.
    [[nodiscard]] static Result<Output> reopen(const std::string& path, const Console& console);
    /// Opens a file that must not exist, not even as a dangling link: an Error here or at commit().
    [[nodiscard]] static Result<Output> create(const std::string& path, const Console& console);
    [[nodiscard]] Result<void> write(std::string_view text);
    /// Stores the bytes on the disk and closes the file under its temporary name. Idempotent.
    [[nodiscard]] Result<void> finish(Storing storing = Storing::BeforeNaming);
    /// Finishes the file and gives it its name.
    [[nodiscard]] Result<void> commit();

private:
    friend Result<void> commit_all(std::vector<Output>& outputs);
    /// What publish() has done.
    enum class State : std::uint8_t {
        Unpublished, // nothing, or the output has no temporary file
        New,         // the file has its name, which no file had before
        Exchanged,   // the file has its name; the earlier file has the temporary name
        Replaced     // the file has its name; the earlier file is lost
    };

    Output(const Console& console, std::string path) : console_(&console), path_(std::move(path)) {}
    [[nodiscard]] Error failure(int reason) const; // an Error with the path and the reason
    /// Makes the empty temporary file in the folder of target_; `exists`: target_ exists and has
    /// these permissions.
    [[nodiscard]] Result<void> make_temporary(bool exists, unsigned permissions);
    void forget_temporary(); // does not remove the file
    /// Gives the file its name. An earlier file of that name gets the temporary name.
    [[nodiscard]] Result<void> publish();
    void unpublish(); // undoes publish()

    const Console* console_;
    std::string path_;   // path as the user gave it
    std::string target_; // path_ with symbolic links resolved
    /// Temporary path in the folder of target_; empty for devices and pipes.
    std::string temporary_;
    TemporaryName* slot_ = nullptr; // registration of temporary_; null: not registered
    platform::File file_;           // not open if it is standard output or finished
    /// Keeps the file that has the name temporary_ locked, from finish() on.
    platform::File lock_;
    bool is_finished_ = false;         // finish() has been called
    bool must_be_new_ = false;         // made by create()
    State state_ = State::Unpublished; // set by commit_all()
};

/// Commits all outputs or none. If one fails, replaced files are restored, except on file systems
/// that cannot exchange two names.
[[nodiscard]] Result<void> commit_all(std::vector<Output>& outputs);

/// Opens, writes and commits a file.
[[nodiscard]] Result<void>
write_file(const std::string& path, std::string_view text, const Console& console);

/// Replaces a file that the run has read.
[[nodiscard]] Result<void>
rewrite_file(const std::string& path, std::string_view text, const Console& console);

} // namespace lsys
