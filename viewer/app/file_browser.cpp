// SPDX-License-Identifier: MIT
#include "viewer/app/file_browser.h"

#include "grammar/base/paths.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/platform/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lsys::view {

namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& each : result) {
        each = each >= 'A' && each <= 'Z' ? static_cast<char>(each - 'A' + 'a') : each;
    }
    return result;
}

std::string joined(const std::string& folder, const std::string& name) {
    return folder.ends_with('/') ? folder + name : folder + '/' + name;
}

/// The path without `.`, `..` and the separator at its end.
std::string normal(const std::string& path) {
    std::string text = path_text(path_of(path).lexically_normal());
    if (text.size() > 1 && text.ends_with('/')) {
        text.pop_back();
    }
    return text;
}

} // namespace

bool can_open(std::string_view path) {
    return has_grammar_extension(path) || is_scene(std::string(path));
}

std::vector<FolderEntry> list_folder(const std::string& folder) {
    std::vector<FolderEntry> entries;
    std::error_code error;
    for (std::filesystem::directory_iterator each(path_of(folder), error), end;
         !error && each != end; each.increment(error)) {
        std::error_code ignored;
        std::string name = path_text(each->path().filename());
        const bool is_folder = each->is_directory(ignored);
        if (!name.starts_with('.') && (is_folder || can_open(name))) {
            entries.push_back({std::move(name), is_folder});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
        return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
    });
    return entries;
}

std::string neighbour_file(const std::string& file, int step) {
    std::string folder(folder_of_path(file));
    std::vector<FolderEntry> entries = list_folder(folder.empty() ? "." : folder);
    std::erase_if(entries, [](const FolderEntry& each) { return each.is_folder; });
    const std::string_view name = name_of_path(file);
    const auto shown = std::find_if(entries.begin(), entries.end(),
                                    [&](const FolderEntry& each) { return each.name == name; });
    if (entries.empty() || (entries.size() == 1 && shown != entries.end())) {
        return {};
    }
    const auto count = static_cast<std::ptrdiff_t>(entries.size());
    // A file that is not in the list counts as being before the first entry.
    const std::ptrdiff_t at = shown == entries.end() ? -1 : shown - entries.begin();
    const std::ptrdiff_t wanted = ((at + step) % count + count) % count;
    return folder + entries[static_cast<std::size_t>(wanted)].name;
}

std::string FileBrowser::home_folder() {
    const char* const home = std::getenv("HOME");
    return home != nullptr && *home != '\0' ? home : "/";
}

void FileBrowser::show(const std::string& folder) {
    std::error_code error;
    const std::filesystem::path absolute =
        std::filesystem::absolute(path_of(folder.empty() ? "." : folder), error);
    folder_ = normal(path_text(absolute));
    text_.clear();
    read_folder_.clear(); // so that the folder is read again
    filter();
}

void FileBrowser::go_up() {
    const std::string left = folder_;
    show(joined(folder_, ".."));
    const std::string_view name = name_of_path(left);
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const FolderEntry& each) { return each.name == name; });
    selected_ = found == entries_.end() ? 0 : static_cast<std::size_t>(found - entries_.begin());
}

std::string FileBrowser::listed_folder() const {
    const std::string before(folder_of_path(text_));
    if (before.starts_with("~/")) {
        return normal(joined(home_folder(), before.substr(2)));
    }
    return before.empty()             ? folder_
           : is_absolute_path(before) ? normal(before)
                                      : normal(joined(folder_, before));
}

void FileBrowser::filter() {
    const std::string folder = listed_folder();
    if (folder != read_folder_) {
        all_ = list_folder(folder);
        read_folder_ = folder;
    }
    const bool is_path = !folder_of_path(text_).empty();
    const std::string wanted = is_path ? std::string(name_of_path(text_)) : lower(text_);
    entries_.clear();
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(entries_),
                 [&](const FolderEntry& each) {
                     return is_path ? each.name.starts_with(wanted)
                                    : lower(each.name).find(wanted) != std::string::npos;
                 });
    selected_ = 0;
    wants_scroll_ = true;
    mistake_.clear();
}

void FileBrowser::set_text(const std::string& text) {
    text_ = text == "~" ? "~/" : text;
    filter();
}

void FileBrowser::erase_character() {
    if (text_.empty()) {
        go_up();
        return;
    }
    const auto continues = [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
    };
    while (continues(text_.back()) && text_.size() > 1) {
        text_.pop_back();
    }
    text_.pop_back();
    filter();
}

void FileBrowser::complete() {
    const std::string before(folder_of_path(text_));
    const std::string begun(name_of_path(text_));
    std::string common;
    std::size_t count = 0;
    bool is_folder = false;
    for (const FolderEntry& each : entries_) {
        if (!each.name.starts_with(begun)) {
            continue;
        }
        common = count++ == 0
                     ? each.name
                     : common.substr(0, static_cast<std::size_t>(
                                            std::mismatch(common.begin(), common.end(),
                                                          each.name.begin(), each.name.end())
                                                .first -
                                            common.begin()));
        is_folder = each.is_folder;
    }
    if (count != 0) {
        set_text(before + common + (count == 1 && is_folder ? "/" : ""));
    }
}

void FileBrowser::move(int steps) {
    const auto last = static_cast<std::ptrdiff_t>(entries_.size()) - 1;
    const std::ptrdiff_t wanted = static_cast<std::ptrdiff_t>(selected_) + steps;
    wants_scroll_ = true;
    selected_ =
        last < 0
            ? 0
            : static_cast<std::size_t>(std::clamp(wanted, static_cast<std::ptrdiff_t>(0), last));
}

std::string FileBrowser::accept() {
    const std::string folder = listed_folder();
    // A file whose path is typed in full is opened, even if its extension is unknown.
    std::string typed = joined(folder, std::string(name_of_path(text_)));
    const platform::FileType type =
        text_.empty() ? platform::FileType::Missing : platform::facts_of(typed).type;
    if (type == platform::FileType::Regular) {
        return typed;
    }
    if (!text_.empty() && type == platform::FileType::Directory) {
        show(typed);
        return {};
    }
    if (selected_ >= entries_.size()) {
        mistake_ = text_.empty() ? "There is nothing that lsview can open"
                                 : fmt::format("There is no `{}`", text_);
        return {};
    }
    const FolderEntry entry = entries_[selected_];
    if (entry.is_folder) {
        show(joined(folder, entry.name));
        return {};
    }
    return joined(folder, entry.name);
}

} // namespace lsys::view
