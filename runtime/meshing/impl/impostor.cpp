// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/impostor.h"

#include "grammar/base/hash.h"
#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/impl/raster.h"
#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace lsys {

namespace {

constexpr int kMinTile = 16; // texels of a side of a picture
constexpr int kMaxTile = 128;
constexpr float kMaxTexelsPerPixel = 1.3F; // at the size on screen where the impostor first appears
constexpr int kMinSamples = 256;           // samples of a side of a picture
constexpr int kMaxSamples = 512;
constexpr int kSamplesPerTexel = 8; // along each side, within kMinSamples and kMaxSamples
constexpr int kOpaqueByte = 128;
constexpr float kLookDown = 0.5F; // tangent of the angle at which leaves of upright cards are seen
constexpr float kTurned = 0.6F;   // factor of the sideways part of normals of upright cards
constexpr float kHalfRoot3 = 0.8660254F;
constexpr float kEmptyDepth = -std::numeric_limits<float>::infinity(); // depth of empty samples

struct Axes {
    glm::vec3 right;
    glm::vec3 up;
    glm::vec3 towards_eye;
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

/// Samples of a side of a picture.
int samples_of(int tile) {
    return std::clamp(kSamplesPerTexel * tile, kMinSamples, kMaxSamples);
}

/// Width in texels of the margin around the plant in a picture.
int margin_of(int tile) {
    return std::max(tile / 64, 1);
}

/// The normal of a card at a point where the plant has the normal `normal`. Both have Z towards the
/// eye.
glm::vec3 normal_on_card(glm::vec3 normal, bool is_upright) {
    // Take the normal of the side of the leaf that is visible. Viewers of tiles and forests look
    // down on upright cards, and see the upper sides of level leaves.
    if (normal.z + (is_upright ? kLookDown * normal.y : 0.0F) < 0.0F) {
        normal = -normal;
    }
    normal.z = std::max(normal.z, 0.0F);
    if (is_upright) {
        // Cards face three directions, so that the normals of three cards spread about the vertical
        // nearly as much as those of a plant, even if each card had one normal. So each card keeps
        // only a part of the spread of its own normals.
        const glm::vec2 level(kTurned * normal.x, normal.z);
        const float before = std::sqrt(normal.x * normal.x + normal.z * normal.z);
        const float after = glm::length(level);
        if (after > 0.0F) {
            normal.x = level.x * before / after;
            normal.z = level.y * before / after;
        }
    }
    const float length = glm::length(normal);
    return length > 0.0F ? normal / length : glm::vec3(0.0F, 0.0F, 1.0F);
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

/// The columns from the first to the last marked texel of a row.
struct Span {
    float left = 0.0F;
    float right = 0.0F;

    [[nodiscard]] bool is_empty() const { return !(left < right); }
    void add(const Span& other) {
        if (!other.is_empty()) {
            left = is_empty() ? other.left : std::min(left, other.left);
            right = is_empty() ? other.right : std::max(right, other.right);
        }
    }
};

/// A strip of `count` trapezoids around the marked texels, in texels. The result has a left and a
/// right corner alternately, from top to bottom. Empty if no texel is marked.
std::vector<glm::vec2>
strip_around(int tile_side, const std::vector<std::uint8_t>& marked, std::size_t count) {
    const auto columns = static_cast<std::size_t>(tile_side);
    std::vector<Span> rows(columns);
    for (std::size_t i = 0; i < marked.size(); ++i) {
        if (marked[i] != 0) {
            const auto x = static_cast<float>(i % columns);
            rows[i / columns].add({x, x + 1.0F});
        }
    }
    std::size_t top = 0;
    std::size_t bottom = columns;
    while (top < bottom && rows[top].is_empty()) {
        ++top;
    }
    while (bottom > top && rows[bottom - 1].is_empty()) {
        --bottom;
    }
    if (top == bottom) {
        return {};
    }
    // Both corners between two trapezoids are as far out as either trapezoid needs.
    const float height = static_cast<float>(bottom - top) / static_cast<float>(count);
    const auto row_at = [&](std::size_t k) {
        return static_cast<float>(top) + static_cast<float>(k) * height;
    };
    std::vector<Span> ends(count + 1);
    for (std::size_t k = 0; k < count; ++k) {
        const auto end = std::min(static_cast<std::size_t>(row_at(k + 1) + 0.999F), bottom);
        Span all;
        for (auto row = static_cast<std::size_t>(row_at(k)); row < end; ++row) {
            all.add(rows[row]);
        }
        ends[k].add(all);
        ends[k + 1].add(all);
    }
    std::vector<glm::vec2> corners;
    for (std::size_t k = 0; k <= count; ++k) {
        // Between two empty trapezoids the two corners are one texel apart, centred below the two
        // corners before them.
        const Span before = k > 0 ? Span{corners[2 * k - 2].x, corners[2 * k - 1].x} : Span{};
        const float middle = 0.5F * (before.left + before.right);
        const Span own = ends[k].is_empty() ? Span{middle - 0.5F, middle + 0.5F} : ends[k];
        corners.emplace_back(own.left, row_at(k));
        corners.emplace_back(own.right, row_at(k));
    }
    return corners;
}

/// The number of trapezoids of each card: `all` in total, distributed as evenly as possible. If
/// there are fewer trapezoids than cards, the cards with most opaque texels get one each. `areas`:
/// number of opaque texels of each card.
std::vector<std::size_t> trapezoids_of(const std::vector<std::size_t>& areas, std::size_t all) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (areas[i] > 0) {
            order.push_back(i);
        }
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(areas[b], a) < std::tie(areas[a], b);
    });
    std::vector<std::size_t> counts(areas.size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k) {
        counts[order[k]] = all / order.size() + (k < all % order.size() ? 1 : 0);
    }
    return counts;
}

} // namespace

/// The point of a triangle that a sample shows.
struct ImpostorBaker::Fragment {
    std::uint64_t first_index = 0; // index in Mesh::indices of its first corner
    std::uint32_t part = 0;        // number of its mesh part
    float u = 0.0F;                // weights of its first two corners
    float v = 0.0F;
};

/// Buffers that are reused for all pictures.
struct ImpostorBaker::Canvas {
    DepthBuffer buffer;
    std::vector<Fragment> fragments; // valid for samples with a depth
    std::vector<glm::vec3> along;    // positions of the vertices along the axes of the view
    LargeVector<std::uint32_t> indices;
    LinearTextures textures;

    explicit Canvas(int side) : buffer(side, side), fragments(buffer.depths.size()) {}
};

ImpostorBaker::ImpostorBaker(const Mesh& mesh, float pixels, std::uint64_t triangles)
    : tile_side_(kMinTile), slabs_(triangles < kMinSlabTriangles ? 1 : 3),
      columns_(slabs_ == 1 ? 2 : 4), triangles_(triangles) {
    while (tile_side_ < kMaxTile &&
           static_cast<float>(2 * tile_side_) <= kMaxTexelsPerPixel * pixels) {
        tile_side_ *= 2;
    }
    Canvas canvas(samples_of(tile_side_));
    canvas.indices = mesh.indices.expanded();
    for (const Axes& axes : kAxes) {
        canvas.along.clear();
        for (const glm::vec3& at : mesh.positions) {
            canvas.along.emplace_back(glm::dot(at, axes.right), glm::dot(at, axes.up),
                                      glm::dot(at, axes.towards_eye));
        }
        for (int slab = 0; slab < slabs_; ++slab) {
            View& view = views_.emplace_back();
            view.right = axes.right;
            view.up = axes.up;
            view.towards_eye = axes.towards_eye;
            render_slab(mesh, slab, canvas, view);
        }
    }
}

void ImpostorBaker::render_slab(const Mesh& mesh, int slab, Canvas& canvas, View& view) const {
    Bounds bounds;
    for (const glm::vec3& at : canvas.along) {
        bounds.add(at);
    }
    // A flat plant has cards with some width and depth, too.
    const glm::vec3 size = bounds.high - bounds.low;
    const auto tile_side = static_cast<float>(tile_side_);
    const float min_size = std::max({size.x, size.y, size.z, 1e-6F}) / tile_side;
    const glm::vec3 middle = 0.5F * (bounds.low + bounds.high);
    const glm::vec3 half =
        0.5F * glm::max(size, glm::vec3(min_size)) *
        glm::vec3(glm::vec2(tile_side / static_cast<float>(tile_side_ - 2 * margin_of(tile_side_))),
                  1.0F);
    view.low = middle - half;
    view.high = middle + half;
    const float thickness = 2.0F * half.z / static_cast<float>(slabs_);
    view.low.z += static_cast<float>(slab) * thickness;
    view.high.z = view.low.z + thickness;
    // Whether the range of depths from `low` to `high` overlaps the slab. The first and the last
    // slab also include depths that rounding puts outside of all slabs.
    const auto is_here = [&](float high, float low) {
        return (high >= 0.0F || slab == 0) && (low < 1.0F || slab + 1 == slabs_);
    };

    DepthBuffer& buffer = canvas.buffer;
    std::fill(buffer.depths.begin(), buffer.depths.end(), kEmptyDepth);
    const auto side = static_cast<float>(buffer.width);
    const glm::vec3 scale =
        glm::vec3(side, side, 1.0F) / glm::vec3(2.0F * glm::vec2(half), thickness);
    const auto place = [&](std::uint32_t vertex) {
        const glm::vec3& at = canvas.along[vertex];
        return glm::vec3((at.x - view.low.x) * scale.x, (view.high.y - at.y) * scale.y,
                         (at.z - view.low.z) * scale.z);
    };
    const auto corners_of = [&](std::uint64_t first) {
        return std::array<std::uint32_t, 3>{canvas.indices[first], canvas.indices[first + 1],
                                            canvas.indices[first + 2]};
    };
    const auto coordinates = [&](const std::array<std::uint32_t, 3>& corners, const glm::vec3& w) {
        return w.x * mesh.texture_coordinates[corners[0]] +
               w.y * mesh.texture_coordinates[corners[1]] +
               w.z * mesh.texture_coordinates[corners[2]];
    };
    for (std::uint32_t number = 0; number < mesh.parts.size(); ++number) {
        const MeshPart& part = mesh.parts[number];
        const Material& material = mesh.materials[part.material];
        const LinearTexture& texture = canvas.textures.texture_of(material);
        const bool has_holes = material.cut_out && !texture.texels.empty();
        for (std::uint64_t i = 0; i + 2 < part.index_count; i += 3) {
            const std::uint64_t first = part.first_index + i;
            const std::array<std::uint32_t, 3> corners = corners_of(first);
            const std::array<glm::vec3, 3> at{place(corners[0]), place(corners[1]),
                                              place(corners[2])};
            if (!is_here(std::max({at[0].z, at[1].z, at[2].z}),
                         std::min({at[0].z, at[1].z, at[2].z}))) {
                continue;
            }
            raster_triangle(at, buffer, [&](std::size_t pixel, const glm::vec3& w) {
                const float depth = w.x * at[0].z + w.y * at[1].z + w.z * at[2].z;
                if (!is_here(depth, depth) ||
                    (has_holes && !texture.is_opaque(coordinates(corners, w)))) {
                    return false;
                }
                canvas.fragments[pixel] = {first, number, w.x, w.y};
                return true;
            });
        }
    }

    const auto columns = static_cast<std::size_t>(tile_side_);
    const auto width = static_cast<std::size_t>(buffer.width);
    const std::size_t samples = width / columns; // samples of a texel, along each side
    view.coverage.resize(texels());
    view.colours.resize(texels());
    view.normals.resize(texels());
    view.depths.resize(texels());
    std::vector<std::size_t> covered; // samples of a texel
    for (std::size_t texel = 0; texel < texels(); ++texel) {
        covered.clear();
        for (std::size_t sample = 0; sample < samples * samples; ++sample) {
            const std::size_t x = texel % columns * samples + sample % samples;
            const std::size_t y = texel / columns * samples + sample / samples;
            if (buffer.depths[y * width + x] != kEmptyDepth) {
                covered.push_back(y * width + x);
                view.depths[texel] += buffer.depths[y * width + x];
            }
        }
        if (covered.empty()) {
            continue;
        }
        const auto count = static_cast<float>(covered.size());
        view.coverage[texel] = count / static_cast<float>(samples * samples);
        view.depths[texel] /= count;
        const Fragment& fragment =
            canvas
                .fragments[covered[lowbias32(static_cast<std::uint32_t>(texel)) % covered.size()]];
        const std::array<std::uint32_t, 3> corners = corners_of(fragment.first_index);
        const glm::vec3 w(fragment.u, fragment.v, 1.0F - fragment.u - fragment.v);
        const Material& material = mesh.materials[mesh.parts[fragment.part].material];
        const LinearTexture& texture = canvas.textures.texture_of(material);
        glm::vec3 colour(material.colour);
        if (mesh.colours.size() == mesh.positions.size() && material.picture == nullptr) {
            colour = w.x * plain_colour(mesh.looks.get(), mesh.colours[corners[0]]) +
                     w.y * plain_colour(mesh.looks.get(), mesh.colours[corners[1]]) +
                     w.z * plain_colour(mesh.looks.get(), mesh.colours[corners[2]]);
        }
        if (!texture.texels.empty()) {
            colour *= glm::vec3(texture.at(coordinates(corners, w)));
        }
        view.colours[texel] = colour;
        const glm::vec3 normal = w.x * mesh.normals[corners[0]] + w.y * mesh.normals[corners[1]] +
                                 w.z * mesh.normals[corners[2]];
        view.normals[texel] =
            normal_on_card({glm::dot(normal, view.right), glm::dot(normal, view.up),
                            glm::dot(normal, view.towards_eye)},
                           view.towards_eye.y == 0.0F);
    }
}

std::vector<std::uint8_t> ImpostorBaker::paint(const View& view,
                                               std::size_t tile,
                                               double cover,
                                               const glm::vec3& tint,
                                               Texture& colour,
                                               Texture& normal_map) const {
    std::vector<std::uint32_t> order; // numbers of texels, in the order in which they become opaque
    double area = 0.0;
    glm::dvec3 wanted(0.0); // sum of colours
    for (std::uint32_t i = 0; i < texels(); ++i) {
        if (view.coverage[i] > 0.0F) {
            order.push_back(i);
            area += static_cast<double>(view.coverage[i]);
            wanted += static_cast<double>(view.coverage[i]) * glm::dvec3(view.colours[i]);
        }
    }
    // Texels with equal coverage are ordered by a hash, so that no region is preferred.
    std::sort(order.begin(), order.end(), [&view](std::uint32_t a, std::uint32_t b) {
        return std::make_tuple(-view.coverage[a], lowbias32(a), a) <
               std::make_tuple(-view.coverage[b], lowbias32(b), b);
    });
    order.resize(
        std::min(order.size(), static_cast<std::size_t>(std::max(cover * area + 0.5, 0.0))));
    const float min_coverage = order.empty() ? 1.0F : view.coverage[order.back()];
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
    const auto columns = static_cast<std::size_t>(tile_side_);
    const auto place = [&](std::size_t i) {
        const std::size_t x = tile % columns_ * columns + i % columns;
        const std::size_t y = tile / columns_ * columns + i / columns;
        return 4 * (y * width + x);
    };
    for (std::size_t i = 0; i < texels(); ++i) {
        const std::size_t to = place(i);
        for (int c = 0; c < 3; ++c) {
            colour.texels[to + static_cast<std::size_t>(c)] =
                nearest_srgb_byte(view.colours[i][c] * factor[c]);
            normal_map.texels[to + static_cast<std::size_t>(c)] =
                unit_byte(0.5F + 0.5F * view.normals[i][c]);
        }
        // Opacity is proportional to coverage, and a half where the coverage of opaque texels is
        // least, so that the mipmaps of a viewer cover as much as the picture.
        const std::uint8_t alpha = unit_byte(0.5F * view.coverage[i] / min_coverage);
        colour.texels[to + 3] = opaque[i] != 0 ? std::max<std::uint8_t>(alpha, kOpaqueByte)
                                               : std::min<std::uint8_t>(alpha, kOpaqueByte - 1);
        normal_map.texels[to + 3] = std::max<std::uint8_t>(unit_byte(view.depths[i]), 1);
    }
    dilate(tile_side_, opaque, [&](std::size_t from, std::size_t to) {
        std::copy_n(colour.texels.begin() + static_cast<std::ptrdiff_t>(place(from)), 3,
                    colour.texels.begin() + static_cast<std::ptrdiff_t>(place(to)));
        std::copy_n(normal_map.texels.begin() + static_cast<std::ptrdiff_t>(place(from)), 4,
                    normal_map.texels.begin() + static_cast<std::ptrdiff_t>(place(to)));
    });
    return opaque;
}

Mesh ImpostorBaker::make(double cover, const glm::vec3& tint) const {
    const std::size_t rows = views_.size() / columns_;
    Texture colour;
    colour.width = static_cast<std::uint32_t>(columns_) * static_cast<std::uint32_t>(tile_side_);
    colour.height = static_cast<std::uint32_t>(rows) * static_cast<std::uint32_t>(tile_side_);
    colour.texels.resize(std::size_t{4} * colour.width * colour.height);
    Texture normal_map = colour;
    Mesh mesh;
    LargeVector<std::uint32_t> indices;
    std::vector<std::vector<std::uint8_t>> opaque;
    std::vector<std::size_t> areas;
    for (std::size_t tile = 0; tile < views_.size(); ++tile) {
        opaque.push_back(paint(views_[tile], tile, cover, tint, colour, normal_map));
        areas.push_back(static_cast<std::size_t>(
            std::count(opaque.back().begin(), opaque.back().end(), std::uint8_t{1})));
    }
    const std::vector<std::size_t> trapezoids = trapezoids_of(areas, triangles_ / 4);
    for (std::size_t tile = 0; tile < views_.size(); ++tile) {
        if (trapezoids[tile] == 0) {
            continue;
        }
        const View& view = views_[tile];
        const float depth = 0.5F * (view.low.z + view.high.z);
        const std::vector<glm::vec2> corners =
            strip_around(tile_side_, opaque[tile], trapezoids[tile]);
        for (const float side : {1.0F, -1.0F}) { // front and back
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2& corner : corners) {
                const glm::vec2 part = corner / static_cast<float>(tile_side_);
                const float x = view.low.x + part.x * (view.high.x - view.low.x);
                const float y = view.high.y - part.y * (view.high.y - view.low.y);
                mesh.positions.push_back(x * view.right + y * view.up + depth * view.towards_eye);
                mesh.normals.push_back(side * view.towards_eye);
                mesh.tangents.push_back(glm::vec4(side * view.right, 1.0F));
                mesh.texture_coordinates.push_back(
                    (part + glm::vec2(tile % columns_, tile / columns_)) /
                    glm::vec2(columns_, rows));
            }
            // Corners 0 to 3 of a trapezoid: left and right above, left and right below.
            const std::array<std::uint32_t, 6> order =
                side > 0.0F ? std::array<std::uint32_t, 6>{0, 2, 1, 1, 2, 3}
                            : std::array<std::uint32_t, 6>{0, 1, 2, 1, 3, 2};
            for (std::uint32_t k = 0; k < trapezoids[tile]; ++k) {
                for (const std::uint32_t corner : order) {
                    indices.push_back(first + 2 * k + corner);
                }
            }
        }
    }
    mesh.parts.push_back({.material = 0, .first_index = 0, .index_count = indices.size()});
    mesh.indices = TriangleList(std::move(indices));
    Material& material = mesh.materials.emplace_back();
    material.name = "impostor";
    material.kind = MaterialKind::Leaf; // pictures do not repeat
    material.two_sided = false;
    material.cut_out = true;
    material.textured = true;
    material.picture = std::make_shared<const Texture>(std::move(colour));
    material.normal_map = std::make_shared<const Texture>(std::move(normal_map));
    return mesh;
}

} // namespace lsys
