// SPDX-License-Identifier: MIT
#include "runtime/program/host.h"

#include "grammar/base/paths.h"
#include "runtime/program/environment_program.h"
#include "runtime/program/file_boundary.h"
#include "runtime/program/files.h"
#include "runtime/program/memory_size.h"
#include "runtime/program/run_files.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kMaxFolderFiles = 10'000;

} // namespace

Host make_file_host(const std::atomic<bool>* cancelled) {
    Host host;
    host.read_file = [cancelled](const std::string& path, const ReadLimit& limit) {
        return read_bytes(path, FileKind::Named, limit, cancelled);
    };
    host.read_referenced_file = [cancelled](const std::string& path, const ReadLimit& limit) {
        return read_bytes(path, FileKind::Regular, limit, cancelled);
    };
    host.file_exists = [](const std::string& path) {
        std::error_code ignored;
        return std::filesystem::exists(path_of(path), ignored);
    };
    host.list_folder = [](const std::string& folder) {
        std::vector<std::string> names;
        std::error_code failed;
        std::filesystem::directory_iterator at(path_of(folder), failed);
        for (const std::filesystem::directory_iterator end;
             !failed && at != end && names.size() < kMaxFolderFiles; at.increment(failed)) {
            std::error_code ignored;
            if (at->is_regular_file(ignored)) {
                names.push_back(at->path().filename().string());
            }
        }
        std::sort(names.begin(), names.end());
        return names;
    };
    host.start_program = start_environment_program;
    host.cancelled = cancelled;
    return host;
}

Host make_file_host(const std::atomic<bool>* cancelled, const FilePolicy& policy) {
    Host host = make_file_host(cancelled);
    if (!policy.is_untrusted) {
        return host;
    }
    const auto boundary = std::make_shared<const FileBoundary>(policy);
    const auto confined = [boundary, cancelled](auto read_named) {
        return [boundary, cancelled, read_named = std::move(read_named)](const std::string& path,
                                                                         const ReadLimit& limit) {
            return boundary->is_named(path) ? read_named(path, limit)
                                            : boundary->read(path, limit, cancelled);
        };
    };
    host.read_file = confined(std::move(host.read_file));
    host.read_referenced_file = confined(std::move(host.read_referenced_file));
    host.file_exists = [boundary, exists = std::move(host.file_exists)](const std::string& path) {
        return boundary->is_named(path) ? exists(path) : boundary->exists(path);
    };
    host.list_folder = [boundary](const std::string& folder) {
        std::vector<std::string> names = boundary->list(folder, kMaxFolderFiles);
        std::sort(names.begin(), names.end());
        return names;
    };
    host.start_program = nullptr;
    host.environment_help = [](const std::string& /*name*/) {
        return std::string("grammars that are not trusted start no programs");
    };
    return host;
}

Host make_host(const Console& console,
               const std::string& standard_input,
               const FilePolicy& policy) {
    Host host = make_file_host(console.io().interrupted, policy);
    if (RunFiles* const files = console.io().files; files != nullptr) {
        for (auto* const read : {&host.read_file, &host.read_referenced_file}) {
            *read = [files, read_named = std::move(*read)](const std::string& path,
                                                           const ReadLimit& limit) {
                files->note_read(path);
                return read_named(path, limit);
            };
        }
    }
    host.read_file = [&console, standard_input, read = std::move(host.read_file)](
                         const std::string& path, const ReadLimit& limit) {
        return path == "-" || path == standard_input ? read_standard_input(limit, console)
                                                     : read(path, limit);
    };
    return host;
}

Project make_project(const Console& console, const RunOptions& run) {
    const std::string input =
        run.stdin_name.empty() ? standard_input_in(run.base) : standard_input_as(run.stdin_name);
    return {make_host(console, input, run.files),
            run.limits,
            run.threads,
            console.options().levels,
            run.environments,
            run.files};
}

FileLoader make_include_loader(const Project& project) {
    return [&project, load = FileLoader()](const std::string& path) mutable {
        if (!load) {
            load = make_loader(project, half_of_memory());
        }
        return load(path);
    };
}

} // namespace lsys
