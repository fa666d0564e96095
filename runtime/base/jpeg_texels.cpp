// SPDX-License-Identifier: MIT
#include "runtime/base/jpeg_texels.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <limits>

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

} // namespace

bool is_jpeg(std::string_view bytes) {
    return bytes.starts_with("\xFF\xD8\xFF");
}

Result<JpegTexels>
read_jpeg_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes) {
    const auto damaged = [] {
        const char* const reason = stbi_failure_reason();
        return Error{
            fmt::format("the JPEG cannot be read: {}", reason == nullptr ? "damaged" : reason)};
    };
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return Error{"the JPEG is larger than 2 GiB"};
    }
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int columns = 0;
    int rows = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &columns, &rows, &channels) == 0) {
        return damaged();
    }
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
    if (pixels > max_pixels) {
        return Error{
            fmt::format("a picture of {} by {} pixels; the most is {}", columns, rows, max_pixels)};
    }
    if (pixels * kBytesPerPixel > max_bytes) {
        return memory_error(fmt::format("a picture of {} by {} pixels ({})", columns, rows,
                                        byte_size_text(pixels * kBytesPerPixel)),
                            max_bytes);
    }
    constexpr int kChannels = 4;
    stbi_uc* const texels =
        stbi_load_from_memory(data, size, &columns, &rows, &channels, kChannels);
    if (texels == nullptr) {
        return damaged();
    }
    JpegTexels read{static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows), {}};
    const bool fits = catch_out_of_memory(
        [&] {
            read.bytes.assign(texels, texels + pixels * kChannels);
            return true;
        },
        [] { return false; });
    stbi_image_free(texels);
    if (!fits) {
        return Error{"there is no memory to read a JPEG"};
    }
    return read;
}

} // namespace lsys
