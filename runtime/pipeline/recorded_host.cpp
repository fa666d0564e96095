// SPDX-License-Identifier: MIT
#include "runtime/pipeline/recorded_host.h"

#include <algorithm>
#include <utility>

namespace lsys {

Host record_files(Host host, std::vector<std::string>& files) {
    const auto add = [&files](const std::string& path) {
        if (std::find(files.begin(), files.end(), path) == files.end()) {
            files.push_back(path);
        }
    };
    const auto recorded = [add](auto read) {
        return [add, read = std::move(read)](const std::string& path, const ReadLimit& limit) {
            add(path);
            return read(path, limit);
        };
    };
    host.read_file = recorded(std::move(host.read_file));
    host.read_referenced_file = recorded(std::move(host.read_referenced_file));
    host.file_exists = [add, exists = std::move(host.file_exists)](const std::string& path) {
        add(path);
        return exists(path);
    };
    return host;
}

} // namespace lsys
