// Rasteriser of triangles by pixel centres, for what is decided or baked from pictures of a mesh:
// only additions, multiplications and divisions, so that every machine draws the same.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lsys {

/// The depths of a picture; larger is nearer.
struct DepthBuffer {
    int width = 0;
    int height = 0;
    std::vector<float> depths;

    DepthBuffer(int columns, int rows)
        : width(columns), height(rows),
          depths(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                 -std::numeric_limits<float>::infinity()) {}
};

/// Draws a triangle with corners in pixels and depth. fragment(pixel, weights) is called for each
/// pixel at which it is nearest so far, with the weights of the corners; where it returns false,
/// the triangle has a hole.
template <typename Fragment>
void raster_triangle(const std::array<glm::vec3, 3>& corners,
                     DepthBuffer& buffer,
                     const Fragment& fragment) {
    const auto& [a, b, c] = corners;
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 0.0F)) {
        return;
    }
    const auto pixel = [](float at, int size) {
        return static_cast<int>(std::clamp(at, 0.0F, static_cast<float>(size - 1)));
    };
    const int end_x = pixel(std::max({a.x, b.x, c.x}), buffer.width);
    const int end_y = pixel(std::max({a.y, b.y, c.y}), buffer.height);
    for (int y = pixel(std::min({a.y, b.y, c.y}), buffer.height); y <= end_y; ++y) {
        for (int x = pixel(std::min({a.x, b.x, c.x}), buffer.width); x <= end_x; ++x) {
            const float px = static_cast<float>(x) + 0.5F;
            const float py = static_cast<float>(y) + 0.5F;
            const float u = ((c.x - b.x) * (py - b.y) - (c.y - b.y) * (px - b.x)) / area;
            const float v = ((a.x - c.x) * (py - c.y) - (a.y - c.y) * (px - c.x)) / area;
            const float w = 1.0F - u - v;
            const float depth = u * a.z + v * b.z + w * c.z;
            const std::size_t at =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(buffer.width) +
                static_cast<std::size_t>(x);
            if (u >= 0.0F && v >= 0.0F && w >= 0.0F && depth > buffer.depths[at] &&
                fragment(at, glm::vec3(u, v, w))) {
                buffer.depths[at] = depth;
            }
        }
    }
}

/// The number of the texel of a repeating picture at texture coordinates.
inline std::size_t texel_number(float u, float v, std::uint32_t width, std::uint32_t height) {
    const auto index = [](float value, std::uint32_t size) {
        const float part = value - std::floor(value);
        return std::min(static_cast<std::uint32_t>(part * static_cast<float>(size)), size - 1);
    };
    return std::size_t{index(v, height)} * width + index(u, width);
}

} // namespace lsys
