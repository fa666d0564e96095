// SPDX-License-Identifier: MIT
#include "runtime/program/temporary_file.h"

#include "grammar/base/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

using platform::File;
using platform::Reason;

// Numbered names are tried first: a later run finds files that killed processes left under them
// without reading the folder. Files left under random names stay.
constexpr int kNumberedNames = 4;
constexpr int kRandomNames = 100;

constexpr std::size_t kMaxName = 255; // bytes of the name of a file
constexpr std::size_t kMaxAddition = std::string_view(".lsys-abcdef.tmp").size();

/// The part of `target` with which the paths of its temporary files begin: all of it, unless their
/// names would be too long. Does not end within a character of UTF-8.
std::string_view temporary_beginning(std::string_view target) {
    const std::size_t name = folder_of_path(target).size();
    std::size_t end = std::min(target.size(), name + kMaxName - kMaxAddition);
    const auto is_within_character = [&target](std::size_t at) {
        return at < target.size() && (static_cast<unsigned char>(target[at]) & 0xC0U) == 0x80U;
    };
    while (end > name && is_within_character(end)) {
        --end;
    }
    return target.substr(0, end);
}

std::string temporary_path(std::string_view target, std::string_view mark) {
    return fmt::format("{}.lsys-{}.tmp", temporary_beginning(target), mark);
}

std::string numbered_path_of(const std::string& target, int number) {
    return temporary_path(target, std::to_string(number));
}

/// Whether numbered_path_of() returns `path`. Allocates nothing.
bool is_numbered_path(std::string_view path, std::string_view target) {
    static_assert(kNumberedNames <= 10); // one digit
    constexpr std::string_view kBefore = ".lsys-";
    constexpr std::string_view kBehind = ".tmp";
    const std::string_view beginning = temporary_beginning(target);
    if (!path.starts_with(beginning)) {
        return false;
    }
    const std::string_view end = path.substr(beginning.size());
    return end.size() == kBefore.size() + 1 + kBehind.size() && end.starts_with(kBefore) &&
           end.ends_with(kBehind) && end[kBefore.size()] >= '0' &&
           end[kBefore.size()] < '0' + kNumberedNames;
}

/// Six random letters or digits.
std::string random_letters() {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::uint64_t bits = platform::random_bits();
    std::string letters;
    for (int i = 0; i < 6; ++i) {
        letters += kLetters[bits % kLetters.size()];
        bits /= kLetters.size();
    }
    return letters;
}

/// Makes and locks a file. EEXIST also if another process has removed it before it was locked.
Reason create_locked(const std::string& path, bool is_private, File& file) {
    if (const Reason reason = platform::create_file(path, is_private, file); reason != 0) {
        return reason;
    }
    if (platform::lock_new_file(file)) {
        return 0;
    }
    file = File();
    return EEXIST;
}

} // namespace

Reason
create_temporary_file(const std::string& target, bool is_private, std::string& path, File& file) {
    for (int number = 0; number < kNumberedNames; ++number) {
        platform::remove_unlocked_file(numbered_path_of(target, number),
                                       platform::WithoutLocks::Keep);
    }
    for (int attempt = 0; attempt < kNumberedNames + kRandomNames; ++attempt) {
        std::string name = attempt < kNumberedNames ? numbered_path_of(target, attempt)
                                                    : temporary_path(target, random_letters());
        const Reason reason = create_locked(name, is_private, file);
        if (reason != EEXIST) {
            path = reason == 0 ? std::move(name) : path;
            return reason;
        }
    }
    return EEXIST;
}

void remove_unlocked_temporary(const std::string& path, const std::string& target) noexcept {
    if (is_numbered_path(path, target)) {
        platform::remove_unlocked_file(path, platform::WithoutLocks::Remove);
    } else {
        platform::remove_file(path.c_str()); // nobody else takes a random name
    }
}

} // namespace lsys
