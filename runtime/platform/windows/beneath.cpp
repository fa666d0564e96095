// SPDX-License-Identifier: MIT
// Opens the file first and then asks the system for the path of what was opened, with all links
// resolved: only this path decides, so that no link can be exchanged between the check and the use.
#include "runtime/platform/beneath.h"

#include "runtime/platform/windows/wide_text.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <io.h>
#include <system_error>
#include <windows.h>

namespace lsys::platform {

namespace {

std::wstring final_path(HANDLE handle) {
    std::array<wchar_t, 32768> path{}; // the max length of a path of NT
    const DWORD size = ::GetFinalPathNameByHandleW(
        handle, path.data(), static_cast<DWORD>(path.size()), VOLUME_NAME_DOS);
    return size == 0 || size >= path.size() ? std::wstring() : std::wstring(path.data(), size);
}

HANDLE open_any(const std::string& path, DWORD access) {
    return ::CreateFileW(wide_text(path).c_str(), access,
                         FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                         OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
}

std::wstring final_path(const std::string& path) {
    const HANDLE handle = open_any(path, FILE_READ_ATTRIBUTES);
    if (handle == INVALID_HANDLE_VALUE) {
        return {};
    }
    std::wstring text = final_path(handle);
    ::CloseHandle(handle);
    return text;
}

std::string root_of(const std::string& folder) {
    return folder.empty() ? "." : folder;
}

/// Whether a name is relative: a `:` marks a drive or a stream, and a separator at the start marks
/// a root. Device names such as CON pass; open_beneath() refuses them, since they are on no disk.
bool is_relative(const std::string& name) {
    return name.find(':') == std::string::npos && !name.starts_with('/') && !name.starts_with('\\');
}

bool is_below(const std::wstring& path, std::wstring root) {
    if (!root.ends_with(L'\\')) {
        root += L'\\';
    }
    return path.starts_with(root);
}

} // namespace

Reason open_beneath(const std::string& folder, const std::string& name, File& file) {
    file = File();
    if (!is_relative(name)) {
        return kOutside;
    }
    const std::wstring root = final_path(root_of(folder));
    const HANDLE handle = open_any(root_of(folder) + '/' + name, GENERIC_READ);
    if (root.empty() || handle == INVALID_HANDLE_VALUE) {
        return ENOENT;
    }
    Reason reason = 0;
    BY_HANDLE_FILE_INFORMATION facts{};
    if (::GetFileType(handle) != FILE_TYPE_DISK ||
        ::GetFileInformationByHandle(handle, &facts) == 0) {
        reason = EINVAL;
    } else if (!is_below(final_path(handle), root)) {
        reason = kOutside;
    } else if ((facts.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
        reason = EISDIR;
    }
    if (reason != 0) {
        ::CloseHandle(handle);
        return reason;
    }
    file = File(::_open_osfhandle(reinterpret_cast<intptr_t>(handle), _O_RDONLY | _O_BINARY));
    return file.is_open() ? 0 : EMFILE;
}

std::vector<std::string>
list_beneath(const std::string& folder, const std::string& name, std::size_t max_count) {
    std::vector<std::string> names;
    const std::string path = root_of(folder) + '/' + name;
    const std::wstring root = final_path(root_of(folder));
    const std::wstring final = final_path(path);
    if (!is_relative(name) || root.empty() || (final != root && !is_below(final, root))) {
        return names;
    }
    std::error_code failed;
    std::filesystem::directory_iterator at(final, failed);
    for (const std::filesystem::directory_iterator end;
         !failed && at != end && names.size() < max_count; at.increment(failed)) {
        std::error_code ignored;
        if (at->symlink_status(ignored).type() == std::filesystem::file_type::regular) {
            const auto text = at->path().filename().u8string();
            names.emplace_back(text.begin(), text.end());
        }
    }
    return names;
}

} // namespace lsys::platform
