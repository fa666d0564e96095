// SPDX-License-Identifier: MIT
// The table that `lsc import` prints about the files of a folder, or the systems of a file: one row
// for each, with the reason if it was not imported, and a line with the counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lsys::lsc {

class ImportTable {
public:
    /// NotRead: the file is no grammar to import.
    enum class Kind : std::uint8_t { Imported, Failed, NotRead };

    /// `language`: empty if it is not known. `result`: the written file, or the reason.
    void add(Kind kind, std::string file, std::string language, std::string result);
    /// The rows in columns, and the counts. Quiet: without the rows of imported and unread files.
    [[nodiscard]] std::string text(bool is_quiet) const;

private:
    struct Row {
        Kind kind{};
        std::string file;
        std::string language;
        std::string result;
    };
    [[nodiscard]] std::size_t count(Kind kind) const;

    std::vector<Row> rows_;
};

} // namespace lsys::lsc
