#include "runtime/texture.h"

#include "runtime/meshing/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <png.h>

namespace lsys {

namespace {

constexpr std::uint32_t kSize = 256;

/// A number in [0, 1) for each point of a lattice; the mixing steps are those of Wellons'
/// "lowbias32" (https://nullprogram.com/blog/2018/07/31/).
float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    std::uint32_t h = x + 0x9E3779B9U * (y + 0x9E3779B9U * layer);
    h = (h ^ (h >> 16U)) * 0x7FEB352DU;
    h = (h ^ (h >> 15U)) * 0x846CA68BU;
    h ^= h >> 16U;
    return static_cast<float>(h >> 8U) / 16777216.0F;
}

float smooth(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}
float mix(float a, float b, float t) {
    return a + (b - a) * t;
}

/// What is above the next whole number below. Rounding down by the library takes most of the time.
float fraction(float x) {
    const auto whole = static_cast<float>(static_cast<std::int32_t>(x));
    return x - (whole > x ? whole - 1.0F : whole);
}

/// Value noise (Ebert et al., "Texturing and Modeling", 2003, chapter 2) of `columns` by `rows`
/// cells in the unit square, which it tiles.
float noise(float u, float v, std::uint32_t columns, std::uint32_t rows, std::uint32_t layer) {
    const float x = fraction(u) * static_cast<float>(columns);
    const float y = fraction(v) * static_cast<float>(rows);
    const auto left = static_cast<std::uint32_t>(x) % columns;
    const auto top = static_cast<std::uint32_t>(y) % rows;
    const std::uint32_t right = (left + 1) % columns;
    const std::uint32_t bottom = (top + 1) % rows;
    const float s = smooth(0.0F, 1.0F, fraction(x));
    const float t = smooth(0.0F, 1.0F, fraction(y));
    return mix(mix(lattice(left, top, layer), lattice(right, top, layer), s),
               mix(lattice(left, bottom, layer), lattice(right, bottom, layer), s), t);
}

/// Distance from `count` lines along v, 0 on them to 1 between them. A noise bends them, each other
/// than its neighbour.
float from_lines(float u, float v, std::uint32_t count, std::uint32_t rows, std::uint32_t layer) {
    const float bend = 1.5F * (noise(u, v, count, rows, layer) - 0.5F) +
                       0.25F * noise(u, v, 4 * count, 5 * rows, layer + 1);
    const float place = u * static_cast<float>(count) + bend;
    return std::abs(2.0F * fraction(place) - 1.0F);
}

/// Height of the bark, 0 in the fissures to 1 on the ridges. Two families of lines that cross make
/// long lozenges; cracks across them are shallow and rare.
float bark_height(float u, float v) {
    const float deep = smooth(0.0F, 0.55F, from_lines(u, v, 7, 3, 1));
    const float thin = smooth(0.0F, 0.5F, from_lines(u, v, 11, 4, 3));
    const float across = from_lines(v, u, 9, 7, 5);
    const float cracked = smooth(0.45F, 0.7F, noise(u, v, 9, 6, 7));
    const float ridges = deep * (0.35F + 0.65F * thin) *
                         (1.0F - 0.3F * cracked * (1.0F - smooth(0.0F, 0.2F, across)));
    const float grain = 0.6F * noise(u, v, 64, 16, 8) + 0.4F * noise(u, v, 128, 64, 9);
    return std::clamp(0.82F * ridges + 0.18F * grain, 0.0F, 1.0F);
}

std::uint8_t byte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

/// Of a texel, in the picture.
float middle(std::uint32_t texel) {
    return (static_cast<float>(texel) + 0.5F) / static_cast<float>(kSize);
}

/// Four channels for each texel, by column and row.
template <typename Texel>
Texture paint(const Texel& texel) {
    Texture texture{kSize, kSize, {}};
    texture.texels.reserve(std::size_t{4} * kSize * kSize);
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            const std::array<float, 4> rgba = texel(column, row);
            for (const float channel : rgba) {
                texture.texels.push_back(byte(channel));
            }
        }
    }
    return texture;
}

std::array<float, 4> bark_texel(std::uint32_t column, std::uint32_t row) {
    const float u = middle(column);
    const float v = middle(row);
    const float height = bark_height(u, v);
    const float spots = 0.9F + 0.1F * noise(u, v, 5, 5, 10);
    const float light = (0.42F + 0.58F * height) * spots;
    // Fissures are a little redder than ridges.
    const float warm = 0.06F * (1.0F - height);
    return {light + warm, light, light - warm, 1.0F};
}

/// Half the width of the leaf in the picture, 0 to 1: that of the mesh, its corners rounded, and a
/// margin, so that along most of its edge the mesh is what ends the leaf.
float leaf_half(float distance) {
    constexpr float kGreatest = 0.25F;
    constexpr float kMargin = 0.04F;
    constexpr int kSamples = 4;
    float sum = 0.0F;
    for (int i = -kSamples; i <= kSamples; ++i) {
        sum += leaf_half_width(
            std::clamp(distance + 0.05F * static_cast<float>(i) / kSamples, 0.0F, 1.0F));
    }
    return sum / (2 * kSamples + 1) / kGreatest + kMargin;
}

std::array<float, 4> leaf_texel(std::uint32_t column, std::uint32_t row) {
    const float u = middle(column);
    const float v = middle(row);
    const float half = leaf_half(1.0F - v);
    const float side = std::abs(2.0F * u - 1.0F);
    // One texel of slope around the outline, for filters.
    const float opacity = smooth(-1.5F, 1.5F, (half - side) * static_cast<float>(kSize) / 2.0F);
    const float midrib = 1.0F - smooth(0.012F, 0.03F + 0.03F * v, side);
    // Veins leave the midrib and lean towards v = 0; the first number is how many there are.
    const float along = 8.0F * (v + 0.45F * side) + 0.3F * noise(u, v, 6, 6, 11);
    const float from_vein = std::abs(fraction(along) - 0.5F);
    const float vein = (1.0F - smooth(0.04F, 0.16F, from_vein)) * (1.0F - 0.5F * side);
    const float blade = 0.68F + 0.10F * noise(u, v, 24, 24, 12) + 0.12F * from_vein;
    const float light = mix(blade, 1.0F, std::max(0.95F * midrib, 0.7F * vein));
    const float edge = 0.88F + 0.12F * smooth(0.0F, 0.2F, half - side);
    const float yellow = 0.12F * std::max(midrib, vein);
    return {light * edge, light * edge, (light - yellow) * edge, opacity};
}

} // namespace

bool has_texture(MaterialKind kind) {
    return kind == MaterialKind::Bark || kind == MaterialKind::Leaf;
}

Texture material_texture(MaterialKind kind) {
    switch (kind) {
    case MaterialKind::Bark:
        return paint(bark_texel);
    case MaterialKind::Leaf:
        return paint(leaf_texel);
    default:
        return {};
    }
}

Texture bark_normals() {
    constexpr float kSteepness = 5.0F; // in texels of height
    std::vector<float> heights(std::size_t{kSize} * kSize);
    const auto height = [&heights](std::uint32_t column, std::uint32_t row) -> float& {
        return heights[std::size_t{row % kSize} * kSize + column % kSize];
    };
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            height(column, row) = bark_height(middle(column), middle(row));
        }
    }
    return paint([&height](std::uint32_t column, std::uint32_t row) {
        const float x =
            kSteepness * (height(column + kSize - 1, row) - height(column + 1, row)) / 2.0F;
        const float y =
            kSteepness * (height(column, row + 1) - height(column, row + kSize - 1)) / 2.0F;
        const float length = std::sqrt(x * x + y * y + 1.0F);
        return std::array{0.5F + 0.5F * x / length, 0.5F + 0.5F * y / length, 0.5F + 0.5F / length,
                          1.0F};
    });
}

std::string encode_png(const Texture& texture) {
    bool opaque = true;
    for (std::size_t i = 3; i < texture.texels.size(); i += 4) {
        opaque = opaque && texture.texels[i] == 255;
    }
    std::vector<std::uint8_t> samples;
    const std::size_t channels = opaque ? 3 : 4;
    samples.reserve(texture.texels.size());
    for (std::size_t i = 0; i < texture.texels.size(); i += 4) {
        samples.insert(samples.end(), &texture.texels[i], &texture.texels[i] + channels);
    }

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = texture.width;
    image.height = texture.height;
    image.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    const int written =
        png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.data(), 0, nullptr);
    bytes.resize(written != 0 ? size : 0);
    return bytes;
}

} // namespace lsys
