// SPDX-License-Identifier: MIT
// Counts of the enumerators of enums and of the fields of structs, as constants: for tables, range
// checks and file versions.
//
//   LSYS_COUNTED_ENUM(Mode, Parallel, Sequential);   enum class Mode : std::uint8_t { ... };
//   kCountOf<Mode>                                   2
//   enumerators_of<Mode>()                           {Mode::Parallel, Mode::Sequential}
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace lsys {

/// The constant kCount of each counted enum.
template <typename Enum>
struct EnumCount;

template <typename Enum>
inline constexpr std::size_t kCountOf = EnumCount<Enum>::kCount;

/// Defines an enum of bytes with enumerators from 0 without gaps. Use it in namespace lsys.
#define LSYS_COUNTED_ENUM(name, ...)                                                               \
    enum class name : std::uint8_t { __VA_ARGS__ };                                                \
    template <>                                                                                    \
    struct EnumCount<name> {                                                                       \
        enum Enumerator : std::size_t { __VA_ARGS__, kCount };                                     \
    }

template <typename Enum>
[[nodiscard]] constexpr bool is_enumerator(Enum value) {
    return static_cast<std::size_t>(value) < kCountOf<Enum>;
}

/// All enumerators in order.
template <typename Enum>
[[nodiscard]] constexpr std::array<Enum, kCountOf<Enum>> enumerators_of() {
    std::array<Enum, kCountOf<Enum>> all{};
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i] = static_cast<Enum>(i);
    }
    return all;
}

namespace impl {

struct AnyField {
    template <typename Field>
    // NOLINTNEXTLINE(google-explicit-constructor): stands for a value of any type
    operator Field() const;
};

template <typename Struct, std::size_t... index>
constexpr bool takes_fields(std::index_sequence<index...> /*fields*/) {
    return requires {
        Struct{(static_cast<void>(index), AnyField{})...};
    };
}

template <typename Struct, std::size_t count>
constexpr std::size_t count_fields() {
    if constexpr (takes_fields<Struct>(std::make_index_sequence<count + 1>())) {
        return count_fields<Struct, count + 1>();
    } else {
        return count;
    }
}

} // namespace impl

/// The number of fields of an aggregate without C arrays.
template <typename Struct>
inline constexpr std::size_t kFieldCount = impl::count_fields<Struct, 0>();

} // namespace lsys
