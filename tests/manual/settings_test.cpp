// SPDX-License-Identifier: MIT
#include "compiler/bytecode/settings.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

namespace {

using namespace lsys;

std::string text_of(const std::string& path) {
    std::ifstream file(std::string(LSYS_SOURCE_DIR) + "/" + path);
    REQUIRE(file);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The row of the table of settings (docs/language.md section 8) whose first cell has the key.
std::string row_of(std::string_view key) {
    std::string text = text_of("docs/language.md");
    text.erase(0, text.find("\n## 8. "));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("| ") &&
            line.substr(0, line.find(" | ")).find(fmt::format("`{}`", key)) != std::string::npos) {
            return line;
        }
    }
    return {};
}

template <typename Enum>
void check_choice(std::string_view key, Enum initial) {
    CAPTURE(std::string(key));
    const std::string row = row_of(key);
    for (const Enum value : enumerators_of<Enum>()) {
        CHECK(row.find(fmt::format("`{}`", name_of(value))) != std::string::npos);
    }
    CHECK(row.ends_with(fmt::format("| `{}` |", name_of(initial))));
}

template <typename Value>
void check_number(std::string_view key, Value initial) {
    CAPTURE(std::string(key));
    const std::string row = row_of(key);
    const std::string last_cell = row.substr(row.rfind(" | ") + 1);
    CHECK(last_cell.find(fmt::format(" {}", initial)) != std::string::npos);
}

} // namespace

TEST_CASE("the explanation of unknown keys lists every setting") {
    const std::string text = text_of("grammar/explanations.md");
    const std::size_t begin = text.find("`#set` knows the keys `");
    REQUIRE(begin != std::string::npos);
    std::istringstream words(text.substr(begin + 23, text.find("`.", begin) - begin - 23));
    const std::set<std::string> keys{std::istream_iterator<std::string>(words), {}};
    std::set<std::string> known;
#define LSYS_CHOICE(type, field, initial, effect, group) known.insert(#field);
#define LSYS_NUMBER(field, initial, effect, group, min, wanted) known.insert(#field);
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit) known.insert(#field);
#define LSYS_STATEMENT(key) known.insert(#key);
#include "compiler/bytecode/settings.def"
    CHECK(keys == known);
}

TEST_CASE("every setting is documented with its values and its default") {
#define LSYS_CHOICE(type, field, initial, effect, group) check_choice(#field, type::initial);
#define LSYS_NUMBER(field, initial, effect, group, min, wanted) check_number(#field, initial);
#define LSYS_COUNT(field, initial, effect, group, min, max, wanted, misfit)                        \
    check_number(#field, initial);
#define LSYS_STATEMENT(key) CHECK_FALSE(row_of(#key).empty());
#include "compiler/bytecode/settings.def"
}
