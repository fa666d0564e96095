// SPDX-License-Identifier: MIT
#include "runtime/base/jpeg_texels.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxPixels = 1U << 20U;
constexpr std::uint64_t kMaxBytes = 1U << 26U;

std::string brown_jpeg() {
    std::ifstream file(LSYS_SOURCE_DIR "/tests/ui/materials/parts/brown.jpg", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The file without its Huffman tables, the segments with the marker FF C4.
std::string without_tables(std::string jpeg) {
    for (std::size_t at = jpeg.find("\xFF\xC4"); at != std::string::npos;
         at = jpeg.find("\xFF\xC4")) {
        const auto byte = [&](std::size_t offset) {
            return std::size_t{static_cast<unsigned char>(jpeg[at + offset])};
        };
        jpeg.erase(at, 2 + byte(2) * 256 + byte(3));
    }
    return jpeg;
}

/// Fills freed memory, which the next allocations of these sizes get, with a byte.
void fill_freed_memory(int byte) {
    std::vector<void*> blocks;
    for (std::size_t size = 1U << 10U; size <= (1U << 16U); size += 1U << 10U) {
        void* const block = std::malloc(size);
        REQUIRE(block != nullptr);
        std::memset(block, byte, size);
        blocks.push_back(block);
    }
    for (void* const block : blocks) {
        std::free(block);
    }
}

} // namespace

TEST_CASE("a JPEG is read as opaque texels") {
    const Result<PictureTexels> read = read_jpeg_texels(brown_jpeg(), kMaxPixels, kMaxBytes);
    REQUIRE(read);
    CHECK(read.value().bytes.size() == std::size_t{read.value().columns} * read.value().rows * 4);
    CHECK(read.value().bytes[3] == 255);
}

TEST_CASE("a JPEG without its Huffman tables does not depend on what memory held before") {
    const std::string jpeg = without_tables(brown_jpeg());
    REQUIRE(jpeg.size() < brown_jpeg().size());
    std::vector<std::string> outcomes;
    for (const int byte : {0x00, 0x01, 0x5A, 0xFF}) {
        fill_freed_memory(byte);
        const Result<PictureTexels> read = read_jpeg_texels(jpeg, kMaxPixels, kMaxBytes);
        outcomes.push_back(read ? std::string(read.value().bytes.begin(), read.value().bytes.end())
                                : read.error().message);
    }
    for (const std::string& outcome : outcomes) {
        CHECK(outcome == outcomes.front());
    }
}

TEST_CASE("a JPEG with a Huffman table of more than 256 codes is refused") {
    std::string jpeg = brown_jpeg();
    const std::size_t table = jpeg.find("\xFF\xC4");
    REQUIRE(table != std::string::npos);
    // The counts of codes of each length begin behind marker, length and number of the table.
    jpeg.replace(table + 5, 4, "\xFF\xFF\xFF\xFF");
    const Result<PictureTexels> read = read_jpeg_texels(jpeg, kMaxPixels, kMaxBytes);
    REQUIRE_FALSE(read);
    CHECK(read.error().message ==
          "the JPEG cannot be read: a Huffman table has more than 256 codes");
}

} // namespace lsys
