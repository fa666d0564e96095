// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include "runtime/platform/windows/wide_text.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>
#include <utility>
#include <windows.h>

namespace lsys::platform {

namespace {

constexpr std::size_t kMaxCount = std::size_t{1} << 30; // bytes in one call of _read() or _write()

/// The value of errno for an error of the system.
Reason reason_of(DWORD error) {
    switch (error) {
    case ERROR_SUCCESS:
        return 0;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_NETPATH:
        return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
        return EACCES;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
        return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
        return ENOSPC;
    case ERROR_NOT_ENOUGH_MEMORY:
    case ERROR_OUTOFMEMORY:
        return ENOMEM;
    case ERROR_TOO_MANY_OPEN_FILES:
        return EMFILE;
    case ERROR_DIRECTORY:
        return ENOTDIR;
    case ERROR_BUFFER_OVERFLOW:
    case ERROR_FILENAME_EXCED_RANGE:
        return ENAMETOOLONG;
    case ERROR_WRITE_PROTECT:
        return EROFS;
    default:
        return EIO;
    }
}

Reason last_reason() {
    return std::max(reason_of(::GetLastError()), 1);
}

Reason open_file(const std::string& path, int flags, File& file) {
    int descriptor = -1;
    const errno_t reason =
        ::_wsopen_s(&descriptor, wide_text(path).c_str(), flags | _O_BINARY | _O_NOINHERIT,
                    _SH_DENYNO, _S_IREAD | _S_IWRITE);
    file = File(reason == 0 ? descriptor : -1);
    return reason;
}

FileType type_of(HANDLE handle) {
    DWORD mode = 0;
    switch (::GetFileType(handle)) {
    case FILE_TYPE_DISK:
        return FileType::Regular;
    case FILE_TYPE_CHAR:
        // NUL is the only character device that is no console and no port.
        return ::GetConsoleMode(handle, &mode) != 0 ? FileType::Terminal : FileType::Null;
    default:
        return FileType::Other;
    }
}

std::uint64_t size_of(DWORD high, DWORD low) {
    return (static_cast<std::uint64_t>(high) << 32U) | low;
}

/// Opens a file or folder to read its attributes.
HANDLE open_for_attributes(const std::string& path) {
    return ::CreateFileW(wide_text(path).c_str(), FILE_READ_ATTRIBUTES,
                         FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                         OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
}

/// Renames a file. Returns EISDIR if the new name is a folder.
Reason move_file(const std::string& from, const std::string& to, DWORD flags) {
    if (::MoveFileExW(wide_text(from).c_str(), wide_text(to).c_str(), flags) != 0) {
        return 0;
    }
    const Reason reason = last_reason();
    return (flags & MOVEFILE_REPLACE_EXISTING) != 0 && facts_of(to).type == FileType::Directory
               ? EISDIR
               : reason;
}

} // namespace

Reason File::close() {
    return ::_close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
}

Reason open_to_read(const std::string& path, bool /*may_wait*/, File& file) {
    if (facts_of(path).type == FileType::Directory) {
        file = File();
        return EISDIR; // the system would report denied access
    }
    return open_file(path, _O_RDONLY, file);
}

Reason open_to_write(const std::string& path, File& file) {
    return open_file(path, _O_WRONLY, file);
}

Reason create_file(const std::string& path, bool /*is_private*/, File& file) {
    // A file has the access rights of its folder.
    return open_file(path, _O_WRONLY | _O_CREAT | _O_EXCL, file);
}

Reason facts_of(const File& file, FileFacts& facts) {
    const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file.descriptor()));
    facts = {type_of(handle), 0, 0};
    LARGE_INTEGER size{};
    if (facts.type == FileType::Regular) {
        if (::GetFileSizeEx(handle, &size) == 0) {
            return last_reason();
        }
        facts.size = static_cast<std::uint64_t>(size.QuadPart);
    }
    return 0;
}

FileFacts facts_of(const std::string& path) {
    const HANDLE handle = open_for_attributes(path);
    if (handle == INVALID_HANDLE_VALUE) {
        return {};
    }
    FileFacts facts{type_of(handle), 0, 0};
    BY_HANDLE_FILE_INFORMATION found{};
    if (facts.type == FileType::Regular && ::GetFileInformationByHandle(handle, &found) != 0) {
        facts.size = size_of(found.nFileSizeHigh, found.nFileSizeLow);
        if ((found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
            facts.type = FileType::Directory;
        }
    }
    ::CloseHandle(handle);
    return facts;
}

FileFacts link_facts_of(const std::string& path) {
    const DWORD attributes = ::GetFileAttributesW(wide_text(path).c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES) {
        return {};
    }
    return (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0 ? FileFacts{FileType::Link, 0, 0}
                                                            : facts_of(path);
}

Reason check_writable(const std::string& path) {
    const DWORD attributes = ::GetFileAttributesW(wide_text(path).c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES) {
        return last_reason();
    }
    // A folder takes files even if it has the attribute READONLY.
    constexpr DWORD kKind = FILE_ATTRIBUTE_READONLY | FILE_ATTRIBUTE_DIRECTORY;
    return (attributes & kKind) == FILE_ATTRIBUTE_READONLY ? EACCES : 0;
}

Reason resolve_links(const std::string& path, std::string& real) {
    const HANDLE handle = open_for_attributes(path);
    if (handle == INVALID_HANDLE_VALUE) {
        return last_reason();
    }
    std::wstring name(MAX_PATH, L'\0');
    DWORD count = 0;
    while (true) {
        count = ::GetFinalPathNameByHandleW(handle, name.data(), static_cast<DWORD>(name.size()),
                                            FILE_NAME_NORMALIZED | VOLUME_NAME_DOS);
        if (count < name.size()) {
            break;
        }
        name.resize(count + 1);
    }
    const Reason reason = count == 0 ? last_reason() : 0;
    ::CloseHandle(handle);
    name.resize(count);
    // The path begins with \\?\UNC\ on a network share, else with \\?\ alone.
    real = utf8_text(name);
    if (real.starts_with("\\\\?\\UNC\\")) {
        real.replace(0, 8, "\\\\");
    } else if (real.starts_with("\\\\?\\")) {
        real.erase(0, 4);
    }
    std::replace(real.begin(), real.end(), '\\', '/');
    return reason;
}

Reason set_permissions(const File& /*file*/, unsigned /*permissions*/) {
    return 0; // a file has the access rights of its folder
}

ByteCount read_some(const File& file, char* bytes, std::size_t size) {
    const int count =
        ::_read(file.descriptor(), bytes, static_cast<unsigned>(std::min(size, kMaxCount)));
    return count < 0 ? ByteCount{0, errno} : ByteCount{static_cast<std::size_t>(count), 0};
}

Reason store(const File& file) {
    return ::_commit(file.descriptor()) == 0 || errno == EINVAL ? 0 : errno;
}

void store_file_system(const std::string& /*path*/) {
    // Only administrators may store a whole volume.
}

ByteCount write_some(const File& file, const char* bytes, std::size_t size) {
    const int count =
        ::_write(file.descriptor(), bytes, static_cast<unsigned>(std::min(size, kMaxCount)));
    return count < 0 ? ByteCount{0, errno} : ByteCount{static_cast<std::size_t>(count), 0};
}

void remove_file(const char* path) noexcept {
    // Allocates no memory, because a signal handler may call this.
    std::array<wchar_t, 4096> wide{};
    if (::MultiByteToWideChar(CP_UTF8, 0, path, -1, wide.data(), static_cast<int>(wide.size())) !=
        0) {
        ::DeleteFileW(wide.data());
    }
}

Reason rename_file(const std::string& from, const std::string& to) {
    return move_file(from, to, MOVEFILE_REPLACE_EXISTING);
}

Reason rename_to_new(const std::string& from, const std::string& to) {
    return move_file(from, to, 0);
}

Reason exchange_files(const std::string& one, const std::string& other) {
    // Three renamings; each name is missing for a moment.
    const std::string third = one + ".exchange";
    if (const Reason reason = move_file(other, third, 0); reason != 0) {
        return reason;
    }
    if (const Reason reason = move_file(one, other, 0); reason != 0) {
        static_cast<void>(move_file(third, other, 0));
        return reason;
    }
    return move_file(third, one, 0);
}

bool lock_new_file(const File& /*file*/) {
    return true; // a file that create_file() has opened cannot be removed
}

Reason keep_lock(const File& /*file*/, const std::string& path, File& lock) {
    // A file that is open, in whatever way, cannot be opened by remove_unlocked_file().
    const HANDLE handle = ::CreateFileW(wide_text(path).c_str(), GENERIC_READ,
                                        FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                        nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        lock = File();
        return last_reason();
    }
    lock = File(::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_RDONLY));
    if (!lock.is_open()) {
        ::CloseHandle(handle);
        return EMFILE;
    }
    return 0;
}

void remove_unlocked_file(const std::string& path, WithoutLocks /*without_locks*/) {
    // Without sharing the file opens only if nobody else has it open. It is removed by closing it.
    const HANDLE handle =
        ::CreateFileW(wide_text(path).c_str(), DELETE, 0, nullptr, OPEN_EXISTING,
                      FILE_FLAG_DELETE_ON_CLOSE | FILE_FLAG_OPEN_REPARSE_POINT, nullptr);
    if (handle != INVALID_HANDLE_VALUE) {
        ::CloseHandle(handle);
    }
}

std::size_t max_open_files() {
    return 2048; // well below the 8192 files that _open() can have open at once
}

std::uint64_t random_bits() {
    LARGE_INTEGER ticks{};
    ::QueryPerformanceCounter(&ticks);
    static LONG count = 0;
    return (static_cast<std::uint64_t>(ticks.QuadPart) << 24U) ^
           (static_cast<std::uint64_t>(::GetCurrentProcessId()) << 8U) ^
           static_cast<std::uint64_t>(::InterlockedIncrement(&count));
}

FileStamp stamp_of(const std::string& path) {
    const HANDLE handle = open_for_attributes(path);
    if (handle == INVALID_HANDLE_VALUE) {
        return {};
    }
    BY_HANDLE_FILE_INFORMATION found{};
    FileStamp stamp;
    if (::GetFileInformationByHandle(handle, &found) != 0) {
        constexpr std::uint64_t kTicks = 10'000'000; // per second
        const std::uint64_t time =
            size_of(found.ftLastWriteTime.dwHighDateTime, found.ftLastWriteTime.dwLowDateTime);
        stamp = {true, static_cast<std::int64_t>(time / kTicks),
                 static_cast<std::int64_t>(time % kTicks * 100),
                 static_cast<std::int64_t>(size_of(found.nFileSizeHigh, found.nFileSizeLow)),
                 size_of(found.nFileIndexHigh, found.nFileIndexLow)};
    }
    ::CloseHandle(handle);
    return stamp;
}

} // namespace lsys::platform
