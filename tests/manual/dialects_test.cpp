// SPDX-License-Identifier: MIT
// Compares the manual of dialects with the table of dialects.
#include "grammar/dialects/dialect.h"
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>
#include <string>

namespace lsys::tests {

namespace {

/// The table row that contains `name` in back quotes; empty if there is none.
std::string table_row(const std::string& document, const std::string& name) {
    std::istringstream lines(document);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("|") && line.find("`" + name + "`") != std::string::npos) {
            return line;
        }
    }
    return {};
}

} // namespace

TEST_CASE("every dialect has a page, a sample and a case, and its extensions are listed") {
    const std::string list = read_text(source_root() / "docs/dialects/README.md");
    for (const DialectRow& row : dialects()) {
        const std::filesystem::path page(row.page);
        INFO(row.name);
        CHECK(std::filesystem::exists(source_root() / page));
        if (row.dialect == Dialect::Lsys) {
            continue;
        }
        const std::string folder = page.stem().string();
        CHECK(std::filesystem::exists(source_root() / "grammar/dialects" / folder));
        CHECK(std::filesystem::exists(source_root() / "samples/dialects" / folder));
        CHECK(std::filesystem::exists(source_root() / "tests/ui" / folder));
        const std::string line = table_row(list, std::string(row.name));
        CHECK(line.find("(" + page.filename().string() + ")") != std::string::npos);
        std::istringstream extensions{std::string(row.extensions)};
        for (std::string extension; extensions >> extension;) {
            INFO(extension);
            CHECK(line.find("`" + extension + "`") != std::string::npos);
        }
    }
}

} // namespace lsys::tests
