// SPDX-License-Identifier: MIT
// Reads any bytes as a PNG file, as the picture of a material and as a map. The checksums of its
// chunks are corrected first, so that the bytes inside are reached.
#include "runtime/base/grey_map.h"
#include "runtime/meshing/texture.h"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr std::uint64_t kMaxBytes = 8U << 20U;
constexpr std::size_t kSignatureBytes = 8;

/// CRC-32 as in PNG (W3C, "Portable Network Graphics Specification", annex D), bit by bit.
std::uint32_t crc_of(std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    return crc ^ 0xFFFFFFFFU;
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        number = number << 8U | static_cast<std::uint8_t>(bytes[at + i]);
    }
    return number;
}

/// Writes the checksum of each chunk: length, kind, data, checksum.
void seal_chunks(std::string& bytes) {
    std::size_t at = kSignatureBytes;
    while (at + 12 <= bytes.size()) {
        const std::size_t length = number_at(bytes, at);
        if (length > bytes.size() - at - 12) {
            return;
        }
        const std::uint32_t crc = crc_of(std::string_view(bytes).substr(at + 4, length + 4));
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[at + 8 + length + i] = static_cast<char>(crc >> (24U - 8U * i));
        }
        at += 12 + length;
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(data, data + size);
    seal_chunks(bytes);
    const lsys::Result<lsys::Texture> picture = lsys::read_picture(bytes, kMaxBytes);
    if (picture) {
        const lsys::Texture& texture = picture.value();
        if (texture.texels.size() != std::uint64_t{texture.width} * texture.height * 4 ||
            texture.texels.size() > kMaxBytes) {
            std::abort();
        }
        static_cast<void>(lsys::mean_colour(texture));
    }
    const lsys::Result<lsys::GreyMap> map = lsys::read_grey_png(bytes, kMaxBytes);
    if (map && map.value().values.size() != std::uint64_t{map.value().columns} * map.value().rows) {
        std::abort();
    }
    return 0;
}
