// SPDX-License-Identifier: MIT
#include "runtime/base/jpeg_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

// If a damaged file uses Huffman tables that it does not define, stb_image 2.27 takes them from
// uninitialised memory, and reads beyond them. Zeroed memory decodes to zeros.
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_JPEG
#define STBI_NO_SIMD
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#include <stb/stb_image.h>

namespace lsys {

namespace {

/// Bytes of a pixel while a progressive file is decoded: coefficients, samples, texels and a copy.
constexpr std::uint64_t kBytesPerPixel = 18;

std::size_t byte_at(std::string_view bytes, std::size_t at) {
    return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0;
}

/// Whether each Huffman table of a segment has at most 256 codes (T.81 B.2.4.2). stb_image 2.27
/// does not check this, and writes beyond its table. It reads counts behind a segment that is too
/// short, and so does this function. `bytes` begins with the length of the segment.
bool has_small_tables(std::string_view bytes) {
    constexpr std::size_t kCounts = 16;
    constexpr std::size_t kMaxCodes = 256;
    const std::size_t end = byte_at(bytes, 0) * 256 + byte_at(bytes, 1);
    for (std::size_t at = 2; at < end;) {
        std::size_t codes = 0;
        for (std::size_t i = 1; i <= kCounts; ++i) {
            codes += byte_at(bytes, at + i);
        }
        if (codes > kMaxCodes) {
            return false;
        }
        at += 1 + kCounts + codes;
    }
    return true;
}

/// has_small_tables() of all segments. Up to the first scan, segments are found as stb_image finds
/// them, which skips bytes between them; behind it, all bytes that look like a table are checked.
bool has_sound_tables(std::string_view bytes) {
    constexpr std::string_view kTables = "\xFF\xC4";
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && bytes.substr(at, 2) != "\xFF\xDA") {
        if (byte_at(bytes, at) != 0xFF || byte_at(bytes, at + 1) == 0xFF) {
            ++at;
            continue;
        }
        const std::string_view segment = bytes.substr(at + 2);
        if (bytes.substr(at, 2) == kTables && !has_small_tables(segment)) {
            return false;
        }
        at += 2 + std::max<std::size_t>(2, byte_at(segment, 0) * 256 + byte_at(segment, 1));
    }
    for (at = bytes.find(kTables, at); at != std::string_view::npos;
         at = bytes.find(kTables, at + 2)) {
        if (!has_small_tables(bytes.substr(at + 2))) {
            return false;
        }
    }
    return true;
}

} // namespace

bool is_jpeg(std::string_view bytes) {
    return bytes.starts_with("\xFF\xD8\xFF");
}

Result<PictureTexels>
read_jpeg_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes) {
    const auto damaged = [] {
        const char* const reason = stbi_failure_reason();
        return Error{
            fmt::format("the JPEG cannot be read: {}", reason == nullptr ? "damaged" : reason)};
    };
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return Error{"the JPEG is larger than 2 GiB"};
    }
    if (!has_sound_tables(bytes)) {
        return Error{"the JPEG cannot be read: a Huffman table has more than 256 codes"};
    }
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int columns = 0;
    int rows = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &columns, &rows, &channels) == 0) {
        return damaged();
    }
    if (const Result<void> fits = check_picture_size(static_cast<std::uint32_t>(columns),
                                                     static_cast<std::uint32_t>(rows),
                                                     kBytesPerPixel, max_pixels, max_bytes);
        !fits) {
        return fits.error();
    }
    constexpr int kChannels = 4;
    stbi_uc* const texels =
        stbi_load_from_memory(data, size, &columns, &rows, &channels, kChannels);
    if (texels == nullptr) {
        return damaged();
    }
    Result<PictureTexels> read = white_texels(static_cast<std::uint32_t>(columns),
                                              static_cast<std::uint32_t>(rows), "a JPEG");
    if (read) {
        std::copy_n(texels, read.value().bytes.size(), read.value().bytes.begin());
    }
    stbi_image_free(texels);
    return read;
}

} // namespace lsys
