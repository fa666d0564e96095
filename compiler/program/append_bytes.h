// SPDX-License-Identifier: MIT
// Builds a hash table key from the bytes of several values.
#pragma once

#include <string>
#include <type_traits>

namespace lsys {

template <typename T>
void append_bytes(std::string& key, const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_same_v<T, float>,
                  "equal values have equal bytes");
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace lsys
