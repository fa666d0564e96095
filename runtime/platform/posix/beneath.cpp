// SPDX-License-Identifier: MIT
// Opens each component of a path relative to the descriptor of the folder before it and without
// following links, so that no link can be exchanged between a check and its use. Linux has
// openat2(RESOLVE_BENEATH) for this, but not before 5.6, and sandboxes often forbid it.
#include "runtime/platform/beneath.h"

#include <array>
#include <cerrno>
#include <dirent.h>
#include <fcntl.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace lsys::platform {

namespace {

constexpr int kMaxLinks = 40; // as Linux; ends cycles of links
constexpr std::size_t kMaxNameBytes = 4096;
constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// A walk from a folder to one of its descendants.
class Walk {
public:
    Reason begin(const std::string& folder) {
        File root(
            ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (!root.is_open()) {
            return errno;
        }
        folders_.push_back(std::move(root));
        return 0;
    }

    /// Puts the names of a path before the names that are left.
    Reason add(const std::string& path) {
        if (path.size() > kMaxNameBytes) {
            return ENAMETOOLONG;
        }
        if (path.starts_with('/')) {
            return kOutside;
        }
        std::size_t end = path.size();
        while (end > 0) { // from the last name to the first
            const std::size_t slash = path.rfind('/', end - 1);
            const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
            if (begin < end) {
                left_.push_back(path.substr(begin, end - begin));
            }
            end = slash == std::string::npos ? 0 : slash;
        }
        return 0;
    }

    /// Enters all folders of the path. Leaves `file` open if the last name is a regular file; else
    /// the walk ends in a folder.
    Reason go(File& file) {
        while (!left_.empty()) {
            const std::string name = std::move(left_.back());
            left_.pop_back();
            if (const Reason reason = step(name, file); reason != 0) {
                return reason;
            }
        }
        return 0;
    }

    [[nodiscard]] File& folder() { return folders_.back(); }

private:
    Reason step(const std::string& name, File& file) {
        if (name == ".") {
            return 0;
        }
        if (name == "..") {
            folders_.pop_back();
            return folders_.empty() ? kOutside : 0;
        }
        const int parent = folders_.back().descriptor();
        struct stat facts {};
        if (::fstatat(parent, name.c_str(), &facts, AT_SYMLINK_NOFOLLOW) != 0) {
            return errno;
        }
        if (S_ISLNK(facts.st_mode)) {
            return follow(parent, name);
        }
        if (S_ISDIR(facts.st_mode)) {
            File next(::openat(parent, name.c_str(), kFolderFlags));
            if (!next.is_open()) {
                return errno;
            }
            folders_.push_back(std::move(next));
            return 0;
        }
        return S_ISREG(facts.st_mode) ? open_last(parent, name, file) : EINVAL;
    }

    Reason follow(int parent, const std::string& name) {
        if (++links_ > kMaxLinks) {
            return ELOOP;
        }
        std::array<char, kMaxNameBytes> target{};
        const ssize_t size = ::readlinkat(parent, name.c_str(), target.data(), target.size());
        if (size <= 0) {
            return size < 0 ? errno : ENOENT;
        }
        return add(std::string(target.data(), static_cast<std::size_t>(size)));
    }

    Reason open_last(int parent, const std::string& name, File& file) {
        if (!left_.empty()) {
            return ENOTDIR;
        }
        // A pipe or device that has taken the place of the file opens without waiting, and is
        // refused here.
        File opened(::openat(parent, name.c_str(),
                             O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
        struct stat facts {};
        if (!opened.is_open() || ::fstat(opened.descriptor(), &facts) != 0) {
            return errno;
        }
        if (!S_ISREG(facts.st_mode)) {
            return EINVAL;
        }
        file = std::move(opened);
        return 0;
    }

    std::vector<File> folders_;     // from the root of the walk to the folder that it has reached
    std::vector<std::string> left_; // names that are left, last name first
    int links_ = 0;                 // number of symbolic links followed so far
};

} // namespace

Reason open_beneath(const std::string& folder, const std::string& name, File& file) {
    Walk walk;
    file = File();
    Reason reason = walk.begin(folder);
    if (reason == 0) {
        reason = walk.add(name);
    }
    if (reason == 0) {
        reason = walk.go(file);
    }
    return reason == 0 && !file.is_open() ? EISDIR : reason;
}

std::vector<std::string>
list_beneath(const std::string& folder, const std::string& name, std::size_t max_count) {
    std::vector<std::string> names;
    Walk walk;
    File file;
    if (walk.begin(folder) != 0 || walk.add(name) != 0 || walk.go(file) != 0 || file.is_open()) {
        return names;
    }
    const int descriptor = ::openat(walk.folder().descriptor(), ".", kFolderFlags);
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(
        descriptor < 0 ? nullptr : ::fdopendir(descriptor), &::closedir);
    if (entries == nullptr) {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
        return names;
    }
    while (names.size() < max_count) {
        const dirent* const entry = ::readdir(entries.get());
        if (entry == nullptr) {
            break;
        }
        struct stat facts {};
        if (::fstatat(descriptor, entry->d_name, &facts, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISREG(facts.st_mode)) {
            names.emplace_back(entry->d_name);
        }
    }
    return names;
}

} // namespace lsys::platform
