// SPDX-License-Identifier: MIT
// Files of the system: opening, attributes, renaming. Names are UTF-8. Functions that may fail
// return a Reason, or a value with a Reason, and no text: callers write the messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lsys::platform {

/// 0 for success, else a value of errno (<cerrno>).
using Reason = int;

/// An open file, closed by the destructor. Move only.
class File {
public:
    File() = default;
    explicit File(int descriptor) : descriptor_(descriptor) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    File(File&& other) noexcept;
    File& operator=(File&& other) noexcept;
    ~File();

    [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Some file systems report a full disk only here. Precondition: is_open().
    [[nodiscard]] Reason close();

private:
    int descriptor_ = -1;
};

enum class FileType : std::uint8_t {
    Missing,
    Regular,
    Directory,
    Link,
    Null, // /dev/null or NUL
    Terminal,
    Device,
    Other
};

struct FileFacts {
    FileType type = FileType::Missing;
    std::uint64_t size = 0;
    unsigned permissions = 0; // of owner, group and others, 0 to 0777
};

/// Opens a file for reading. Without `may_wait` a pipe opens at once, whether or not it has a
/// writer.
[[nodiscard]] Reason open_to_read(const std::string& path, bool may_wait, File& file);
/// Opens a device or a pipe for writing.
[[nodiscard]] Reason open_to_write(const std::string& path, File& file);
/// Makes a file; EEXIST if the name exists, even as a dangling link. Only its owner can open a
/// private file; the permissions of any other file follow the umask. On Windows every file has the
/// access rights of its folder.
[[nodiscard]] Reason create_file(const std::string& path, bool is_private, File& file);

/// Attributes of an open file.
[[nodiscard]] Reason facts_of(const File& file, FileFacts& facts);
/// Attributes of the file at `path`, or of its target if it is a link; the type Missing if the file
/// does not exist. Only the types Regular and Directory are exact.
[[nodiscard]] FileFacts facts_of(const std::string& path);
/// Attributes of the file at `path`, or of the link itself if it is a link.
[[nodiscard]] FileFacts link_facts_of(const std::string& path);
/// Returns 0 if the file may be written.
[[nodiscard]] Reason check_writable(const std::string& path);
/// Sets `real` to the absolute path without links.
[[nodiscard]] Reason resolve_links(const std::string& path, std::string& real);
[[nodiscard]] Reason set_permissions(const File& file, unsigned permissions);

/// A number of bytes, or the reason of a failure. EINTR: a signal arrived before any byte was read
/// or written.
struct ByteCount {
    std::size_t count = 0;
    Reason reason = 0;
};
/// Reads up to `size` bytes; none at the end of the file.
[[nodiscard]] ByteCount read_some(const File& file, char* bytes, std::size_t size);
/// Writes up to `size` bytes.
[[nodiscard]] ByteCount write_some(const File& file, const char* bytes, std::size_t size);
/// Waits until the bytes of the file are on the disk; no error where a file system cannot do so.
[[nodiscard]] Reason store(const File& file);
/// Waits until all bytes written to the file system of this file or folder are on the disk.
void store_file_system(const std::string& path);

/// Removes a file, if it exists. Callable in signal handlers.
void remove_file(const char* path) noexcept;
/// Renames a file; replaces a file of that name.
[[nodiscard]] Reason rename_file(const std::string& from, const std::string& to);
/// Renames a file; EEXIST if the name exists. EINVAL or ENOSYS if the file system does not support
/// it.
[[nodiscard]] Reason rename_to_new(const std::string& from, const std::string& to);
/// Exchanges the names of two files. EINVAL or ENOSYS if the file system does not support it.
[[nodiscard]] Reason exchange_files(const std::string& one, const std::string& other);

/// Locks a file that create_file() has made, until it is closed or its process ends. False: another
/// process has found the file unlocked and removes it. True, without a lock, on file systems
/// that have no locks; there WithoutLocks decides what remove_unlocked_file() does.
[[nodiscard]] bool lock_new_file(const File& file);
/// Keeps the lock of a file beyond File::close(), until `lock` is closed. The file may be renamed
/// and removed meanwhile. `path`: its present path.
[[nodiscard]] Reason keep_lock(const File& file, const std::string& path, File& lock);
/// What to do with a file that cannot be opened to lock it, or whose file system has no locks.
enum class WithoutLocks : std::uint8_t { Keep, Remove };
/// Removes a regular file that no running process has locked.
void remove_unlocked_file(const std::string& path, WithoutLocks without_locks);

/// Max number of files that the process may have open at once.
[[nodiscard]] std::size_t max_open_files();

/// Random bits for names of temporary files; different on each call.
[[nodiscard]] std::uint64_t random_bits();

/// Attributes of a file that change with its contents.
struct FileStamp {
    bool exists = false;
    std::int64_t seconds = 0; // time of the last modification
    std::int64_t nanoseconds = 0;
    std::int64_t size = 0;
    std::uint64_t node = 0; // number of the file in its file system; 0 if it has none

    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
/// The stamp of the file at `path`, or of its target if it is a link.
[[nodiscard]] FileStamp stamp_of(const std::string& path);

} // namespace lsys::platform
