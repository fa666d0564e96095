// SPDX-License-Identifier: MIT
#include "runtime/meshing/texture.h"

#include "grammar/base/hash.h"
#include "runtime/base/png_samples.h"
#include "runtime/meshing/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

constexpr std::uint32_t kSize = 256; // texels of a side of a computed texture

/// Pseudo-random number in [0, 1) of a lattice point.
float lattice(std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    constexpr std::uint32_t kRow = 0x9E3779B9;
    return unit_float(lowbias32(x + kRow * (y + kRow * layer)));
}

/// 0 up to `low`, 1 from `high` on, a smooth step between them.
float smooth(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}
float mix(float a, float b, float t) {
    return a + (b - a) * t;
}

/// Fractional part of a number, without std::floor, which would take most of the time.
float fraction(float x) {
    const auto whole = static_cast<float>(static_cast<std::int32_t>(x));
    return x - (whole > x ? whole - 1.0F : whole);
}

/// Position of a texel in the picture, 0 to 1.
float texel_centre(std::uint32_t texel) {
    return (static_cast<float>(texel) + 0.5F) / static_cast<float>(kSize);
}

/// Position of a texel between two points of a repeating lattice of `cells`.
struct LatticePosition {
    std::uint32_t low = 0;
    std::uint32_t high = 0;
    float share = 0.0F; // weight of `high`, 0 to 1
};
LatticePosition lattice_position(std::uint32_t texel, std::uint32_t cells) {
    const float x = texel_centre(texel) * static_cast<float>(cells);
    const auto low = static_cast<std::uint32_t>(x) % cells;
    return {low, (low + 1) % cells, smooth(0.0F, 1.0F, fraction(x))};
}

/// Value noise (Ebert et al., "Texturing and Modeling", 2003, chapter 2) of `columns` by `rows`
/// cells at the middles of all texels; the picture can be tiled.
class Noise {
public:
    Noise(std::uint32_t columns, std::uint32_t rows, std::uint32_t layer) {
        std::vector<float> points(columns);
        std::vector<float> lines(std::size_t{rows} * kSize); // lattice rows, at each texel column
        for (std::uint32_t line = 0; line < rows; ++line) {
            for (std::uint32_t i = 0; i < columns; ++i) {
                points[i] = lattice(i, line, layer);
            }
            for (std::uint32_t column = 0; column < kSize; ++column) {
                const LatticePosition at = lattice_position(column, columns);
                lines[std::size_t{line} * kSize + column] =
                    mix(points[at.low], points[at.high], at.share);
            }
        }
        for (std::uint32_t row = 0; row < kSize; ++row) {
            const LatticePosition at = lattice_position(row, rows);
            const float* const low = &lines[std::size_t{at.low} * kSize];
            const float* const high = &lines[std::size_t{at.high} * kSize];
            for (std::uint32_t column = 0; column < kSize; ++column) {
                values_[std::size_t{row} * kSize + column] =
                    mix(low[column], high[column], at.share);
            }
        }
    }
    [[nodiscard]] float operator()(std::uint32_t column, std::uint32_t row) const {
        return values_[std::size_t{row} * kSize + column];
    }

private:
    std::vector<float> values_ = std::vector<float>(std::size_t{kSize} * kSize);
};

/// Distance from `count` lines along v, 0 on them to 1 between them. Noise bends each line
/// differently.
class Lines {
public:
    Lines(std::uint32_t count, std::uint32_t rows, std::uint32_t layer)
        : count_(static_cast<float>(count)), wide_(count, rows, layer),
          narrow_(4 * count, 5 * rows, layer + 1) {}
    [[nodiscard]] float operator()(std::uint32_t column, std::uint32_t row) const {
        const float bend = 1.5F * (wide_(column, row) - 0.5F) + 0.25F * narrow_(column, row);
        return std::abs(2.0F * fraction(texel_centre(column) * count_ + bend) - 1.0F);
    }

private:
    float count_; // number of lines
    Noise wide_;
    Noise narrow_;
};

/// Bark: two families of crossing lines form long lozenges; cracks across them are shallow and
/// rare.
class Bark {
public:
    /// Height of the bark, 0 in the fissures to 1 on the ridges.
    [[nodiscard]] float height(std::uint32_t column, std::uint32_t row) const {
        const float deep = smooth(0.0F, 0.55F, deep_(column, row));
        const float thin = smooth(0.0F, 0.5F, thin_(column, row));
        const float across = across_(row, column);
        const float cracked = smooth(0.45F, 0.7F, cracks_(column, row));
        const float ridges = deep * (0.35F + 0.65F * thin) *
                             (1.0F - 0.3F * cracked * (1.0F - smooth(0.0F, 0.2F, across)));
        const float grain = 0.6F * grain_(column, row) + 0.4F * fine_grain_(column, row);
        return std::clamp(0.82F * ridges + 0.18F * grain, 0.0F, 1.0F);
    }

private:
    Lines deep_{7, 3, 1};   // deep fissures
    Lines thin_{11, 4, 3};  // shallow fissures
    Lines across_{9, 7, 5}; // cracks across the fissures
    Noise cracks_{9, 6, 7}; // places that have cracks
    Noise grain_{64, 16, 8};
    Noise fine_grain_{128, 64, 9};
};

std::uint8_t byte(float value) {
    // Rounds by truncating twice the value, without a library call for each texel.
    const auto twice = static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * 510.0F);
    return static_cast<std::uint8_t>((twice + 1) / 2);
}

/// A texture of texel(column, row), which returns four channels from 0 to 1.
template <typename Texel>
Texture paint(const Texel& texel) {
    Texture texture{kSize, kSize, {}};
    texture.texels.resize(std::size_t{4} * kSize * kSize);
    std::uint8_t* at = texture.texels.data();
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            const std::array<float, 4> rgba = texel(column, row);
            for (const float channel : rgba) {
                *at++ = byte(channel);
            }
        }
    }
    return texture;
}

Texture paint_bark() {
    const Bark bark;
    const Noise spots(5, 5, 10);
    return paint([&](std::uint32_t column, std::uint32_t row) {
        const float height = bark.height(column, row);
        const float light = (0.42F + 0.58F * height) * (0.9F + 0.1F * spots(column, row));
        // Fissures are a little redder than ridges.
        const float warm = 0.06F * (1.0F - height);
        return std::array{light + warm, light, light - warm, 1.0F};
    });
}

/// Half the width of the leaf in the picture, 0 to 1: the outline of the mesh with rounded corners
/// and a margin, so that in most places the mesh, not the opacity, bounds the leaf.
float leaf_half(float distance) {
    constexpr float kMax = 0.25F;
    constexpr float kMargin = 0.04F;
    constexpr int kSamples = 4;
    float sum = 0.0F;
    for (int i = -kSamples; i <= kSamples; ++i) {
        sum += leaf_half_width(
            std::clamp(distance + 0.05F * static_cast<float>(i) / kSamples, 0.0F, 1.0F));
    }
    return sum / (2 * kSamples + 1) / kMax + kMargin;
}

Texture paint_leaf() {
    const Noise bends(6, 6, 11);
    const Noise cells(24, 24, 12);
    std::array<float, kSize> halves{};
    for (std::uint32_t row = 0; row < kSize; ++row) {
        halves[row] = leaf_half(1.0F - texel_centre(row));
    }
    return paint([&](std::uint32_t column, std::uint32_t row) {
        const float v = texel_centre(row);
        const float half = halves[row];
        const float side = std::abs(2.0F * texel_centre(column) - 1.0F);
        // Opacity falls over three texels across the outline, for texture filters.
        const float opacity = smooth(-1.5F, 1.5F, (half - side) * static_cast<float>(kSize) / 2.0F);
        const float midrib = 1.0F - smooth(0.012F, 0.03F + 0.03F * v, side);
        // Eight veins on each side leave the midrib and lean towards v = 0.
        const float along = 8.0F * (v + 0.45F * side) + 0.3F * bends(column, row);
        const float from_vein = std::abs(fraction(along) - 0.5F);
        const float vein = (1.0F - smooth(0.04F, 0.16F, from_vein)) * (1.0F - 0.5F * side);
        const float blade = 0.68F + 0.10F * cells(column, row) + 0.12F * from_vein;
        const float light = mix(blade, 1.0F, std::max(0.95F * midrib, 0.7F * vein));
        const float edge = 0.88F + 0.12F * smooth(0.0F, 0.2F, half - side);
        const float yellow = 0.12F * std::max(midrib, vein);
        return std::array{light * edge, light * edge, (light - yellow) * edge, opacity};
    });
}

} // namespace

bool has_texture(MaterialKind kind) {
    return kind == MaterialKind::Bark || kind == MaterialKind::Leaf;
}

Texture material_texture(MaterialKind kind) {
    switch (kind) {
    case MaterialKind::Bark:
        return paint_bark();
    case MaterialKind::Leaf:
        return paint_leaf();
    default:
        return {};
    }
}

Texture bark_normals() {
    constexpr float kSteepness = 5.0F; // height of ridges above fissures, in texels
    std::vector<float> heights(std::size_t{kSize} * kSize);
    const auto height = [&heights](std::uint32_t column, std::uint32_t row) -> float& {
        return heights[std::size_t{row % kSize} * kSize + column % kSize];
    };
    const Bark bark;
    for (std::uint32_t row = 0; row < kSize; ++row) {
        for (std::uint32_t column = 0; column < kSize; ++column) {
            height(column, row) = bark.height(column, row);
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
    return write_png(texture.width, texture.height, texture.texels);
}

} // namespace lsys
