// SPDX-License-Identifier: MIT
// FileBoundary: reads files that grammars and scenes name, if a FilePolicy allows it.
#pragma once

#include "grammar/base/result.h"
#include "runtime/pipeline/file_policy.h"
#include "runtime/pipeline/project.h"
#include "runtime/platform/file.h"

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

namespace lsys {

class FileBoundary {
public:
    explicit FileBoundary(FilePolicy policy);

    /// Whether the user names this file.
    [[nodiscard]] bool is_named(const std::string& path) const;
    /// The bytes of a regular file within the folders of the policy. The Error is the reason
    /// without the name of the file.
    [[nodiscard]] Result<std::string>
    read(const std::string& path, const ReadLimit& limit, const std::atomic<bool>* cancelled) const;
    [[nodiscard]] bool exists(const std::string& path) const;
    /// Names of the regular files in a folder; none if it lies outside.
    [[nodiscard]] std::vector<std::string> list(const std::string& path,
                                                std::size_t max_count) const;

private:
    struct Folder {
        std::string path;
        std::vector<std::string> names; // the names in `path`, without `.`
        bool is_absolute = false;
    };
    struct Place {
        std::string folder;
        std::string name; // relative to `folder`
    };
    void add_folder(std::string path);
    /// The places that `path` can mean: one for each folder whose path it begins with.
    [[nodiscard]] std::vector<Place> places_of(const std::string& path) const;
    [[nodiscard]] platform::Reason open(const std::string& path, platform::File& file) const;
    [[nodiscard]] std::string refusal() const;

    FilePolicy policy_;
    std::vector<Folder> folders_;
    bool names_absolute_ = false; // the user names a file by an absolute path
};

} // namespace lsys
