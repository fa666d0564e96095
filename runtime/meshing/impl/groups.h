// SPDX-License-Identifier: MIT
// Groups: items sorted by key, for meshers that write all items of a kind and material at once.
#pragma once

#include "runtime/base/large_vector.h"

#include <cstdint>
#include <map>
#include <vector>

namespace lsys {

inline constexpr std::uint64_t kNoGroup = ~std::uint64_t{0}; // key of items that are left out

struct Group {
    std::uint64_t key = 0;   // of all its items
    std::uint64_t first = 0; // index in Groups::items
    std::uint64_t count = 0;
};

struct Groups {
    std::vector<Group> groups;        // by ascending key
    LargeVector<std::uint32_t> items; // sorted by key, equal keys in ascending order
};

/// Sorts the items 0 ... count - 1 by key_of(item), which is called twice for each item.
template <typename KeyOf>
[[nodiscard]] Groups group_items(std::uint64_t count, const KeyOf& key_of) {
    std::map<std::uint64_t, std::uint64_t> places; // by key: item count, later index of the next
    // Items of equal keys often follow each other, so the last lookup is cached.
    std::uint64_t last_key = kNoGroup;
    std::uint64_t* place = nullptr;
    const auto find = [&](std::uint64_t key) -> std::uint64_t& {
        if (place == nullptr || key != last_key) {
            place = &places[key];
            last_key = key;
        }
        return *place;
    };
    std::uint64_t kept = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t key = key_of(i);
        if (key != kNoGroup) {
            ++find(key);
            ++kept;
        }
    }
    Groups result;
    std::uint64_t first = 0;
    for (auto& [key, number] : places) {
        result.groups.push_back({.key = key, .first = first, .count = number});
        const std::uint64_t begin = first;
        first += number;
        number = begin;
    }
    result.items.resize(kept);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t key = key_of(i);
        if (key != kNoGroup) {
            result.items[find(key)++] = static_cast<std::uint32_t>(i);
        }
    }
    return result;
}

} // namespace lsys
