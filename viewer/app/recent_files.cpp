// SPDX-License-Identifier: MIT
#include "viewer/app/recent_files.h"

#include "grammar/base/paths.h"
#include "runtime/program/arguments.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace lsys::view {

namespace {

constexpr std::uint64_t kMaxListBytes = std::uint64_t{1} << 16;

/// The lines of `folder`/recent.
std::vector<std::string> listed_files(const std::string& folder) {
    std::vector<std::string> files;
    if (folder.empty()) {
        return files;
    }
    const Result<std::string> text =
        read_bytes(folder + "/recent", FileKind::Regular, {kMaxListBytes}, nullptr);
    if (!text) {
        return files;
    }
    const std::string& lines = text.value();
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', begin), lines.size());
        if (end > begin) {
            files.push_back(lines.substr(begin, end - begin));
        }
        begin = end + 1;
    }
    return files;
}

} // namespace

std::string state_folder() {
    struct Place {
        const char* variable; // environment variable with a folder
        const char* below;    // path of the state folder below that folder
    };
    for (const Place& place : {Place{"XDG_STATE_HOME", "/lsview"},
#ifdef _WIN32
                               Place{"LOCALAPPDATA", "/lsview"},
#endif
                               Place{"HOME", "/.local/state/lsview"}}) {
        const char* const base = std::getenv(place.variable);
        if (base != nullptr && is_absolute_path(base)) {
            return std::string(base) + place.below;
        }
    }
    return {};
}

std::vector<std::string> recent_files(const std::string& folder) {
    std::vector<std::string> files = listed_files(folder);
    std::erase_if(files, [](const std::string& file) {
        return platform::facts_of(file).type != platform::FileType::Regular;
    });
    files.resize(std::min(files.size(), kMaxRecentFiles));
    return files;
}

void remember_file(const std::string& folder, const std::string& file, const Console& console) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path_of(file), error);
    const std::string path = error ? file : path_text(absolute.lexically_normal());
    if (folder.empty() || path.find('\n') != std::string::npos) {
        return;
    }
    std::vector<std::string> files = listed_files(folder);
    std::erase(files, path);
    files.insert(files.begin(), path);
    files.resize(std::min(files.size(), kMaxRecentFiles));
    write_state(folder + "/recent", fmt::format("{}\n", fmt::join(files, "\n")), console);
}

WindowLook read_look(const std::string& folder) {
    const Result<std::string> text =
        folder.empty() ? Result<std::string>(std::string())
                       : read_bytes(folder + "/look", FileKind::Regular, {kMaxListBytes}, nullptr);
    WindowLook look;
    if (text) {
        const std::string& words = text.value();
        const std::size_t blank = std::min(words.find(' '), words.size());
        const Result<float> size = parse_number(words.substr(0, blank), kMinTextSize, kMaxTextSize);
        look.text_size = size ? size.value() : 1.0F;
        look.is_light = words.substr(blank) == " light\n";
    }
    return look;
}

void write_look(const std::string& folder, const WindowLook& look, const Console& console) {
    if (!folder.empty()) {
        write_state(folder + "/look",
                    fmt::format("{} {}\n", look.text_size, look.is_light ? "light" : "dark"),
                    console);
    }
}

void write_state(const std::string& path, const std::string& text, const Console& console) {
    std::error_code error;
    if (text.empty()) {
        platform::remove_file(path.c_str());
        return;
    }
    std::filesystem::create_directories(path_of(path).parent_path(), error);
    if (const Result<void> written = write_file(path, text, console); !written) {
        console.detail(written.error().message);
    }
}

} // namespace lsys::view
