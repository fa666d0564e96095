// SPDX-License-Identifier: MIT
// InputBytes: takes numbers and texts from the front of a fuzz input. After the end all numbers are
// 0 and all texts are empty.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

class InputBytes {
public:
    InputBytes(const std::uint8_t* data, std::size_t size)
        : bytes_(reinterpret_cast<const char*>(data), size) {}

    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    /// The next bytes as a number, little-endian.
    template <typename Number>
    Number number() {
        Number value{};
        const std::string_view bytes = text(sizeof value);
        if (!bytes.empty()) {
            std::memcpy(&value, bytes.data(), bytes.size());
        }
        return value;
    }
    /// A number from 0 to `count` - 1 from one byte. Precondition: 0 < count.
    std::size_t below(std::size_t count) { return number<std::uint8_t>() % count; }
    /// At most `size` bytes.
    std::string_view text(std::size_t size) {
        const std::string_view taken = bytes_.substr(0, size);
        bytes_.remove_prefix(taken.size());
        return taken;
    }
    std::string_view line() {
        const std::string_view taken = text(std::min(bytes_.find('\n'), bytes_.size()));
        text(1);
        return taken;
    }
    std::string_view rest() { return text(bytes_.size()); }

private:
    std::string_view bytes_;
};
