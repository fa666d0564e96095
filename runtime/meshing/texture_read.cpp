// SPDX-License-Identifier: MIT
#include "runtime/base/jpeg_texels.h"
#include "runtime/base/png_samples.h"
#include "runtime/base/sgi_texels.h"
#include "runtime/base/targa_texels.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// Name of a format that is not read and that the first bytes identify; empty for other files.
std::string_view other_format(std::string_view bytes) {
    struct Known {
        std::string_view begin;
        std::string_view name;
    };
    constexpr std::array<Known, 6> kKnown = {{{"GIF8", "GIF"},
                                              {"BM", "BMP"},
                                              {"RIFF", "WebP"},
                                              {"II*", "TIFF"},
                                              {"DDS ", "DDS"},
                                              {"\x52\xCC", "Utah RLE picture"}}};
    const auto found = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& known) {
        return bytes.starts_with(known.begin);
    });
    return found == kKnown.end() ? std::string_view() : found->name;
}

/// The texels of a JPEG, SGI or TGA picture; nullopt: the file is of no such format.
std::optional<Result<PictureTexels>> read_other_texels(std::string_view bytes,
                                                       std::uint64_t max_bytes) {
    if (is_jpeg(bytes)) {
        return read_jpeg_texels(bytes, kMaxTexels, max_bytes);
    }
    if (is_sgi(bytes)) {
        return read_sgi_texels(bytes, kMaxTexels, max_bytes);
    }
    return read_targa_texels(bytes, kMaxTexels, max_bytes);
}

} // namespace

Result<Texture> read_picture(std::string_view bytes, std::uint64_t max_bytes) {
    if (const std::string_view format = other_format(bytes); !format.empty()) {
        return Error{fmt::format("it is a {}; only PNG, JPEG, SGI and TGA are read", format)};
    }
    Texture texture;
    if (!bytes.starts_with("\x89PNG")) {
        std::optional<Result<PictureTexels>> read = read_other_texels(bytes, max_bytes);
        if (!read) {
            return Error{"it is no PNG, JPEG, SGI or TGA picture"};
        }
        if (!*read) {
            return read->error();
        }
        PictureTexels& texels = read->value();
        texture = {texels.columns, texels.rows, std::move(texels.bytes)};
    } else {
        Result<PngSamples> read =
            read_png_samples(bytes, {PngForm::Rgba, kMaxTexels, max_bytes, 0, "picture"});
        if (!read) {
            return read.error();
        }
        PngSamples& samples = read.value();
        texture = {samples.columns, samples.rows, std::move(samples.bytes)};
    }
    if (std::max(texture.width, texture.height) > kMaxTextureSide) {
        return Error{fmt::format("a picture of {} by {} pixels; the maximum is {} per side",
                                 texture.width, texture.height, kMaxTextureSide)};
    }
    return texture;
}

Texture normals_of(const Texture& picture, float bump) {
    const std::size_t count = picture.texels.size() / 4;
    std::array<std::uint64_t, 3> sums{};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            sums[c] += picture.texels[4 * i + c];
        }
    }
    const auto is_near = [&](std::size_t channel, std::uint64_t low, std::uint64_t high) {
        return sums[channel] >= low * count && sums[channel] <= high * count;
    };
    if (is_near(0, 96, 160) && is_near(1, 96, 160) && is_near(2, 192, 255)) {
        return picture;
    }
    constexpr float kHeight = 0.02F; // height of white above black, in widths of the picture
    // Height in texels per step of red + green + blue.
    const float scale = bump * kHeight * static_cast<float>(picture.width) / (3.0F * 255.0F);
    const auto height = [&](std::uint32_t x, std::uint32_t y) {
        const std::uint8_t* const texel =
            picture.texels.data() + std::size_t{4} * (std::size_t{y} * picture.width + x);
        return static_cast<float>(unsigned{texel[0]} + texel[1] + texel[2]);
    };
    const auto byte_of = [](float value) {
        return static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * value));
    };
    Texture normals{picture.width, picture.height, {}};
    normals.texels.resize(picture.texels.size());
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        const std::uint32_t above = (y == 0 ? picture.height : y) - 1;
        const std::uint32_t below = y + 1 == picture.height ? 0 : y + 1;
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const std::uint32_t left = (x == 0 ? picture.width : x) - 1;
            const std::uint32_t right = x + 1 == picture.width ? 0 : x + 1;
            const float rise_x = 0.5F * scale * (height(right, y) - height(left, y));
            const float rise_y = 0.5F * scale * (height(x, above) - height(x, below));
            const float length = std::sqrt(rise_x * rise_x + rise_y * rise_y + 1.0F);
            std::uint8_t* const to =
                normals.texels.data() + std::size_t{4} * (std::size_t{y} * picture.width + x);
            to[0] = byte_of(-rise_x / length);
            to[1] = byte_of(-rise_y / length);
            to[2] = byte_of(1.0F / length);
            to[3] = 255;
        }
    }
    return normals;
}

Texture with_opacity(Texture colour, const Texture& opacity) {
    const std::size_t channel = has_holes(opacity) ? 3 : 0;
    for (std::size_t i = 0; i < colour.texels.size(); i += 4) {
        colour.texels[i + 3] = opacity.texels[i + channel];
    }
    return colour;
}

bool has_holes(const Texture& texture) {
    for (std::size_t i = 3; i < texture.texels.size(); i += 4) {
        if (texture.texels[i] < 128) {
            return true;
        }
    }
    return false;
}

glm::vec3 mean_colour(const Texture& texture) {
    std::array<std::uint64_t, 768> counts{}; // count of each value of each channel
    std::uint64_t count = 0;
    for (std::size_t i = 0; i + 3 < texture.texels.size(); i += 4) {
        if (texture.texels[i + 3] >= 128) {
            ++count;
            for (std::size_t c = 0; c < 3; ++c) {
                ++counts[256 * c + texture.texels[i + c]];
            }
        }
    }
    glm::vec3 mean(1.0F);
    for (std::size_t c = 0; c < 3 && count != 0; ++c) {
        double sum = 0.0;
        for (std::size_t value = 0; value < 256; ++value) {
            sum += static_cast<double>(counts[256 * c + value]) *
                   static_cast<double>(linear_of_srgb(static_cast<float>(value) / 255.0F));
        }
        mean[static_cast<glm::length_t>(c)] = static_cast<float>(sum / static_cast<double>(count));
    }
    return mean;
}

} // namespace lsys
