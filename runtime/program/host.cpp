#include "runtime/program/host.h"

#include "runtime/program/files.h"

#include <filesystem>
#include <system_error>

namespace lsys {

Host make_host(const Console& console) {
    Host host;
    host.read_file = [&console](const std::string& path, std::uint64_t max_bytes) {
        return read_bytes(path, max_bytes, console);
    };
    host.file_exists = [](const std::string& path) {
        std::error_code ignored;
        return std::filesystem::exists(path, ignored);
    };
    host.cancelled = console.io().interrupted;
    return host;
}

Project make_project(const Console& console, const RunOptions& run) {
    return {make_host(console), run.limits, run.threads, console.options().deny_warnings};
}

} // namespace lsys
