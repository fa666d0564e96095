// SPDX-License-Identifier: MIT
// Parts of C++20 that are missing in libc++ 13 of Emscripten 3.1.6: std::bit_cast, arrays of make_unique without
// initial values, the order of strings, and algorithms of ranges. The toolchain web.cmake includes this before every
// source; newer versions of libc++ have all of it.
#pragma once

#if defined(__cplusplus)
#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000 && __cplusplus >= 202002L
#include <algorithm>
#include <compare>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace std {

template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
    static_assert(sizeof(To) == sizeof(From));
    return __builtin_bit_cast(To, from);
}

template <typename Array>
unique_ptr<Array> make_unique_for_overwrite(size_t count) {
    static_assert(is_array_v<Array>);
    return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}

inline strong_ordering operator<=>(const string& first, const string& second) noexcept {
    return first.compare(second) <=> 0;
}

namespace ranges {

template <typename Range, typename Value>
constexpr auto find(Range&& range, const Value& value) {
    return std::find(std::begin(range), std::end(range), value);
}

template <typename Range, typename Value, typename Projection>
constexpr auto find(Range&& range, const Value& value, Projection projection) {
    return std::find_if(std::begin(range), std::end(range),
                        [&](const auto& item) { return std::invoke(projection, item) == value; });
}

template <typename Range, typename Value>
constexpr std::ptrdiff_t count(Range&& range, const Value& value) {
    return std::count(std::begin(range), std::end(range), value);
}

template <typename Range, typename Predicate>
constexpr bool all_of(Range&& range, Predicate predicate) {
    return std::all_of(std::begin(range), std::end(range), std::move(predicate));
}

template <typename Range, typename Predicate>
constexpr bool any_of(Range&& range, Predicate predicate) {
    return std::any_of(std::begin(range), std::end(range), std::move(predicate));
}

template <typename Range, typename Less = std::less<>>
constexpr void sort(Range&& range, Less less = {}) {
    std::sort(std::begin(range), std::end(range), std::move(less));
}

} // namespace ranges
} // namespace std

#endif
#endif
