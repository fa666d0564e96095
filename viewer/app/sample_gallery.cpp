// SPDX-License-Identifier: MIT
#include "viewer/app/sample_gallery.h"

#include "grammar/base/paths.h"
#include "runtime/platform/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::size_t kHeadBytes = 2048; // bytes read from a file to find its title

bool is_file(const std::string& path) {
    return platform::facts_of(path).type == platform::FileType::Regular;
}

std::string head_of(const std::string& path) {
    platform::File file;
    std::string head(kHeadBytes, '\0');
    if (platform::open_to_read(path, false, file) != 0) {
        return {};
    }
    head.resize(platform::read_some(file, head.data(), head.size()).count);
    return head;
}

/// The picture of a sample. NAME.png of a scene may be a map of its trees, so pictures with other
/// names are tried first.
std::string picture_of(const std::string& stem, const std::string& extension) {
    std::vector<std::string> pictures{stem + ".png"};
    if (extension == ".toml") {
        pictures.insert(pictures.begin(), {stem + "-inside.png", stem + "-above.png"});
    }
    const auto found = std::find_if(pictures.begin(), pictures.end(),
                                    [](const std::string& path) { return is_file(path); });
    return found == pictures.end() ? std::string() : *found;
}

/// Appends the samples whose folders lie directly in `folder`.
void add_samples(const std::string& folder, std::vector<GallerySample>& samples) {
    std::error_code error;
    std::vector<std::string> names;
    for (std::filesystem::directory_iterator each(path_of(folder), error), end;
         !error && each != end; each.increment(error)) {
        names.push_back(path_text(each->path().filename()));
    }
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
        const std::string stem = fmt::format("{0}/{1}/{1}", folder, name);
        for (const char* const extension : {".lsys", ".toml"}) {
            if (is_file(stem + extension)) {
                GallerySample& sample = samples.emplace_back();
                sample.name = name;
                sample.file = stem + extension;
                sample.title = title_of_text(head_of(sample.file));
                sample.picture = picture_of(stem, extension);
                break;
            }
        }
    }
}

/// Whether a folder has samples of lsc, and not other files under the same name.
bool holds_samples(const std::filesystem::path& folder) {
    return is_file(path_text(folder / "README.md")) &&
           platform::facts_of(path_text(folder / "species")).type == platform::FileType::Directory;
}

} // namespace

std::string samples_folder() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    std::vector<std::filesystem::path> folders;
    if (!error) {
        std::filesystem::path around = program.parent_path();
        folders.push_back(around.parent_path() / "share/lsc/samples");
        constexpr int kMaxParentFolders = 4; // folders from build/PRESET/tests up to the sources
        for (int level = 0; level < kMaxParentFolders; ++level) {
            folders.push_back(around / "samples");
            around = around.parent_path();
        }
    }
    const char* const variable = std::getenv("XDG_DATA_DIRS");
    const std::string_view data_folders =
        variable == nullptr || *variable == '\0' ? "/usr/local/share:/usr/share" : variable;
    for (std::size_t begin = 0; begin < data_folders.size();) {
        const std::size_t end = std::min(data_folders.find(':', begin), data_folders.size());
        folders.push_back(path_of(data_folders.substr(begin, end - begin)) / "lsc/samples");
        begin = end + 1;
    }
    const auto found = std::find_if(folders.begin(), folders.end(), holds_samples);
    return found == folders.end() ? std::string() : path_text(*found);
}

std::vector<GallerySample> find_samples(const std::string& folder) {
    std::vector<GallerySample> samples;
    if (!folder.empty()) {
        for (const char* const below : {"/species", "/scenes", ""}) {
            add_samples(folder + below, samples);
        }
    }
    return samples;
}

std::string title_of_text(std::string_view text) {
    std::string title;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view each = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t mark = each.starts_with("//") ? 2 : each.starts_with("# ") ? 1 : 0;
        each.remove_prefix(std::min(each.find_first_not_of(' ', mark), each.size()));
        if (mark == 0 || each.empty()) {
            break;
        }
        title += title.empty() ? "" : " ";
        title += each;
        const std::size_t stop = title.find(". ");
        if (stop != std::string::npos) {
            title.resize(stop);
            return title;
        }
    }
    if (title.ends_with('.')) {
        title.pop_back();
    }
    return title;
}

Texture thumbnail_of(std::string_view bytes, std::uint32_t side) {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{64} << 20U;
    const Result<Texture> read = read_picture(bytes, kMaxBytes);
    if (!read || read.value().width == 0) {
        return {};
    }
    const Texture& picture = read.value();
    const std::uint32_t step = (std::max(picture.width, picture.height) + side - 1) / side;
    Texture small;
    small.width = std::max(picture.width / step, 1U);
    small.height = std::max(picture.height / step, 1U);
    small.texels.reserve(std::size_t{4} * small.width * small.height);
    for (std::uint32_t y = 0; y < small.height; ++y) {
        for (std::uint32_t x = 0; x < small.width; ++x) {
            std::array<std::uint32_t, 4> sum{};
            std::uint32_t count = 0;
            for (std::uint32_t row = y * step; row < std::min((y + 1) * step, picture.height);
                 ++row) {
                for (std::uint32_t column = x * step;
                     column < std::min((x + 1) * step, picture.width); ++column) {
                    const std::size_t at =
                        std::size_t{4} * (std::size_t{row} * picture.width + column);
                    for (std::size_t channel = 0; channel < 4; ++channel) {
                        sum[channel] += picture.texels[at + channel];
                    }
                    ++count;
                }
            }
            for (const std::uint32_t each : sum) {
                small.texels.push_back(static_cast<std::uint8_t>(each / count));
            }
        }
    }
    return small;
}

} // namespace lsys::view
