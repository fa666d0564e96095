// SPDX-License-Identifier: MIT
#include "grammar/base/find_any.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace lsys;

TEST_CASE("the first of several characters is found at every position") {
    constexpr std::size_t kSize = 100; // several blocks and a remainder
    for (std::size_t at = 0; at <= kSize; ++at) {
        for (std::size_t found = 0; found < kSize; ++found) {
            std::string text(kSize, 'a');
            text[found] = found % 2 == 0 ? ';' : '\n';
            text.replace(0, found / 2, found / 2, ';'); // any `;` before `at` is not found
            const std::size_t expected = std::min(text.find_first_of(";\n", at), kSize);
            REQUIRE(find_any<';', '\n'>(text, at) == expected);
        }
    }
    CHECK(find_any<';'>("", 0) == 0);
    CHECK(find_any<';'>("abc", 3) == 3);
    CHECK(find_any<';'>(std::string_view(";;;;", 2), 2) == 2);
    CHECK(find_any<'a', '\xff'>(std::string(40, '\x7f') + '\xff', 0) == 40);
}
