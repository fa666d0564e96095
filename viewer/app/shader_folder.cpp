// SPDX-License-Identifier: MIT
#include "viewer/app/shader_folder.h"

#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace lsys::view {

ShaderSource shaders_of(const std::string& folder, const Console& console) {
    if (folder.empty()) {
        return built_in_shader;
    }
    return [folder, console](std::string_view name) -> std::optional<std::string> {
        constexpr std::uint64_t kMaxBytes = 1 << 20;
        Result<std::string> text =
            read_file((std::filesystem::path(folder) / name).string(), {kMaxBytes}, console);
        return text ? std::optional(std::move(text.value())) : std::nullopt;
    };
}

Error shader_error(const std::string& folder, const Error& error) {
    return folder.empty() ? error
                          : Error{fmt::format("in the folder `{}`: {}", folder, error.message)};
}

std::vector<std::string> shader_files(const std::string& folder) {
    std::vector<std::string> files;
    if (folder.empty()) {
        return files;
    }
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    while (!error && entry != std::filesystem::directory_iterator()) {
        if (entry->path().extension() == ".glsl") {
            files.push_back(entry->path().string());
        }
        entry.increment(error);
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace lsys::view
