// SPDX-License-Identifier: MIT
// GreyMap: a picture of one channel, such as heights of a terrain or densities of a forest. Row 0
// lies at the lowest Z and column 0 at the lowest X, so the picture shows the ground from above.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lsys {

/// Max pixels of a map: 2^27, about 11,585 by 11,585.
inline constexpr std::uint64_t kMaxMapPixels = std::uint64_t{1} << 27;

struct GreyMap {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    LargeVector<std::uint16_t> values; // by rows; 0 is black, 65535 white

    [[nodiscard]] std::uint16_t at(std::uint32_t column, std::uint32_t row) const {
        return values[std::size_t{row} * columns + column];
    }
};

/// Adds the size and the pixels of a map to a hash (grammar/base/hash.h).
[[nodiscard]] std::uint64_t combine_map(std::uint64_t state, const GreyMap& map);

/// Reads a PNG file of 1 to 16 bits per sample; an 8-bit sample b becomes 257 * b. Gamma and
/// opacity are ignored. Errors: a pixel with a colour, a damaged file, more than kMaxMapPixels,
/// more than `max_bytes` of memory needed in addition to `bytes`.
[[nodiscard]] Result<GreyMap> read_grey_png(std::string_view bytes, std::uint64_t max_bytes);

/// Reads raw samples of 16 bits, little-endian, by rows, without a header. Errors: `bytes` does not
/// hold exactly `columns` by `rows` samples, more than kMaxMapPixels, or the map needs more than
/// `max_bytes`.
[[nodiscard]] Result<GreyMap> read_grey_raw(std::string_view bytes,
                                            std::uint32_t columns,
                                            std::uint32_t rows,
                                            std::uint64_t max_bytes);

} // namespace lsys
