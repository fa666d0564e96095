#include "viewer/app/recorded_host.h"

#include <algorithm>
#include <utility>

namespace lsys::view {

Host record_files(Host host, std::vector<std::string>& files) {
    const auto add = [&files](const std::string& path) {
        if (std::find(files.begin(), files.end(), path) == files.end()) {
            files.push_back(path);
        }
    };
    host.read_file = [add, read = std::move(host.read_file)](const std::string& path,
                                                             std::uint64_t max_bytes) {
        add(path);
        return read(path, max_bytes);
    };
    host.file_exists = [add, exists = std::move(host.file_exists)](const std::string& path) {
        add(path);
        return exists(path);
    };
    return host;
}

} // namespace lsys::view
