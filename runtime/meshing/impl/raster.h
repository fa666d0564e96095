// SPDX-License-Identifier: MIT
// Rasteriser of triangles by pixel centres, for measuring and baking pictures of a mesh. It uses
// only additions, multiplications and divisions, so pictures are the same on every machine.
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

/// The depths of a picture; a larger depth is nearer to the eye.
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
/// pixel at which the triangle is nearest so far, with the weights of the corners; where it returns
/// false, the triangle has a hole.
template <typename Fragment>
void raster_triangle(const std::array<glm::vec3, 3>& corners,
                     DepthBuffer& buffer,
                     const Fragment& fragment) {
    const auto& [a, b, c] = corners;
    // Range of the pixels whose centres may lie inside. Most triangles of a plant seen as a whole
    // contain no centre.
    const auto first = [](float low, int size) {
        const int pixel =
            static_cast<int>(std::min(static_cast<float>(size), std::max(0.0F, low - 0.5F)));
        return pixel + (static_cast<float>(pixel) + 0.5F < low ? 1 : 0);
    };
    const auto last = [](float high, int size) {
        return high < 0.5F ? -1
                           : static_cast<int>(std::min(static_cast<float>(size - 1), high - 0.5F));
    };
    const int begin_x = first(std::min({a.x, b.x, c.x}), buffer.width);
    const int end_x = last(std::max({a.x, b.x, c.x}), buffer.width);
    if (begin_x > end_x) {
        return;
    }
    const int begin_y = first(std::min({a.y, b.y, c.y}), buffer.height);
    const int end_y = last(std::max({a.y, b.y, c.y}), buffer.height);
    if (begin_y > end_y) {
        return;
    }
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (!(std::abs(area) > 0.0F)) {
        return;
    }
    // Changes of the weights of a and b along both axes.
    const float a_along_x = (b.y - c.y) / area;
    const float a_along_y = (c.x - b.x) / area;
    const float b_along_x = (c.y - a.y) / area;
    const float b_along_y = (a.x - c.x) / area;
    const float c_along_x = -(a_along_x + b_along_x);
    constexpr int kWide = 2; // pixels; in narrower rows every pixel is tested
    for (int y = begin_y; y <= end_y; ++y) {
        const float py = static_cast<float>(y) + 0.5F;
        const float a_of_row = a_along_y * (py - b.y);
        const float b_of_row = b_along_y * (py - c.y);
        const std::size_t row =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(buffer.width);
        int from = begin_x;
        int to = end_x;
        if (end_x - begin_x >= kWide) {
            // Limits the row to about the range where all weights are positive, because thin
            // triangles fill only a small part of their box.
            float low = static_cast<float>(begin_x);
            float high = static_cast<float>(end_x);
            const auto cut = [&](float along, float zero) {
                low = along > 0.0F ? std::max(low, zero - 0.51F) : low;
                high = along < 0.0F ? std::min(high, zero - 0.49F) : high;
            };
            cut(a_along_x, b.x - a_of_row / a_along_x);
            cut(b_along_x, c.x - b_of_row / b_along_x);
            const float c_at_b = 1.0F - a_of_row - (b_of_row + b_along_x * (b.x - c.x));
            cut(c_along_x, b.x - c_at_b / c_along_x);
            if (!(low <= high)) {
                continue;
            }
            from = static_cast<int>(low);
            to = static_cast<int>(high);
        }
        for (int x = from; x <= to; ++x) {
            const float px = static_cast<float>(x) + 0.5F;
            const float u = a_of_row + a_along_x * (px - b.x);
            const float v = b_of_row + b_along_x * (px - c.x);
            const float w = 1.0F - u - v;
            if (u < 0.0F || v < 0.0F || w < 0.0F) {
                continue;
            }
            const float depth = u * a.z + v * b.z + w * c.z;
            const std::size_t at = row + static_cast<std::size_t>(x);
            if (depth > buffer.depths[at] && fragment(at, glm::vec3(u, v, w))) {
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
