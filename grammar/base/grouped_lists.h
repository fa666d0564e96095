// SPDX-License-Identifier: MIT
// Lists of numbers by key in one array, made by a counting sort.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace lsys {

class GroupedLists {
public:
    GroupedLists() = default;
    /// `for_each_pair(add)` calls `add(key, value)` for each pair, with keys below `key_count`; it
    /// is called twice. A list keeps the order of its values.
    template <typename ForEachPair>
    GroupedLists(std::size_t key_count, ForEachPair&& for_each_pair) : first_(key_count + 1, 0) {
        for_each_pair([&](std::size_t key, std::uint32_t /*value*/) { ++first_[key + 1]; });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        values_.resize(first_.back());
        std::vector<std::uint32_t> next = first_;
        for_each_pair([&](std::size_t key, std::uint32_t value) { values_[next[key]++] = value; });
    }

    /// Precondition: key < key_count.
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t key) const {
        return std::span(values_).subspan(first_[key], first_[key + 1] - first_[key]);
    }
    /// The values of all lists, in order of their keys.
    [[nodiscard]] std::span<const std::uint32_t> all() const { return values_; }

private:
    std::vector<std::uint32_t> first_; // list k is [first_[k], first_[k + 1]) of values_
    std::vector<std::uint32_t> values_;
};

} // namespace lsys
