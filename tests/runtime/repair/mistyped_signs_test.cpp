// SPDX-License-Identifier: MIT
#include "runtime/repair/impl/mistyped_signs.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>
#include <vector>

using namespace lsys::repair;

namespace {

/// mistyped_texts() of `before` + `added` + `after`.
std::vector<std::string>
alternatives(const std::string& before, const std::string& added, const std::string& after) {
    const auto begin = static_cast<std::uint32_t>(before.size());
    const std::string text = before + added + after;
    return mistyped_texts(text, {begin, begin + static_cast<std::uint32_t>(added.size())});
}

} // namespace

TEST_CASE("an added sign is one character") {
    CHECK(added_sign(";") == ';');
    CHECK(added_sign(" :") == ':');
    CHECK(added_sign("* ") == '*');
    CHECK(added_sign("") == '\0');
    CHECK(added_sign(" ") == '\0');
    CHECK(added_sign("let a") == '\0');
}

TEST_CASE("an added sign may replace a character next to it") {
    using Texts = std::vector<std::string>;
    CHECK(alternatives("#w : FA", ";", "\n#n = 3;\n") == Texts{"#w : F;\n#n = 3;\n"});
    CHECK(alternatives("#w x", " :", " F;") == Texts{"#w : F;", "#w x :;"});
    CHECK(alternatives("#w", " :", " x F;") == Texts{"#: x F;", "#w : F;"});
}

TEST_CASE("an added sign has the same blanks as others of the text") {
    // No other `;` follows a blank.
    CHECK(alternatives("#n = 3;\n#w : F A", ";", "\n#p : F : * : F;\n").empty());
    CHECK(alternatives("#n = 3 ;\n#w : F A", ";", "\n").size() == 1);
    // The `;` of an empty successor has a blank before it in any layout.
    CHECK(alternatives("#n = 3;\n#p : F : * : p", ";", "\n").size() == 1);
}

TEST_CASE("an equal sign before the last character may have been exchanged with it") {
    CHECK(alternatives("#w : F;`", ";", "\n") == std::vector<std::string>{"#w : F`;\n"});
}

TEST_CASE("adjacent equal signs are no alternative") {
    CHECK(alternatives("#w : F;", ";", "\n").empty());
}
