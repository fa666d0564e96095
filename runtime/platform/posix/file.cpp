// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace lsys::platform {

namespace {

bool is_null_device(const struct stat& facts) {
    struct stat null {};
    return S_ISCHR(facts.st_mode) && ::stat("/dev/null", &null) == 0 &&
           facts.st_rdev == null.st_rdev;
}

FileType type_of(const struct stat& facts) {
    if (S_ISREG(facts.st_mode)) {
        return FileType::Regular;
    }
    if (S_ISDIR(facts.st_mode)) {
        return FileType::Directory;
    }
    if (S_ISLNK(facts.st_mode)) {
        return FileType::Link;
    }
    if (is_null_device(facts)) {
        return FileType::Null;
    }
    return S_ISBLK(facts.st_mode) || S_ISCHR(facts.st_mode) ? FileType::Device : FileType::Other;
}

FileFacts facts_in(const struct stat& facts) {
    return {type_of(facts), static_cast<std::uint64_t>(std::max<off_t>(facts.st_size, 0)),
            facts.st_mode & 0777U};
}

Reason open_file(const std::string& path, int flags, mode_t mode, File& file) {
    file = File(::open(path.c_str(), flags | O_CLOEXEC, mode));
    return file.is_open() ? 0 : errno;
}

ByteCount byte_count(ssize_t count) {
    return count < 0 ? ByteCount{0, errno} : ByteCount{static_cast<std::size_t>(count), 0};
}

} // namespace

Reason File::close() {
    return ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
}

Reason open_to_read(const std::string& path, bool may_wait, File& file) {
    return open_file(path, O_RDONLY | O_NOCTTY | (may_wait ? 0 : O_NONBLOCK), 0, file);
}

Reason open_to_write(const std::string& path, File& file) {
    return open_file(path, O_WRONLY, 0, file);
}

Reason create_file(const std::string& path, bool is_private, File& file) {
    return open_file(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, is_private ? 0600 : 0666,
                     file);
}

Reason facts_of(const File& file, FileFacts& facts) {
    struct stat read {};
    if (::fstat(file.descriptor(), &read) != 0) {
        return errno;
    }
    facts = facts_in(read);
    if (facts.type == FileType::Device && ::isatty(file.descriptor()) != 0) {
        facts.type = FileType::Terminal;
    }
    return 0;
}

FileFacts facts_of(const std::string& path) {
    struct stat facts {};
    return ::stat(path.c_str(), &facts) == 0 ? facts_in(facts) : FileFacts{};
}

FileFacts link_facts_of(const std::string& path) {
    struct stat facts {};
    return ::lstat(path.c_str(), &facts) == 0 ? facts_in(facts) : FileFacts{};
}

Reason check_writable(const std::string& path) {
    return ::access(path.c_str(), W_OK) == 0 ? 0 : errno;
}

Reason resolve_links(const std::string& path, std::string& real) {
    const std::unique_ptr<char, decltype(&std::free)> found(::realpath(path.c_str(), nullptr),
                                                            &std::free);
    if (found == nullptr) {
        return errno;
    }
    real = found.get();
    return 0;
}

Reason set_permissions(const File& file, unsigned permissions) {
    return ::fchmod(file.descriptor(), permissions & 0777U) == 0 ? 0 : errno;
}

ByteCount read_some(const File& file, char* bytes, std::size_t size) {
    return byte_count(::read(file.descriptor(), bytes, size));
}

ByteCount write_some(const File& file, const char* bytes, std::size_t size) {
    return byte_count(::write(file.descriptor(), bytes, size));
}

Reason store(const File& file) {
    // File systems without this function report EINVAL, ENOSYS or ENOTSUP.
    while (::fsync(file.descriptor()) != 0) {
        if (errno != EINTR) {
            return errno == EINVAL || errno == ENOSYS || errno == ENOTSUP ? 0 : errno;
        }
    }
    return 0;
}

void store_file_system(const std::string& path) {
#if defined(__linux__)
    File file;
    if (open_to_read(path, false, file) == 0 && ::syncfs(file.descriptor()) == 0) {
        return;
    }
#else
    static_cast<void>(path);
#endif
    ::sync();
}

void remove_file(const char* path) noexcept {
    ::unlink(path);
}

Reason rename_file(const std::string& from, const std::string& to) {
    return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

FileStamp stamp_of(const std::string& path) {
    struct stat facts {};
    if (::stat(path.c_str(), &facts) != 0) {
        return {};
    }
#if defined(__APPLE__)
    const timespec& time = facts.st_mtimespec;
#else
    const timespec& time = facts.st_mtim;
#endif
    return {true, time.tv_sec, time.tv_nsec, facts.st_size, facts.st_ino};
}

} // namespace lsys::platform
