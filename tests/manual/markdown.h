// SPDX-License-Identifier: MIT
// The documents of the project, and the parts of Markdown that the tests read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

/// The root of the sources.
[[nodiscard]] std::filesystem::path source_root();

/// Every Markdown file of the project, relative to source_root(), sorted.
[[nodiscard]] std::vector<std::filesystem::path> all_documents();

/// A block between two lines ```.
struct Fence {
    std::size_t line = 0; // number of its first line ```, from 1
    std::string info;     // text after the ```: "lsys check", "console"
    std::vector<std::string> lines;

    [[nodiscard]] std::string text() const;
};
[[nodiscard]] std::vector<Fence> fences_of(std::string_view document);

struct Heading {
    std::size_t line = 0; // from 1
    std::string text;
    std::string anchor; // as GitHub makes it
};
[[nodiscard]] std::vector<Heading> headings_of(std::string_view document);

struct Link {
    std::size_t line = 0; // from 1
    std::string target;
};
/// Links and pictures, including those in HTML tags but not those in code.
[[nodiscard]] std::vector<Link> links_of(std::string_view document);

/// Lines of prose: no code, no table, no heading.
struct ProseLine {
    std::size_t line = 0; // from 1
    std::string text;
};
[[nodiscard]] std::vector<ProseLine> prose_of(std::string_view document);

} // namespace lsys::tests
