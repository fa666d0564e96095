#include "runtime/meshing/impl/impostor.h"

#include "grammar/base/hash.h"
#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/impl/raster.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace lsys {

namespace {

constexpr int kMinTile = 16; // texels of a side of a picture
constexpr int kMaxTile = 128;
constexpr float kTexelsPerPixel = 1.3F; // at most, where an impostor is shown first
constexpr int kSide = 512;              // samples of a side of a picture
constexpr int kColumns = 2;             // of pictures in the atlas
constexpr int kOpaqueByte = 128;
constexpr float kHalfRoot3 = 0.8660254F;

struct Axes {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 towards;
};
const std::array<Axes, 4> kAxes{{
    {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}},
    {{0.5F, 0.0F, -kHalfRoot3}, {0.0F, 1.0F, 0.0F}, {kHalfRoot3, 0.0F, 0.5F}},
    {{-0.5F, 0.0F, -kHalfRoot3}, {0.0F, 1.0F, 0.0F}, {kHalfRoot3, 0.0F, -0.5F}},
    {{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}, {0.0F, 1.0F, 0.0F}},
}};

std::uint8_t unit_byte(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// Texels around the plant in a picture.
int margin_of(int tile) {
    return std::max(tile / 64, 1);
}

/// Fills unknown texels with the values of the nearest known ones.
template <typename Copy>
void dilate(int side, std::vector<std::uint8_t> known, const Copy& copy) {
    const auto tile = static_cast<std::size_t>(side);
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (known[i] != 0) {
            front.push_back(i);
        }
    }
    for (std::size_t next = 0; next < front.size(); ++next) {
        const std::size_t at = front[next];
        const std::size_t x = at % tile;
        const std::size_t y = at / tile;
        const std::array<std::pair<bool, std::size_t>, 4> beside{{{x > 0, at - 1},
                                                                  {x + 1 < tile, at + 1},
                                                                  {y > 0, at - tile},
                                                                  {y + 1 < tile, at + tile}}};
        for (const auto& [is_there, other] : beside) {
            if (is_there && known[other] == 0) {
                known[other] = 1;
                copy(at, other);
                front.push_back(other);
            }
        }
    }
}

/// The corners of the smallest octagon around the marked texels, counter-clockwise, in texels; empty
/// if there are none.
std::vector<glm::vec2> octagon(int side, const std::vector<std::uint8_t>& marked) {
    const auto columns = static_cast<std::size_t>(side);
    const auto tile = static_cast<float>(side);
    float left = tile;
    float right = 0.0F;
    float top = tile;
    float bottom = 0.0F;
    float low_sum = 2.0F * tile;
    float high_sum = 0.0F;
    float low_difference = tile;
    float high_difference = -tile;
    for (std::size_t i = 0; i < marked.size(); ++i) {
        if (marked[i] == 0) {
            continue;
        }
        const auto x = static_cast<float>(i % columns);
        const auto y = static_cast<float>(i / columns);
        left = std::min(left, x);
        right = std::max(right, x + 1.0F);
        top = std::min(top, y);
        bottom = std::max(bottom, y + 1.0F);
        low_sum = std::min(low_sum, x + y);
        high_sum = std::max(high_sum, x + y + 2.0F);
        low_difference = std::min(low_difference, x - y - 1.0F);
        high_difference = std::max(high_difference, x + 1.0F - y);
    }
    if (!(left < right)) {
        return {};
    }
    std::vector<glm::vec2> corners{{low_difference + bottom, bottom},
                                   {high_sum - bottom, bottom},
                                   {right, high_sum - right},
                                   {right, right - high_difference},
                                   {high_difference + top, top},
                                   {low_sum - top, top},
                                   {left, low_sum - left},
                                   {left, left - low_difference}};
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() > 1 && corners.front() == corners.back()) {
        corners.pop_back();
    }
    return corners;
}

} // namespace

ImpostorBaker::ImpostorBaker(const Mesh& mesh, float pixels) : tile_(kMinTile) {
    while (tile_ < kMaxTile && static_cast<float>(2 * tile_) <= kTexelsPerPixel * pixels) {
        tile_ *= 2;
    }
    LinearTextures textures;
    for (const Axes& axes : kAxes) {
        View& view = views_.emplace_back();
        view.right = axes.right;
        view.up = axes.up;
        view.towards = axes.towards;
        take(mesh, textures, view);
    }
}

void ImpostorBaker::take(const Mesh& mesh, LinearTextures& textures, View& view) const {
    const auto along = [&view](const glm::vec3& v) {
        return glm::vec3(glm::dot(v, view.right), glm::dot(v, view.up), glm::dot(v, view.towards));
    };
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(along(position));
    }
    // A flat plant has cards of some width and depth too.
    const glm::vec3 size = bounds.high - bounds.low;
    const auto tile = static_cast<float>(tile_);
    const float least = std::max({size.x, size.y, size.z, 1e-6F}) / tile;
    const glm::vec3 middle = 0.5F * (bounds.low + bounds.high);
    const glm::vec3 half =
        0.5F * glm::max(size, glm::vec3(least)) *
        glm::vec3(glm::vec2(tile / static_cast<float>(tile_ - 2 * margin_of(tile_))), 1.0F);
    view.low = middle - half;
    view.high = middle + half;

    DepthBuffer buffer(kSide, kSide);
    std::vector<glm::vec3> colours(buffer.depths.size());
    std::vector<glm::vec3> normals(buffer.depths.size());
    const glm::vec3 scale = glm::vec3(glm::vec2(kSide), 1.0F) / (2.0F * half);
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const Material& material = mesh.materials[part.material];
        const LinearTexture& texture = textures.of(material);
        const bool has_palette =
            mesh.colours.size() == mesh.positions.size() && material.picture == nullptr;
        for (std::uint64_t i = 0; i + 2 < part.index_count; i += 3) {
            const std::uint64_t first = part.first_index + i;
            const std::array<std::uint32_t, 3> corners{indices[first], indices[first + 1],
                                                       indices[first + 2]};
            std::array<glm::vec3, 3> places;
            std::array<glm::vec3, 3> tints;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 at = along(mesh.positions[corners[k]]);
                places[k] = glm::vec3((at.x - view.low.x) * scale.x, (view.high.y - at.y) * scale.y,
                                      (at.z - view.low.z) * scale.z);
                tints[k] = has_palette ? palette_colour(mesh.colours[corners[k]])
                                       : glm::vec3(material.colour);
            }
            raster_triangle(places, buffer, [&](std::size_t pixel, const glm::vec3& w) {
                glm::vec4 texel(1.0F);
                if (!texture.texels.empty()) {
                    texel = texture.at(w.x * mesh.texture_coordinates[corners[0]] +
                                       w.y * mesh.texture_coordinates[corners[1]] +
                                       w.z * mesh.texture_coordinates[corners[2]]);
                }
                if (material.cut_out && texel.a == 0.0F) {
                    return false;
                }
                colours[pixel] =
                    (w.x * tints[0] + w.y * tints[1] + w.z * tints[2]) * glm::vec3(texel);
                const glm::vec3 normal =
                    along(w.x * mesh.normals[corners[0]] + w.y * mesh.normals[corners[1]] +
                          w.z * mesh.normals[corners[2]]);
                normals[pixel] = normal.z < 0.0F ? -normal : normal;
                return true;
            });
        }
    }

    const auto columns = static_cast<std::size_t>(tile_);
    const std::size_t samples = kSide / columns; // of a texel, along each side
    view.coverage.resize(texels());
    view.colours.resize(texels());
    view.normals.resize(texels());
    view.depths.resize(texels());
    for (std::size_t texel = 0; texel < texels(); ++texel) {
        float count = 0.0F;
        for (std::size_t sample = 0; sample < samples * samples; ++sample) {
            const std::size_t x = texel % columns * samples + sample % samples;
            const std::size_t y = texel / columns * samples + sample / samples;
            const std::size_t pixel = y * kSide + x;
            if (buffer.depths[pixel] >= 0.0F) {
                count += 1.0F;
                view.colours[texel] += colours[pixel];
                view.normals[texel] += normals[pixel];
                view.depths[texel] += buffer.depths[pixel];
            }
        }
        view.coverage[texel] = count / static_cast<float>(samples * samples);
        if (count > 0.0F) {
            view.colours[texel] /= count;
            view.depths[texel] /= count;
        }
        const float length = glm::length(view.normals[texel]);
        view.normals[texel] =
            length > 0.0F ? view.normals[texel] / length : glm::vec3(0.0F, 0.0F, 1.0F);
    }
}

void ImpostorBaker::paint(const View& view,
                          std::size_t tile,
                          double cover,
                          const glm::vec3& tint,
                          Texture& colour,
                          Texture& relief,
                          std::vector<glm::vec2>& outline) const {
    std::vector<std::uint32_t> order; // of opaque texels
    double area = 0.0;
    glm::dvec3 wanted(0.0); // sum of colours
    for (std::uint32_t i = 0; i < texels(); ++i) {
        if (view.coverage[i] > 0.0F) {
            order.push_back(i);
            area += static_cast<double>(view.coverage[i]);
            wanted += static_cast<double>(view.coverage[i]) * glm::dvec3(view.colours[i]);
        }
    }
    // Of texels that are covered as much, any.
    std::sort(order.begin(), order.end(), [&view](std::uint32_t a, std::uint32_t b) {
        return std::make_tuple(-view.coverage[a], lowbias32(a), a) <
               std::make_tuple(-view.coverage[b], lowbias32(b), b);
    });
    order.resize(
        std::min(order.size(), static_cast<std::size_t>(std::max(cover * area + 0.5, 0.0))));
    const float least = order.empty() ? 1.0F : view.coverage[order.back()];
    std::vector<std::uint8_t> opaque(texels(), 0);
    glm::dvec3 sum(0.0);
    for (const std::uint32_t i : order) {
        opaque[i] = 1;
        sum += glm::dvec3(view.colours[i]);
    }
    glm::vec3 factor = tint;
    for (int c = 0; c < 3; ++c) {
        if (sum[c] > 0.0 && area > 0.0) {
            factor[c] *=
                static_cast<float>(wanted[c] / area / (sum[c] / static_cast<double>(order.size())));
        }
    }
    const std::size_t width = colour.width;
    const auto columns = static_cast<std::size_t>(tile_);
    const auto place = [&](std::size_t i) {
        const std::size_t x = tile % kColumns * columns + i % columns;
        const std::size_t y = tile / kColumns * columns + i / columns;
        return 4 * (y * width + x);
    };
    for (std::size_t i = 0; i < texels(); ++i) {
        const std::size_t to = place(i);
        for (int c = 0; c < 3; ++c) {
            colour.texels[to + static_cast<std::size_t>(c)] =
                nearest_srgb_byte(view.colours[i][c] * factor[c]);
            relief.texels[to + static_cast<std::size_t>(c)] =
                unit_byte(0.5F + 0.5F * view.normals[i][c]);
        }
        // Half opaque at the least coverage of an opaque texel, so that smaller pictures of a
        // viewer cover as much.
        const std::uint8_t alpha = unit_byte(0.5F * view.coverage[i] / least);
        colour.texels[to + 3] = opaque[i] != 0 ? std::max<std::uint8_t>(alpha, kOpaqueByte)
                                               : std::min<std::uint8_t>(alpha, kOpaqueByte - 1);
        relief.texels[to + 3] = std::max<std::uint8_t>(unit_byte(view.depths[i]), 1);
    }
    outline = octagon(tile_, opaque);
    dilate(tile_, opaque, [&](std::size_t from, std::size_t to) {
        std::copy_n(colour.texels.begin() + static_cast<std::ptrdiff_t>(place(from)), 3,
                    colour.texels.begin() + static_cast<std::ptrdiff_t>(place(to)));
        std::copy_n(relief.texels.begin() + static_cast<std::ptrdiff_t>(place(from)), 4,
                    relief.texels.begin() + static_cast<std::ptrdiff_t>(place(to)));
    });
}

Mesh ImpostorBaker::make(double cover, const glm::vec3& tint) const {
    const std::size_t rows = (views_.size() + kColumns - 1) / kColumns;
    Texture colour;
    colour.width = static_cast<std::uint32_t>(kColumns * tile_);
    colour.height = static_cast<std::uint32_t>(rows) * static_cast<std::uint32_t>(tile_);
    colour.texels.resize(std::size_t{4} * colour.width * colour.height);
    Texture relief = colour;
    Mesh mesh;
    LargeVector<std::uint32_t> indices;
    for (std::size_t tile = 0; tile < views_.size(); ++tile) {
        const View& view = views_[tile];
        std::vector<glm::vec2> outline;
        paint(view, tile, cover, tint, colour, relief, outline);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const float depth = 0.5F * (view.low.z + view.high.z);
        for (const glm::vec2& corner : outline) {
            const glm::vec2 part = corner / static_cast<float>(tile_);
            const float x = view.low.x + part.x * (view.high.x - view.low.x);
            const float y = view.high.y - part.y * (view.high.y - view.low.y);
            mesh.positions.push_back(x * view.right + y * view.up + depth * view.towards);
            mesh.normals.push_back(view.towards);
            mesh.tangents.push_back(glm::vec4(view.right, 1.0F));
            mesh.texture_coordinates.push_back(
                (part + glm::vec2(tile % kColumns, tile / kColumns)) / glm::vec2(kColumns, rows));
        }
        for (std::uint32_t k = 2; k < outline.size(); ++k) {
            for (const std::uint32_t corner : {0U, k - 1, k}) {
                indices.push_back(first + corner);
            }
        }
    }
    mesh.parts.push_back({.material = 0, .first_index = 0, .index_count = indices.size()});
    mesh.indices = TriangleList(std::move(indices));
    Material& material = mesh.materials.emplace_back();
    material.name = "impostor";
    material.kind = MaterialKind::Leaf; // pictures do not repeat
    material.two_sided = true;
    material.cut_out = true;
    material.textured = true;
    material.picture = std::make_shared<const Texture>(std::move(colour));
    material.relief = std::make_shared<const Texture>(std::move(relief));
    return mesh;
}

} // namespace lsys
