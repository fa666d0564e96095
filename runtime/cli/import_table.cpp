// SPDX-License-Identifier: MIT
#include "runtime/cli/import_table.h"

#include "grammar/base/counted_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys::lsc {

void ImportTable::add(Kind kind, std::string file, std::string language, std::string result) {
    rows_.push_back({kind, std::move(file), std::move(language), std::move(result)});
}

std::size_t ImportTable::count(Kind kind) const {
    return static_cast<std::size_t>(std::count_if(
        rows_.begin(), rows_.end(), [kind](const Row& row) { return row.kind == kind; }));
}

std::string ImportTable::text(bool is_quiet) const {
    constexpr std::size_t kMaxWidth = 60; // of a column; longer texts move the columns after them
    std::size_t file = 0;
    std::size_t language = 0;
    for (const Row& row : rows_) {
        file = std::max(file, std::min(row.file.size(), kMaxWidth));
        language = std::max(language, std::min(row.language.size(), kMaxWidth));
    }
    std::string text;
    for (const Row& row : rows_) {
        if (!is_quiet || row.kind == Kind::Failed) {
            text += fmt::format("{:{}}  {:{}}  {}{}\n", row.file, file, row.language, language,
                                row.kind == Kind::Imported ? ""
                                : row.kind == Kind::Failed ? "not imported: "
                                                           : "not read: ",
                                row.result);
        }
    }
    const std::size_t unread = count(Kind::NotRead);
    text += fmt::format("{} imported, {} not", count(Kind::Imported), count(Kind::Failed));
    return text + (unread == 0 ? "\n" : fmt::format("; {} not read\n", counted(unread, "file")));
}

} // namespace lsys::lsc
