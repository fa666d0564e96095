// SPDX-License-Identifier: MIT
#include "runtime/program/run_files.h"

#include "grammar/base/paths.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

std::string resolved(const std::string& path) {
    std::error_code failed;
    // Absolute first: weakly_canonical() leaves a relative path of a missing file relative, so that
    // the file would have another path as soon as it is written.
    const std::filesystem::path absolute = std::filesystem::absolute(path_of(path), failed);
    const std::filesystem::path whole = std::filesystem::weakly_canonical(absolute, failed);
    return failed ? path_text(absolute) : path_text(whole);
}

} // namespace

void RunFiles::note_read(const std::string& path) {
    std::string whole = resolved(path);
    const std::lock_guard<std::mutex> lock(mutex_);
    read_.insert(std::move(whole));
}

void note_read(RunFiles* files, const std::vector<std::string>& paths) {
    if (files != nullptr) {
        for (const std::string& path : paths) {
            files->note_read(path);
        }
    }
}

bool RunFiles::is_read(const std::string& path) {
    const std::string whole = resolved(path);
    const std::lock_guard<std::mutex> lock(mutex_);
    return read_.count(whole) != 0;
}

std::string_view RunFiles::begin_write(const std::string& path) {
    std::string whole = resolved(path);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (read_.count(whole) != 0) {
        return kIsInput;
    }
    return written_.insert(std::move(whole)).second ? "" : "it is another output of this command";
}

} // namespace lsys
