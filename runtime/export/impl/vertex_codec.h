// SPDX-License-Identifier: MIT
// The vertex codec of EXT_meshopt_compression, mode ATTRIBUTES, version 0: the bytes of
// meshopt_encodeVertexBuffer() in a third of the time. Used by compress_items().
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lsys {

/// Max size of the encoded items.
[[nodiscard]] std::size_t max_encoded_bytes(std::size_t items, std::uint32_t stride);
/// Encodes items of `stride` bytes, a multiple of 4 of at most 256. `to` has room for
/// max_encoded_bytes(). Returns the size of the encoded items.
[[nodiscard]] std::size_t
encode_items(std::span<const std::byte> items, std::uint32_t stride, std::byte* to);

} // namespace lsys
