// SPDX-License-Identifier: MIT
#include "runtime/program/file_boundary.h"

#include "grammar/base/paths.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/platform/beneath.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

std::vector<std::string> names_in(const std::string& path) {
    std::vector<std::string> names;
    for (const std::filesystem::path& part : path_of(path)) {
        const std::string name = path_text(part);
        if (!name.empty() && name != "." && name != "/") {
            names.push_back(name);
        }
    }
    return names;
}

/// The absolute path without `..`, by its text alone.
std::string absolute_text(const std::string& path) {
    std::error_code ignored;
    return path_text(
        std::filesystem::absolute(path_of(path.empty() ? "." : path), ignored).lexically_normal());
}

/// `path` without the names of `folder` at its beginning; nothing if it begins with others.
std::optional<std::string> name_below(const std::vector<std::string>& folder,
                                      const std::vector<std::string>& path) {
    if (folder.size() > path.size() || !std::equal(folder.begin(), folder.end(), path.begin())) {
        return std::nullopt;
    }
    std::string name = ".";
    for (std::size_t i = folder.size(); i < path.size(); ++i) {
        name += '/' + path[i];
    }
    return name;
}

} // namespace

FileBoundary::FileBoundary(FilePolicy policy) : policy_(std::move(policy)) {
    for (const std::string& file : policy_.named) {
        const std::string shown = shown_path(file);
        names_absolute_ = names_absolute_ || is_absolute_path(shown);
        if (policy_.root.empty() && file != "-") {
            add_folder(std::string(folder_of_path(shown)));
        }
    }
    if (!policy_.root.empty()) {
        add_folder(policy_.root);
    }
}

void FileBoundary::add_folder(std::string path) {
    const auto is_same = [&](const Folder& folder) { return folder.path == path; };
    if (std::none_of(folders_.begin(), folders_.end(), is_same)) {
        Folder folder{std::move(path), {}, false};
        folder.names = names_in(folder.path);
        folder.is_absolute = is_absolute_path(folder.path);
        folders_.push_back(std::move(folder));
    }
}

bool FileBoundary::is_named(const std::string& path) const {
    return std::any_of(policy_.named.begin(), policy_.named.end(), [&](const std::string& file) {
        return file == path ||
               (file != "-" && is_absolute_path(path) && absolute_text(file) == path);
    });
}

std::vector<FileBoundary::Place> FileBoundary::places_of(const std::string& path) const {
    std::vector<Place> places;
    const bool is_absolute = is_absolute_path(path);
    const std::vector<std::string> names = names_in(path);
    for (const Folder& folder : folders_) {
        std::optional<std::string> name =
            folder.is_absolute == is_absolute ? name_below(folder.names, names) : std::nullopt;
        if (name) {
            places.push_back({folder.path, std::move(*name)});
        }
    }
    // The user may write the root in another way than the folders of the named files. An absolute
    // path that a grammar names stays refused if the user names no file by an absolute path.
    if (places.empty() && !policy_.root.empty() && (!is_absolute || names_absolute_)) {
        std::optional<std::string> name =
            name_below(names_in(absolute_text(policy_.root)), names_in(absolute_text(path)));
        if (name) {
            places.push_back({policy_.root, std::move(*name)});
        }
    }
    return places;
}

std::string FileBoundary::refusal() const {
    if (folders_.empty()) {
        return fmt::format("a grammar from standard input may read no other file; `{}` sets a "
                           "folder",
                           policy_.root_option);
    }
    return fmt::format("only files in `{}` may be read; `{}` sets another folder",
                       folders_.front().path.empty() ? "." : folders_.front().path,
                       policy_.root_option);
}

platform::Reason FileBoundary::open(const std::string& path, platform::File& file) const {
    for (const Place& place : places_of(path)) {
        const platform::Reason reason = platform::open_beneath(place.folder, place.name, file);
        if (reason != platform::kOutside) {
            return reason;
        }
    }
    return platform::kOutside;
}

Result<std::string> FileBoundary::read(const std::string& path,
                                       const ReadLimit& limit,
                                       const std::atomic<bool>* cancelled) const {
    platform::File file;
    switch (const platform::Reason reason = open(path, file); reason) {
    case 0:
        return read_opened(file, FileKind::Regular, limit, cancelled);
    case platform::kOutside:
        return Error{refusal()};
    case EINVAL:
        return Error{"it is not a regular file"};
    case EISDIR:
        return Error{"it is a directory"};
    default:
        return Error{errno_text(reason)};
    }
}

bool FileBoundary::exists(const std::string& path) const {
    platform::File file;
    const platform::Reason reason = open(path, file);
    return reason == 0 || reason == EISDIR || reason == EACCES;
}

std::vector<std::string> FileBoundary::list(const std::string& path, std::size_t max_count) const {
    for (const Place& place : places_of(path)) {
        std::vector<std::string> names =
            platform::list_beneath(place.folder, place.name, max_count);
        if (!names.empty()) {
            return names;
        }
    }
    return {};
}

} // namespace lsys
