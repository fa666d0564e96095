// SPDX-License-Identifier: MIT
#include "runtime/base/sgi_texels.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lsys {

namespace {

constexpr std::size_t kHeaderBytes = 512;
constexpr std::size_t kChannels = 4; // channels of a texel

class SgiFile {
public:
    explicit SgiFile(std::string_view bytes) : bytes_(bytes) {}

    /// Returns false if pictures with this header cannot be read.
    bool read_header() {
        if (bytes_.size() < kHeaderBytes) {
            return false;
        }
        is_encoded_ = byte(2) != 0;
        sample_bytes_ = byte(3);
        const std::uint32_t dimensions = half(4);
        columns = half(6);
        rows = dimensions < 2 ? 1 : half(8);
        channels = dimensions < 3 ? 1 : half(10);
        const std::uint32_t colour_map = word(104); // 0: values are colours, not indices
        return byte(2) <= 1 && (sample_bytes_ == 1 || sample_bytes_ == 2) && dimensions >= 1 &&
               dimensions <= 3 && columns != 0 && rows != 0 && channels >= 1 &&
               channels <= kChannels && colour_map == 0;
    }

    /// Reads a channel of row `row`, counted from the bottom, to every kChannels-th byte of `to`.
    /// Returns false if the file is damaged.
    bool read_row(std::uint32_t row, std::uint32_t channel, std::uint8_t* to) const {
        const std::size_t index = std::size_t{channel} * rows + row;
        if (!is_encoded_) {
            const std::size_t begin = kHeaderBytes + index * columns * sample_bytes_;
            if (begin + std::size_t{columns} * sample_bytes_ > bytes_.size()) {
                return false;
            }
            for (std::uint32_t x = 0; x < columns; ++x) {
                to[x * kChannels] = byte(begin + std::size_t{x} * sample_bytes_);
            }
            return true;
        }
        const std::size_t table_bytes = std::size_t{4} * rows * channels;
        if (kHeaderBytes + 2 * table_bytes > bytes_.size()) {
            return false;
        }
        const std::size_t begin = word(kHeaderBytes + 4 * index);
        const std::size_t size = word(kHeaderBytes + table_bytes + 4 * index);
        return begin <= bytes_.size() && size <= bytes_.size() - begin &&
               decode_row(begin, begin + size, to);
    }

    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    std::uint32_t channels = 0;

private:
    [[nodiscard]] std::uint8_t byte(std::size_t at) const {
        return static_cast<std::uint8_t>(bytes_[at]);
    }
    [[nodiscard]] std::uint32_t half(std::size_t at) const {
        return std::uint32_t{byte(at)} << 8 | byte(at + 1);
    }
    [[nodiscard]] std::uint32_t word(std::size_t at) const { return half(at) << 16 | half(at + 2); }

    /// A packet is as wide as a sample. Its lowest 7 bits are a count, 0 at the end of the row. If
    /// bit 0x80 is set, that number of samples follows, else one sample that is repeated.
    bool decode_row(std::size_t at, std::size_t end, std::uint8_t* to) const {
        std::uint32_t x = 0;
        while (x < columns) {
            if (at + sample_bytes_ > end) {
                return false;
            }
            const unsigned packet = byte(at + sample_bytes_ - 1); // its lowest byte
            at += sample_bytes_;
            const unsigned count = packet & 0x7FU;
            const bool is_run = (packet & 0x80U) == 0;
            const std::size_t samples = is_run ? 1 : count;
            if (count == 0 || count > columns - x || at + samples * sample_bytes_ > end) {
                return false;
            }
            for (unsigned i = 0; i < count; ++i) {
                to[x++ * kChannels] = byte(at + (is_run ? 0 : i) * sample_bytes_);
            }
            at += samples * sample_bytes_;
        }
        return true;
    }

    std::string_view bytes_;
    bool is_encoded_ = false;
    std::size_t sample_bytes_ = 1;
};

} // namespace

bool is_sgi(std::string_view bytes) {
    return bytes.starts_with("\x01\xDA");
}

Result<PictureTexels>
read_sgi_texels(std::string_view bytes, std::uint64_t max_pixels, std::uint64_t max_bytes) {
    SgiFile file(bytes);
    if (!file.read_header()) {
        return Error{"the SGI picture cannot be read: its header is of no picture in colours or "
                     "greys"};
    }
    if (const Result<void> fits =
            check_picture_size(file.columns, file.rows, kChannels, max_pixels, max_bytes);
        !fits) {
        return fits.error();
    }
    Result<PictureTexels> read = white_texels(file.columns, file.rows, "an SGI picture");
    if (!read) {
        return read;
    }
    // Channel of the file for each channel of a texel, by number of channels of the file - 1. One
    // channel: grey. Two: grey and opacity.
    constexpr std::array<std::array<std::uint32_t, kChannels>, kChannels> kSources{
        {{0, 0, 0, 4}, {0, 0, 0, 1}, {0, 1, 2, 4}, {0, 1, 2, 3}}}; // 4: opaque
    for (std::uint32_t row = 0; row < file.rows; ++row) {
        std::uint8_t* const to =
            read.value().bytes.data() + std::size_t{file.rows - 1 - row} * file.columns * kChannels;
        for (std::size_t c = 0; c < kChannels; ++c) {
            const std::uint32_t source = kSources[file.channels - 1][c];
            if (source < kChannels && !file.read_row(row, source, to + c)) {
                return Error{"the SGI picture cannot be read: it is damaged or cut off"};
            }
        }
    }
    return read;
}

} // namespace lsys
