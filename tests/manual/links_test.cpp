// SPDX-License-Identifier: MIT
// Checks links of documents: the files, folders and headings to which they lead must exist. Checks
// that lines of prose in README.md, CONTRIBUTING.md, CHANGELOG.md and docs/ are short enough to be
// read in any editor.
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace lsys::tests {

namespace {

constexpr std::size_t kMaxLineLength = 120; // characters

bool is_external(std::string_view target) {
    return target.find("://") != std::string_view::npos || target.starts_with("mailto:");
}

/// The mistake in a link; empty if it is correct.
std::string link_mistake(const std::filesystem::path& document, const std::string& target) {
    const std::size_t hash = target.find('#');
    const std::string name = target.substr(0, hash);
    const std::filesystem::path path =
        name.empty() ? source_root() / document : (source_root() / document).parent_path() / name;
    if (!std::filesystem::exists(path)) {
        return "is not there";
    }
    if (hash == std::string::npos) {
        return {};
    }
    const std::vector<Heading> headings = headings_of(read_text(path));
    const bool is_known = std::any_of(headings.begin(), headings.end(), [&](const Heading& one) {
        return one.anchor == target.substr(hash + 1);
    });
    return is_known ? "" : "names a heading that is not there";
}

std::size_t characters_in(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

} // namespace

TEST_CASE("the links of the documents have existing targets") {
    std::size_t count = 0;
    for (const std::filesystem::path& document : all_documents()) {
        for (const Link& link : links_of(read_text(source_root() / document))) {
            if (is_external(link.target)) {
                continue;
            }
            ++count;
            if (const std::string wrong = link_mistake(document, link.target); !wrong.empty()) {
                FAIL_CHECK(document.string()
                           << ":" << link.line << ": `" << link.target << "` " << wrong);
            }
        }
    }
    CHECK(count >= 100);
}

TEST_CASE("lines of prose are short") {
    for (const std::filesystem::path& document : all_documents()) {
        const std::string folder = document.begin()->string();
        if (folder != "docs" && document != "README.md" && document != "CONTRIBUTING.md" &&
            document != "CHANGELOG.md") {
            continue;
        }
        for (const ProseLine& line : prose_of(read_text(source_root() / document))) {
            if (characters_in(line.text) > kMaxLineLength) {
                FAIL_CHECK(document.string() << ":" << line.line << ": " << characters_in(line.text)
                                             << " characters");
            }
        }
    }
}

TEST_CASE("anchors are made as GitHub makes them") {
    const std::vector<Heading> headings = headings_of(
        "# The .lsys language: a test\n\n```\n# no heading\n```\n## 5.1 `let` [x](y.md)\n"
        "## Twice\n## Twice\n");
    REQUIRE(headings.size() == 4);
    CHECK(headings[0].anchor == "the-lsys-language-a-test");
    CHECK(headings[1].anchor == "51-let-x");
    CHECK(headings[2].anchor == "twice");
    CHECK(headings[3].anchor == "twice-1");
}

TEST_CASE("links are found only outside of code") {
    const std::vector<Link> links =
        links_of("[a](b.md#c) ![p](q.png) `[no](link)` ``[no](`link)``\n<img src=\"r.png\">\n"
                 "```\n[no](link)\n```\n[two](t.md)[three](u.md \"title\")\n");
    std::vector<std::string> targets;
    std::transform(links.begin(), links.end(), std::back_inserter(targets),
                   [](const Link& link) { return link.target; });
    CHECK(targets == std::vector<std::string>{"b.md#c", "q.png", "r.png", "t.md", "u.md"});
}

} // namespace lsys::tests
