// SPDX-License-Identifier: MIT
#include "grammar/base/grouped_lists.h"

#include <catch2/catch.hpp>

#include <utility>
#include <vector>

using namespace lsys;

namespace {

std::vector<std::uint32_t> copied(std::span<const std::uint32_t> list) {
    return {list.begin(), list.end()};
}

} // namespace

TEST_CASE("lists keep the order of their values, and keys without values have empty lists") {
    const std::vector<std::pair<std::size_t, std::uint32_t>> pairs{{2, 9}, {0, 4}, {2, 1}, {2, 9}};
    const GroupedLists lists(4, [&](auto&& add) {
        for (const auto& [key, value] : pairs) {
            add(key, value);
        }
    });
    CHECK(copied(lists[0]) == std::vector<std::uint32_t>{4});
    CHECK(lists[1].empty());
    CHECK(copied(lists[2]) == std::vector<std::uint32_t>{9, 1, 9});
    CHECK(lists[3].empty());
    CHECK(copied(lists.all()) == std::vector<std::uint32_t>{4, 9, 1, 9});
    CHECK(GroupedLists(0, [](auto&&) {}).all().empty());
}
