// SPDX-License-Identifier: MIT
// Reads any bytes as a TGA file.
#include "runtime/base/targa_texels.h"

#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::uint64_t kMaxPixels = 1U << 18U;
    const auto read = lsys::read_targa_texels({reinterpret_cast<const char*>(data), size},
                                              kMaxPixels, 16U << 20U);
    if (!read || !*read) {
        return 0;
    }
    const lsys::PictureTexels& texels = read->value();
    if (texels.bytes.size() != std::uint64_t{texels.columns} * texels.rows * 4) {
        std::abort();
    }
    return 0;
}
