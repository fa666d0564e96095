// SPDX-License-Identifier: MIT
#include "viewer/app/file_edits.h"

#include "grammar/base/source.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <utility>

namespace lsys::view {

namespace {

/// Writes `after` to the files of all `changes` if each file still has the bytes `before`; else
/// writes none.
Result<void> write_all(const std::vector<FileChange>& changes, const Console& console) {
    for (const FileChange& change : changes) {
        const Result<std::string> bytes = read_file(change.path, {kMaxSourceBytes}, console);
        if (!bytes) {
            return bytes.error();
        }
        if (bytes.value() != change.before) {
            return Error{fmt::format("`{}` has changed on disk since it was read", change.path)};
        }
    }
    std::vector<Output> outputs;
    for (const FileChange& change : changes) {
        Result<Output> output = Output::open(change.path, console);
        if (!output) {
            return output.error();
        }
        Result<void> written = output.value().write(change.after);
        if (written) {
            written = output.value().finish();
        }
        if (!written) {
            return written;
        }
        outputs.push_back(std::move(output.value()));
    }
    return commit_all(outputs);
}

} // namespace

Result<void> FileEdits::apply(std::vector<FileChange> changes, const Console& console) {
    if (Result<void> written = write_all(changes, console); !written) {
        return written;
    }
    steps_.resize(position_);
    steps_.push_back(std::move(changes));
    ++position_;
    return {};
}

Result<void> FileEdits::go_to(std::size_t position, const Console& console) {
    Result<void> done;
    while (position_ != position) {
        const bool repeats = position_ < position;
        std::vector<FileChange>& step = steps_.at(repeats ? position_ : position_ - 1);
        std::vector<FileChange> changes = step;
        if (!repeats) {
            for (FileChange& change : changes) {
                std::swap(change.before, change.after);
            }
        }
        if (const Result<void> written = write_all(changes, console); !written) {
            step.clear();
            done = written;
        }
        position_ = repeats ? position_ + 1 : position_ - 1;
    }
    return done;
}

void FileEdits::clear() {
    steps_.clear();
    position_ = 0;
}

} // namespace lsys::view
