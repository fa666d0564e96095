// PNG (W3C, "Portable Network Graphics Specification", third edition, 2025): one IDAT of rows as
// their differences to the row above, which for small pictures of noise is nearly as small as the
// best choice for each row and much faster.
#include "runtime/meshing/texture.h"

#include <array>
#include <limits>
#include <string_view>
#include <zlib.h>

namespace lsys {

namespace {

constexpr char kDifferenceToRowAbove = 2;
constexpr int kLevel = 2; // what higher ones save is less than 5 %
constexpr char kColour = 2;
constexpr char kColourAndOpacity = 6;

void put_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes +=
            static_cast<char>(static_cast<std::uint8_t>(number >> static_cast<unsigned>(shift)));
    }
}

void put_chunk(std::string& bytes, std::string_view type, std::string_view data) {
    put_number(bytes, static_cast<std::uint32_t>(data.size()));
    const std::size_t checked = bytes.size();
    bytes += type;
    bytes += data;
    const auto* const begin = reinterpret_cast<const Bytef*>(bytes.data() + checked);
    put_number(bytes, static_cast<std::uint32_t>(
                          crc32(0, begin, static_cast<uInt>(bytes.size() - checked))));
}

/// The rows, each with its filter before it.
std::string filtered_rows(const Texture& texture, std::size_t channels) {
    std::string rows((channels * texture.width + 1) * texture.height, '\0');
    char* at = rows.data();
    for (std::uint32_t row = 0; row < texture.height; ++row) {
        *at++ = kDifferenceToRowAbove;
        const std::uint8_t* texel = &texture.texels[std::size_t{4} * texture.width * row];
        const std::size_t above = row == 0 ? 0 : std::size_t{4} * texture.width;
        for (std::uint32_t column = 0; column < texture.width; ++column, texel += 4) {
            for (std::size_t c = 0; c < channels; ++c) {
                const int before = row == 0 ? 0 : *(texel + c - above);
                *at++ = static_cast<char>(static_cast<std::uint8_t>(texel[c] - before));
            }
        }
    }
    return rows;
}

std::string compressed(const std::string& data) {
    uLongf size = compressBound(data.size());
    std::string bytes(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                 reinterpret_cast<const Bytef*>(data.data()), data.size(), kLevel);
    bytes.resize(status == Z_OK ? size : 0);
    return bytes;
}

} // namespace

std::string encode_png(const Texture& texture) {
    bool opaque = true;
    for (std::size_t i = 3; i < texture.texels.size(); i += 4) {
        opaque = opaque && texture.texels[i] == 255;
    }
    const std::string data = compressed(filtered_rows(texture, opaque ? 3 : 4));
    if (data.empty()) {
        return {};
    }
    std::string header;
    put_number(header, texture.width);
    put_number(header, texture.height);
    // Bits of a channel, kind, and the only ways there are to compress, filter and order rows.
    header += {8, opaque ? kColour : kColourAndOpacity, 0, 0, 0};
    std::string bytes("\x89PNG\r\n\x1A\n");
    put_chunk(bytes, "IHDR", header);
    put_chunk(bytes, "IDAT", data);
    put_chunk(bytes, "IEND", {});
    return bytes;
}

} // namespace lsys
