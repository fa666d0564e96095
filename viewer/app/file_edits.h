// SPDX-License-Identifier: MIT
// FileEdits: changes of files on disk, with undo and redo.
#pragma once

#include "grammar/base/result.h"
#include "runtime/program/console.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsys::view {

/// The bytes of a file before and after a change.
struct FileChange {
    std::string path;
    std::string before;
    std::string after;
};

class FileEdits {
public:
    /// Writes the files of a step, all or none. Error: a file on disk differs from `before`, or
    /// cannot be written; then nothing is written.
    [[nodiscard]] Result<void> apply(std::vector<FileChange> changes, const Console& console);
    /// Count of steps that are applied.
    [[nodiscard]] std::size_t position() const { return position_; }
    /// Undoes or repeats steps until `position` steps are applied. Error: another program has
    /// changed a file since, or a file cannot be written; then this step is skipped and its files
    /// stay unchanged.
    [[nodiscard]] Result<void> go_to(std::size_t position, const Console& console);
    void clear();

private:
    std::vector<std::vector<FileChange>> steps_; // a skipped step has no changes
    std::size_t position_ = 0;                   // number of applied steps
};

} // namespace lsys::view
