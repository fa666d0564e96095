// SPDX-License-Identifier: MIT
#include "viewer/app/camera_bookmarks.h"

#include "grammar/base/hash.h"
#include "grammar/base/paths.h"
#include "runtime/program/files.h"
#include "viewer/app/recent_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace lsys::view {

void CameraBookmarks::show(const std::string& state_folder, const std::string& file) {
    if (file == file_) {
        return;
    }
    file_ = file;
    bookmarks_ = {};
    path_.clear();
    if (state_folder.empty()) {
        return;
    }
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path_of(file), error);
    const std::string name = error ? file : path_text(absolute.lexically_normal());
    path_ = fmt::format("{}/cameras/{:016x}", state_folder, fnv1a(name));
    constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 16U;
    const Result<std::string> text = read_bytes(path_, FileKind::Regular, {kMaxBytes}, nullptr);
    if (!text) {
        return;
    }
    // A line consists of the number of a bookmark, a blank, the camera as text, a tab and the name.
    std::istringstream lines(text.value());
    for (std::string each; std::getline(lines, each);) {
        const std::size_t tab = each.find('\t');
        const bool is_bookmark = each.size() > 2 && each[0] >= '1' && each[0] <= '9' &&
                                 each[1] == ' ' && tab != std::string::npos;
        if (!is_bookmark) {
            continue;
        }
        const Result<Camera> camera = parse_camera(each.substr(2, tab - 2), Camera{});
        if (camera) {
            bookmarks_.at(static_cast<std::size_t>(each[0] - '1')) =
                CameraBookmark{each.substr(tab + 1), camera.value()};
        }
    }
}

void CameraBookmarks::set(std::size_t index, const Camera& camera, const Console& console) {
    std::optional<CameraBookmark>& bookmark = bookmarks_.at(index);
    bookmark = {bookmark ? bookmark->name : fmt::format("Camera {}", index + 1), camera};
    write(console);
}

void CameraBookmarks::rename(std::size_t index, const std::string& name, const Console& console) {
    bookmarks_.at(index)->name = name;
    write(console);
}

void CameraBookmarks::remove(std::size_t index, const Console& console) {
    bookmarks_.at(index).reset();
    write(console);
}

void CameraBookmarks::write(const Console& console) const {
    if (path_.empty()) {
        return;
    }
    std::string text;
    for (std::size_t i = 0; i < kBookmarks; ++i) {
        if (bookmarks_[i]) {
            text += fmt::format("{} {}\t{}\n", i + 1, to_text(bookmarks_[i]->camera),
                                bookmarks_[i]->name);
        }
    }
    write_state(path_, text, console);
}

} // namespace lsys::view
