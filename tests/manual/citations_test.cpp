// SPDX-License-Identifier: MIT
// Checks citations of documents in sources, scripts and documents: `docs/language.md section 5`
// must name an existing file and one of its sections.
#include "tests/manual/markdown.h"
#include "tests/support/lsc_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::tests {

namespace {

constexpr std::string_view kExtension = ".md";

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_path_char(char c) {
    return is_word(c) || c == '-' || c == '.' || c == '/';
}

struct Citation {
    std::string path;
    std::vector<std::string> sections;
};

/// Offset of the next word. Blanks, line ends, and the characters that begin comment lines are
/// skipped.
std::size_t next_word(std::string_view text, std::size_t at) {
    return std::min(text.find_first_not_of(" \t\r\n/#*|`", at), text.size());
}

/// The number at `at`, `5` or `5.1`; empty if there is none. Moves `at` past it.
std::string number_at(std::string_view text, std::size_t& at) {
    std::size_t end = at;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) != 0 ||
                                 (text[end] == '.' && end > at && end + 1 < text.size() &&
                                  std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0))) {
        ++end;
    }
    const std::string number(text.substr(at, end - at));
    at = end;
    return number;
}

/// The numbers in `section 5`, `sections 4 to 6`, or `sections 6 and 9`.
std::vector<std::string> sections_after(std::string_view text, std::size_t at) {
    at = next_word(text, at);
    if (text.substr(at, 7) != "section") {
        return {};
    }
    at += text.substr(at, 8) == "sections" ? 8U : 7U;
    std::vector<std::string> numbers;
    for (bool more = true; more;) {
        at = next_word(text, at);
        const std::string number = number_at(text, at);
        if (number.empty()) {
            break;
        }
        numbers.push_back(number);
        more = false;
        const std::size_t next = next_word(text, at);
        for (const std::string_view link : {",", "and ", "to ", "and\n", "to\n"}) {
            if (text.substr(next, link.size()) == link) {
                more = true;
                at = next + link.size();
            }
        }
    }
    return numbers;
}

std::vector<Citation> citations_in(std::string_view text) {
    std::vector<Citation> found;
    for (std::size_t at = text.find(kExtension); at != std::string_view::npos;
         at = text.find(kExtension, at + 1)) {
        const std::size_t end = at + kExtension.size();
        std::size_t begin = at;
        while (begin > 0 && is_path_char(text[begin - 1])) {
            --begin;
        }
        const bool is_url = begin > 0 && text[begin - 1] == ':' && text[begin] == '/';
        if (begin > 0 && text[begin - 1] == '$') { // the path begins with a variable of a script
            begin = std::min(text.find('/', begin), at);
        }
        begin += text[begin] == '/' ? 1U : 0U; // skip the `/` after a variable
        const bool is_name =
            begin < at && is_word(text[at - 1]) && (end == text.size() || !is_word(text[end]));
        const bool is_pattern = begin > 0 && (text[begin - 1] == '*' || text[begin - 1] == '>');
        if (!is_name || is_pattern || is_url) {
            continue;
        }
        found.push_back({std::string(text.substr(begin, end - begin)), sections_after(text, end)});
    }
    return found;
}

/// Numbers of the headings of a document, such as `5` of `## 5. Matching` and `5.1` of `### 5.1
/// Productions`.
std::set<std::string> sections_of(const std::filesystem::path& document) {
    std::set<std::string> numbers;
    for (const Heading& heading : headings_of(read_text(document))) {
        std::size_t at = 0;
        const std::string number = number_at(heading.text, at);
        if (!number.empty()) {
            numbers.insert(number);
        }
    }
    return numbers;
}

/// All sources, scripts and documents of the project.
std::vector<std::filesystem::path> all_sources() {
    constexpr std::array<std::string_view, 13> kExtensions{".h",  ".cpp",  ".in",    ".def", ".ll",
                                                           ".yy", ".glsl", ".cmake", ".txt", ".md",
                                                           ".py", ".lsys", ""};
    const std::filesystem::path root = source_root();
    std::vector<std::filesystem::path> sources;
    auto walk = std::filesystem::recursive_directory_iterator(root);
    for (auto entry = begin(walk); entry != end(walk); ++entry) {
        const std::string name = entry->path().filename().string();
        if (entry->is_directory()) {
            if (name == "build" || name == "node_modules" || name == ".git" || name == "corpus") {
                entry.disable_recursion_pending();
            }
        } else if (name != "citations_test.cpp" && name != "links_test.cpp" &&
                   std::find(kExtensions.begin(), kExtensions.end(),
                             entry->path().extension().string()) != kExtensions.end() &&
                   entry->path().string().find("/parts/") == std::string::npos) {
            sources.push_back(entry->path());
        }
    }
    return sources;
}

/// Path of the document that `source` cites as `path`; empty if there is no such document.
std::filesystem::path cited(const std::filesystem::path& source, const std::string& path) {
    for (const std::filesystem::path& folder : {source_root(), source.parent_path()}) {
        if (std::filesystem::exists(folder / path)) {
            return folder / path;
        }
    }
    return {};
}

} // namespace

TEST_CASE("every document and section that a file cites exists") {
    std::map<std::string, std::set<std::string>> known;
    std::size_t count = 0;
    std::size_t with_section = 0;
    for (const std::filesystem::path& source : all_sources()) {
        const std::string name = source.lexically_relative(source_root()).string();
        for (const Citation& citation : citations_in(read_text(source))) {
            ++count;
            const std::filesystem::path document = cited(source, citation.path);
            if (document.empty()) {
                FAIL_CHECK(name << " cites " << citation.path << ", which is not there");
                continue;
            }
            const auto [at, is_new] = known.try_emplace(document.string());
            if (is_new) {
                at->second = sections_of(document);
            }
            for (const std::string& section : citation.sections) {
                ++with_section;
                if (at->second.count(section) == 0) {
                    FAIL_CHECK(name << " cites section " << section << " of " << citation.path
                                    << ", which has none");
                }
            }
        }
    }
    CHECK(count >= 60);
    CHECK(with_section >= 30);
}

TEST_CASE("citations are found across line ends") {
    const std::vector<Citation> found = citations_in(
        "// (docs/language.md\n/// sections 4 to\n// 6.1), and README.md; see https://x.org/a.md.\n"
        "# docs/a.md sections 6, 7 and 9. *.md x.mdx $root/b.md ${ROOT}/c.md");
    REQUIRE(found.size() == 5);
    CHECK(found[0].path == "docs/language.md");
    CHECK(found[0].sections == std::vector<std::string>{"4", "6.1"});
    CHECK(found[1].path == "README.md");
    CHECK(found[1].sections.empty());
    CHECK(found[2].sections == std::vector<std::string>{"6", "7", "9"});
    CHECK(found[3].path == "b.md");
    CHECK(found[4].path == "c.md");
}

} // namespace lsys::tests
