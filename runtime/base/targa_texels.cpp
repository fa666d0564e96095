// SPDX-License-Identifier: MIT
#include "runtime/base/targa_texels.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lsys {

namespace {

constexpr std::size_t kHeaderBytes = 18;
constexpr std::size_t kChannels = 4; // of the texels

/// Kinds of pictures; run-length encoded ones have kEncoded added.
constexpr unsigned kMapped = 1;
constexpr unsigned kColours = 2;
constexpr unsigned kGrey = 3;
constexpr unsigned kEncoded = 8;

class TargaFile {
public:
    explicit TargaFile(std::string_view bytes) : bytes_(bytes) {}

    /// Returns false if pictures with this header cannot be read.
    bool read_header() {
        if (bytes_.size() < kHeaderBytes) {
            return false;
        }
        const unsigned has_map = byte(1);
        is_encoded_ = (byte(2) & kEncoded) != 0;
        kind_ = byte(2) & ~kEncoded;
        first_colour_ = half(3);
        colour_count_ = half(5);
        map_bits_ = byte(7);
        columns = half(12);
        rows = half(14);
        const unsigned bits = byte(16);
        pixel_bytes_ = (bits + 7U) / 8U;
        const unsigned description = byte(17);
        begins_at_top_ = (description & 0x20U) != 0;
        begins_at_right_ = (description & 0x10U) != 0;
        has_opacity_ = (description & 0x0FU) != 0;
        const bool is_known = kind_ == kMapped ? has_map == 1 && bits == 8 && is_colour(map_bits_)
                              : kind_ == kColours ? is_colour(bits)
                                                  : kind_ == kGrey && (bits == 8 || bits == 16);
        at_ = kHeaderBytes + byte(0);
        map_ = at_;
        at_ += std::size_t{has_map} * colour_count_ * map_bytes();
        return is_known && has_map <= 1 && description < 0x40U && columns != 0 && rows != 0;
    }

    /// Reads the pixels to RGBA texels by rows from the top. Returns false if the file is damaged.
    bool read_pixels(std::uint8_t* texels) {
        const std::uint64_t count = std::uint64_t{columns} * rows;
        if (!is_encoded_) {
            return read_run(0, count, false, texels);
        }
        for (std::uint64_t done = 0; done < count;) {
            if (at_ >= bytes_.size()) {
                return false;
            }
            // A packet has the count less 1 in 7 bits. With the bit 0x80 one pixel is repeated.
            const unsigned packet = byte(at_++);
            const std::uint64_t length =
                std::min<std::uint64_t>((packet & 0x7FU) + 1, count - done);
            if (!read_run(done, length, (packet & 0x80U) != 0, texels)) {
                return false;
            }
            done += length;
        }
        return true;
    }

    std::uint32_t columns = 0;
    std::uint32_t rows = 0;

private:
    static bool is_colour(unsigned bits) {
        return bits == 15 || bits == 16 || bits == 24 || bits == 32;
    }
    [[nodiscard]] std::size_t map_bytes() const { return (map_bits_ + 7U) / 8U; } // per colour

    [[nodiscard]] std::uint8_t byte(std::size_t at) const {
        return static_cast<std::uint8_t>(bytes_[at]);
    }
    [[nodiscard]] std::uint32_t half(std::size_t at) const { // the lower byte comes first
        return byte(at) | std::uint32_t{byte(at + 1)} << 8;
    }

    bool
    read_run(std::uint64_t first, std::uint64_t count, bool is_repeated, std::uint8_t* texels) {
        const std::uint64_t stored = is_repeated ? 1 : count;
        if (at_ > bytes_.size() || stored * pixel_bytes_ > bytes_.size() - at_) {
            return false;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t column = (first + i) % columns;
            const std::uint64_t row = (first + i) / columns;
            const std::uint64_t place = (begins_at_top_ ? row : rows - 1 - row) * columns +
                                        (begins_at_right_ ? columns - 1 - column : column);
            if (!read_pixel(at_ + (is_repeated ? 0 : i) * pixel_bytes_,
                            texels + place * kChannels)) {
                return false;
            }
        }
        at_ += stored * pixel_bytes_;
        return true;
    }

    bool read_pixel(std::size_t at, std::uint8_t* texel) {
        if (kind_ == kGrey) {
            std::fill_n(texel, 3, byte(at));
            texel[3] = pixel_bytes_ == 2 && has_opacity_ ? byte(at + 1) : 255;
            return true;
        }
        if (kind_ == kMapped) {
            const std::uint32_t index = byte(at);
            at = map_ + (index - first_colour_) * map_bytes();
            if (index < first_colour_ || index - first_colour_ >= colour_count_ ||
                at + map_bytes() > bytes_.size()) {
                return false;
            }
        }
        read_colour(at, kind_ == kMapped ? map_bytes() : pixel_bytes_, texel);
        return true;
    }

    /// Colours are stored as blue, green, red and perhaps opacity: in bytes, or in 5 bits each and
    /// 1 bit of opacity.
    void read_colour(std::size_t at, std::size_t size, std::uint8_t* texel) {
        if (size == 2) {
            constexpr std::uint32_t kMax = 31;
            const std::uint32_t colour = half(at);
            for (std::uint32_t c = 0; c < 3; ++c) {
                const std::uint32_t value = colour >> (10 - 5 * c) & kMax;
                texel[c] = static_cast<std::uint8_t>((value * 255 + kMax / 2) / kMax);
            }
            texel[3] = has_opacity_ && (colour & 0x8000U) == 0 ? 0 : 255;
            return;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            texel[c] = byte(at + 2 - c);
        }
        if (size == 4 && has_opacity_) {
            texel[3] = byte(at + 3);
        }
    }

    std::string_view bytes_;
    std::size_t at_ = 0;  // offset of the next pixel or packet
    std::size_t map_ = 0; // offset of the colour map
    unsigned kind_ = 0;
    unsigned map_bits_ = 0; // bits per colour of the map
    std::uint32_t first_colour_ = 0;
    std::uint32_t colour_count_ = 0;
    std::size_t pixel_bytes_ = 0;
    bool is_encoded_ = false;
    bool begins_at_top_ = false;
    bool begins_at_right_ = false;
    bool has_opacity_ = false;
};

} // namespace

std::optional<Result<PictureTexels>>
read_targa_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes) {
    TargaFile file(bytes);
    if (!file.read_header()) {
        return std::nullopt;
    }
    if (const Result<void> fits =
            check_picture_size(file.columns, file.rows, kChannels, max_pixels, max_bytes);
        !fits) {
        return fits.error();
    }
    Result<PictureTexels> read = white_texels(file.columns, file.rows, "a TGA picture");
    if (!read) {
        return read;
    }
    if (!file.read_pixels(read.value().bytes.data())) {
        return Error{"the TGA picture cannot be read: it is damaged or cut off"};
    }
    return read;
}

} // namespace lsys
