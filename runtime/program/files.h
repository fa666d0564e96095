// Files, whole: read at once, written beside their name and renamed when complete. `-` is standard
// input or output. Everything the environment refuses comes back as an Error that names the file.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/project.h"
#include "runtime/program/console.h"
#include "runtime/program/temporaries.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The bytes of `path`, or of standard input for `-`: a file that the user names, which may be a
/// pipe or a terminal. Other devices are refused: they have no end.
[[nodiscard]] Result<std::string>
read_file(const std::string& path, const ReadLimit& limit, const Console& console);

/// The two kinds of files that are read.
enum class FileKind : std::uint8_t {
    Named,   // by the user: it may be a pipe or a terminal
    Regular, // named by another file: a regular one or /dev/null, so that nobody waits for it
};
/// The bytes of a file; its Error is the reason alone. `cancelled` may be null.
[[nodiscard]] Result<std::string> read_bytes(const std::string& path,
                                             FileKind kind,
                                             const ReadLimit& limit,
                                             const std::atomic<bool>* cancelled);
/// The bytes of standard input; its Error is the reason alone.
[[nodiscard]] Result<std::string> read_standard_input(const ReadLimit& limit,
                                                      const Console& console);

/// What `errno` means, lower case.
[[nodiscard]] std::string reason_text(int reason);

/// The name of a file of a series: tree.glb and 12 give tree.0012.glb.
[[nodiscard]] std::string numbered(const std::string& path, std::uint32_t number);
/// Says which files of a series that ended early are there: the first `done` of `count`.
void note_frames(const std::string& path,
                 std::uint32_t done,
                 std::uint32_t count,
                 const Console& console);

/// A file while it is written. A regular file appears under its name, or replaces the one of that
/// name, only at commit(); until then, and if it is never called, nothing has changed. Move only.
class Output {
public:
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    Output(Output&& other) noexcept;
    Output& operator=(Output&&) = delete;
    ~Output();

    /// `-` is standard output.
    [[nodiscard]] static Result<Output> open(const std::string& path, const Console& console);
    /// Like open(), but the file must be new: an Error here or at commit() if there is one of its
    /// name, a dangling link included.
    [[nodiscard]] static Result<Output> create(const std::string& path, const Console& console);
    [[nodiscard]] Result<void> write(std::string_view text);
    /// Ends the writing; the file keeps its temporary name. Idempotent.
    [[nodiscard]] Result<void> finish();
    /// finish(), then the file gets its name.
    [[nodiscard]] Result<void> commit();

private:
    friend Result<void> commit_all(std::vector<Output>& outputs);
    enum class Shown : std::uint8_t { No, New, Exchanged, Replaced };

    Output(const Console& console, std::string path) : console_(&console), path_(std::move(path)) {}
    [[nodiscard]] Error failure(int reason) const;
    [[nodiscard]] Result<void> make_temporary(bool exists, unsigned mode);
    void drop_temporary();
    [[nodiscard]] Result<void> show();
    void hide();

    const Console* console_;
    std::string path_;              // as the user wrote it
    std::string target_;            // with links resolved
    std::string temporary_;         // beside target_; empty where the file is written in place
    TemporaryName* slot_ = nullptr; // of temporary_
    int descriptor_ = -1;           // none: standard output, or finished
    bool is_finished_ = false;
    bool must_be_new_ = false;
    Shown shown_ = Shown::No; // by commit_all()
};

/// Commits outputs that belong together: all of them appear or none. A file that was replaced comes
/// back when a later one fails, except on file systems that cannot exchange two names.
[[nodiscard]] Result<void> commit_all(std::vector<Output>& outputs);

/// open, write, commit.
[[nodiscard]] Result<void>
write_file(const std::string& path, std::string_view text, const Console& console);

} // namespace lsys
