// SPDX-License-Identifier: MIT
// Format: the specification of EXT_meshopt_compression, appendix A, mode 0. Blocks of items store each
// byte of the stride for all items of the block, as differences from the previous item, in groups of
// 16. A group has 0, 2, 4 or 8 bits for each difference; those that do not fit follow it as bytes.
#include "runtime/export/impl/vertex_codec.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace lsys {

namespace {

using Byte = std::uint8_t;

constexpr Byte kHeader = 0xA0; // version 0
constexpr std::size_t kGroup = 16;
constexpr std::size_t kBlockBytes = 8192;
constexpr std::size_t kMaxBlockItems = 256;
constexpr std::size_t kMaxStride = 256;
constexpr std::size_t kMinTail = 32;
constexpr unsigned kGroupsPerHeader = 4; // groups in a byte of the header of a run

constexpr Byte kMax2 = 3;  // 2 bits: the difference follows the group
constexpr Byte kMax4 = 15; // 4 bits: the difference follows the group

std::size_t block_items(std::uint32_t stride) {
    return std::min(kBlockBytes / stride / kGroup * kGroup, kMaxBlockItems);
}

/// 0, 1, -1, 2, -2, ... as 0, 2, 1, 4, 3, ...
Byte zigzag(Byte difference) {
    return static_cast<Byte>((difference << 1U) ^ ((difference & 0x80U) != 0 ? 0xFFU : 0U));
}

/// Writes the differences that do not fit; may write a byte more than it returns.
Byte* put_exceptions(const Byte* group, Byte max, Byte* to) {
    for (std::size_t i = 0; i < kGroup; ++i) {
        *to = group[i];
        to += group[i] >= max ? 1 : 0;
    }
    return to;
}

/// Writes a group and returns its end; `code`: logarithm of its bits, 0 for none.
Byte* put_group(const Byte* group, unsigned& code, Byte* to) {
    unsigned largest = 0;
    unsigned above2 = 0; // number of differences that do not fit into 2 bits
    unsigned above4 = 0;
    for (std::size_t i = 0; i < kGroup; ++i) {
        largest |= group[i];
        above2 += group[i] >= kMax2 ? 1U : 0U;
        above4 += group[i] >= kMax4 ? 1U : 0U;
    }
    const unsigned size2 = kGroup / 4 + above2;
    const unsigned size4 = kGroup / 2 + above4;
    if (largest == 0) {
        code = 0;
        return to;
    }
    if (size2 < kGroup && size2 <= size4) {
        code = 1;
        for (std::size_t i = 0; i < kGroup; i += 4) {
            unsigned packed = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                packed = packed << 2U | std::min(group[i + k], kMax2);
            }
            *to++ = static_cast<Byte>(packed);
        }
        return put_exceptions(group, kMax2, to);
    }
    if (size4 < kGroup) {
        code = 2;
        for (std::size_t i = 0; i < kGroup; i += 2) {
            *to++ =
                static_cast<Byte>(std::min(group[i], kMax4) << 4U | std::min(group[i + 1], kMax4));
        }
        return put_exceptions(group, kMax4, to);
    }
    code = 3;
    std::memcpy(to, group, kGroup);
    return to + kGroup;
}

/// Writes the differences of one byte of the stride; `count` is a multiple of kGroup.
Byte* put_run(const Byte* differences, std::size_t count, Byte* to) {
    const std::size_t groups = count / kGroup;
    Byte* const header = to;
    to += (groups + kGroupsPerHeader - 1) / kGroupsPerHeader;
    std::fill(header, to, Byte{0});
    for (std::size_t i = 0; i < groups; ++i) {
        unsigned code = 0;
        to = put_group(differences + i * kGroup, code, to);
        header[i / kGroupsPerHeader] |= static_cast<Byte>(code << (2 * (i % kGroupsPerHeader)));
    }
    return to;
}

} // namespace

std::size_t max_encoded_bytes(std::size_t items, std::uint32_t stride) {
    const std::size_t block = block_items(stride);
    const std::size_t blocks = (items + block - 1) / block;
    const std::size_t run = block + (block / kGroup + kGroupsPerHeader - 1) / kGroupsPerHeader;
    // One more byte for put_exceptions().
    return 1 + blocks * stride * run + std::max<std::size_t>(stride, kMinTail) + 1;
}

std::size_t encode_items(std::span<const std::byte> items, std::uint32_t stride, std::byte* to) {
    const auto* const from = reinterpret_cast<const Byte*>(items.data());
    const std::size_t count = items.size() / stride;
    const std::size_t block = block_items(stride);
    Byte* at = reinterpret_cast<Byte*>(to);
    *at++ = kHeader;
    std::array<Byte, kMaxStride> first{};
    std::copy_n(from, count != 0 ? stride : 0, first.data());
    std::array<Byte, kMaxStride> last = first;
    for (std::size_t begin = 0; begin < count; begin += block) {
        const std::size_t size = std::min(block, count - begin);
        std::array<Byte, kMaxBlockItems> differences{}; // 0 after the last item
        for (std::uint32_t byte = 0; byte < stride; ++byte) {
            Byte previous = last[byte];
            const Byte* source = from + begin * stride + byte;
            for (std::size_t i = 0; i < size; ++i, source += stride) {
                differences[i] = zigzag(static_cast<Byte>(*source - previous));
                previous = *source;
            }
            last[byte] = previous;
            at = put_run(differences.data(), (size + kGroup - 1) / kGroup * kGroup, at);
        }
    }
    const std::size_t padding = stride < kMinTail ? kMinTail - stride : 0;
    at = std::fill_n(at, padding, Byte{0});
    at = std::copy_n(first.data(), stride, at);
    return static_cast<std::size_t>(at - reinterpret_cast<Byte*>(to));
}

} // namespace lsys
