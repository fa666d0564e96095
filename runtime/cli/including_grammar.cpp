// SPDX-License-Identifier: MIT
#include "runtime/cli/including_grammar.h"

#include "grammar/base/paths.h"
#include "grammar/lsys/included_names.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

namespace lsys::lsc {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 1000; // files searched per folder
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 20;

/// The .lsys files of a folder, sorted by name.
std::vector<fs::path> grammars_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code failed;
    fs::directory_iterator entries(folder, failed);
    for (; !failed && entries != fs::directory_iterator() && files.size() < kMaxFiles;
         entries.increment(failed)) {
        std::error_code ignored;
        if (entries->path().extension() == ".lsys" && entries->is_regular_file(ignored) &&
            entries->file_size(ignored) <= kMaxFileBytes) {
            files.push_back(entries->path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

bool includes(const fs::path& grammar, const fs::path& part) {
    std::ifstream in(grammar, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::vector<std::string_view> names = included_names(text);
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
        std::error_code ignored;
        return fs::weakly_canonical(grammar.parent_path() / path_of(name), ignored) == part;
    });
}

} // namespace

std::optional<std::string> find_including_grammar(const std::string& path) {
    std::error_code failed;
    const fs::path part = fs::weakly_canonical(path_of(path), failed);
    if (failed || part.empty()) {
        return std::nullopt;
    }
    for (const fs::path& folder : {part.parent_path(), part.parent_path().parent_path()}) {
        for (const fs::path& grammar : grammars_in(folder)) {
            if (grammar != part && includes(grammar, part)) {
                return path_text(grammar.lexically_proximate(fs::current_path(failed)));
            }
        }
    }
    return std::nullopt;
}

} // namespace lsys::lsc
