// SPDX-License-Identifier: MIT
// Locks by flock(2): they end with the process, however it ends, and hold between machines where
// the file system supports that (NFS from Linux 2.6.12 on).
#include "runtime/platform/file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lsys::platform {

namespace {

/// Returns 0, EWOULDBLOCK if another process has the lock, or the reason why there is none.
Reason try_lock(int descriptor) {
#if defined(__EMSCRIPTEN__)
    static_cast<void>(descriptor);
    return ENOSYS;
#else
    return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
#endif
}

} // namespace

bool lock_new_file(const File& file) {
    if (try_lock(file.descriptor()) == EWOULDBLOCK) {
        return false;
    }
    struct stat facts {};
    return ::fstat(file.descriptor(), &facts) != 0 || facts.st_nlink != 0;
}

Reason keep_lock(const File& file, const std::string& /*path*/, File& lock) {
    // A duplicate shares the lock with its original.
    lock = File(::fcntl(file.descriptor(), F_DUPFD_CLOEXEC, 0));
    return lock.is_open() ? 0 : errno;
}

void remove_unlocked_file(const std::string& path, WithoutLocks without_locks) {
    // Open for writing, because NFS gives an exclusive lock only then.
    const File file(
        ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat opened {};
    struct stat named {};
    // If there is no file, another process may make one of this name right now.
    if (!file.is_open() && errno == ENOENT) {
        return;
    }
    if (!file.is_open() || ::fstat(file.descriptor(), &opened) != 0) {
        if (without_locks == WithoutLocks::Remove) {
            ::unlink(path.c_str());
        }
        return;
    }
    if (!S_ISREG(opened.st_mode)) {
        return;
    }
    const Reason reason = try_lock(file.descriptor());
    if (reason == EWOULDBLOCK || (reason != 0 && without_locks == WithoutLocks::Keep)) {
        return;
    }
    // Another process may have removed this file, and made a new one, before it was locked here.
    // While it is locked nobody else removes it, so the name cannot change any more.
    if (::lstat(path.c_str(), &named) == 0 && named.st_dev == opened.st_dev &&
        named.st_ino == opened.st_ino) {
        ::unlink(path.c_str());
    }
}

std::size_t max_open_files() {
    struct rlimit limit {};
    constexpr rlim_t kUsual = 256;
    const bool is_known =
        ::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return static_cast<std::size_t>(is_known ? limit.rlim_cur : kUsual);
}

} // namespace lsys::platform
