// SPDX-License-Identifier: MIT
#include "tests/viewer/picture.h"

#include "tests/support/lsc_run.h"

#include <algorithm>
#include <cstdlib>
#include <png.h>
#include <stdexcept>

namespace lsys::tests {

Picture decode_picture(const std::string& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) {
        throw std::runtime_error(std::string("no PNG: ") + image.message);
    }
    image.format = PNG_FORMAT_RGBA;
    Picture picture{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    if (png_image_finish_read(&image, nullptr, picture.texels.data(), 0, nullptr) == 0) {
        throw std::runtime_error(std::string("no PNG: ") + image.message);
    }
    return picture;
}

Picture read_picture(const std::string& path) {
    return decode_picture(read_text(path));
}

PictureDifference difference_of(const Picture& a, const Picture& b) {
    constexpr int kMaxEqual = 32;
    double sum = 0.0;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.texels.size(); i += 4) {
        int max_difference = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const int difference = std::abs(int{a.texels[i + c]} - int{b.texels[i + c]});
            sum += difference;
            max_difference = std::max(max_difference, difference);
        }
        differing += max_difference > kMaxEqual ? 1U : 0U;
    }
    const auto count = static_cast<double>(a.texels.size());
    return {sum / count, 4.0 * static_cast<double>(differing) / count};
}

} // namespace lsys::tests
