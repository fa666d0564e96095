// SPDX-License-Identifier: MIT
#include "runtime/base/random.h"
#include "runtime/export/impl/vertex_codec.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <meshoptimizer.h>
#include <span>
#include <vector>

using namespace lsys;

namespace {

/// Items whose bytes differ from those of the previous item by at most `range` in the first half, and
/// not at all in some groups.
std::vector<std::byte> codec_items(std::size_t count, std::uint32_t stride, std::uint32_t range) {
    std::vector<std::byte> items(count * stride);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const PhiloxBlock words = draw_block(5, stride, i, range);
        const std::uint32_t before =
            i < stride ? 0U : std::to_integer<std::uint32_t>(items[i - stride]);
        const bool is_constant = (i / stride / 16) % 4 == 3;
        const bool is_outlier = words[1] % 9 == 0;
        const std::uint32_t change =
            is_constant ? 0U : words[0] % (is_outlier ? 256U : range) - range / 2;
        items[i] = static_cast<std::byte>(before + change);
    }
    return items;
}

} // namespace

TEST_CASE("vertices are encoded to the bytes of meshoptimizer") {
    meshopt_encodeVertexVersion(0);
    for (const std::uint32_t stride : {4U, 8U, 12U, 16U, 64U, 256U}) {
        for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 250U, 256U, 257U, 1000U}) {
            for (const std::uint32_t range : {1U, 2U, 4U, 9U, 40U, 256U}) {
                CAPTURE(stride, count, range);
                const std::vector<std::byte> items = codec_items(count, stride, range);
                std::vector<unsigned char> expected(meshopt_encodeVertexBufferBound(count, stride));
                expected.resize(meshopt_encodeVertexBuffer(expected.data(), expected.size(),
                                                           items.data(), count, stride));
                std::vector<std::byte> encoded(max_encoded_bytes(count, stride));
                encoded.resize(encode_items(items, stride, encoded.data()));
                const auto bytes = std::as_bytes(std::span(expected));
                CHECK(std::vector<std::byte>(bytes.begin(), bytes.end()) == encoded);
            }
        }
    }
}
