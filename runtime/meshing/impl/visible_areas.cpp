// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/visible_areas.h"

#include "runtime/meshing/impl/raster.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

/// Pixels per side of the trial views, from which the size of all other views is computed.
constexpr int kTrialSize = 96;
constexpr int kMinSize = 80;  // min pixels per side of the other views
constexpr int kMaxSize = 256; // max pixels per side of the other views
constexpr double kTargetPixels =
    2500.0; // wanted mean number of pixels that the plant covers per view
constexpr std::size_t kTrialViews = 4;
constexpr float kCosine15 = 0.9659258F; // of 15 degrees
constexpr float kSine15 = 0.2588190F;
constexpr float kDiagonal = 0.7071068F;
/// Cosine and sine of the turns about +Y, and of the elevations of the eye above the horizon. With
/// these turns no card of an impostor is seen edge-on.
constexpr std::array<std::array<float, 2>, 12> kTurns{{{kCosine15, kSine15},
                                                       {kDiagonal, kDiagonal},
                                                       {kSine15, kCosine15},
                                                       {-kSine15, kCosine15},
                                                       {-kDiagonal, kDiagonal},
                                                       {-kCosine15, kSine15},
                                                       {-kCosine15, -kSine15},
                                                       {-kDiagonal, -kDiagonal},
                                                       {-kSine15, -kCosine15},
                                                       {kSine15, -kCosine15},
                                                       {kDiagonal, -kDiagonal},
                                                       {kCosine15, -kSine15}}};
constexpr std::array<std::array<float, 2>, 2> kTilts{{{1.0F, 0.0F}, {0.8F, 0.6F}}};

constexpr std::uint32_t kRowBits = 0xFFFF; // mask of the row in a cell number, see View::cell()
constexpr std::size_t kViews = kTurns.size() * kTilts.size();
/// The step of the views of measure_third() is odd, so that level views and views from above
/// alternate.
constexpr std::size_t kViewStep = 3;

/// A part of a mesh, prepared for drawing.
struct Surface {
    MeshPart part;
    const LinearTexture* texture = nullptr; // null: none
    glm::vec3 colour{};
    bool is_wood = false;
    bool has_holes = false;
};

/// A mesh, prepared for drawing in all views.
struct DrawnMesh {
    const Mesh& mesh;
    LargeVector<std::uint32_t> indices;
    std::vector<Surface> surfaces;

    DrawnMesh(const Mesh& drawn, bool is_wood, LinearTextures& textures)
        : mesh(drawn), indices(drawn.indices.expanded()) {
        for (const MeshPart& part : drawn.parts) {
            const Material& material = drawn.materials[part.material];
            Surface& surface = surfaces.emplace_back();
            surface.part = part;
            surface.colour = glm::vec3(material.colour);
            surface.is_wood = is_wood;
            const LinearTexture& texture = textures.texture_of(material);
            if (!texture.texels.empty() && !drawn.texture_coordinates.empty()) {
                surface.texture = &texture;
                surface.has_holes = material.cut_out;
            }
        }
    }
};

/// One view: the nearest surface at each pixel.
class View {
public:
    /// `offset`: shift of the plant in the view, in pixels.
    View(const Bounds& frame,
         const std::array<float, 2>& turn,
         const std::array<float, 2>& tilt,
         const glm::vec2& offset,
         int size)
        : middle_(0.5F * (frame.low + frame.high)), cosine_(turn[0]), sine_(turn[1]),
          tilt_cosine_(tilt[0]), tilt_sine_(tilt[1]), depth_(size, size),
          pixels_(depth_.depths.size()) {
        const glm::vec3 half = frame.high - middle_;
        const float across = std::sqrt(half.x * half.x + half.z * half.z);
        reach_ = std::max({tilt_cosine_ * half.y + tilt_sine_ * across, across,
                           std::numeric_limits<float>::min()});
        scale_ = 0.5F * static_cast<float>(size - 1) / reach_;
        offset_ = glm::vec3(offset, 0.0F);
    }

    void draw(const DrawnMesh& drawn) {
        places_.clear();
        cells_.clear();
        for (const glm::vec3& position : drawn.mesh.positions) {
            places_.push_back(place(position));
            cells_.push_back(cell(places_.back()));
        }
        for (const Surface& surface : drawn.surfaces) {
            const std::uint64_t end = surface.part.first_index + surface.part.index_count;
            for (std::uint64_t i = surface.part.first_index; i + 2 < end; i += 3) {
                const std::array<std::uint32_t, 3> corners{drawn.indices[i], drawn.indices[i + 1],
                                                           drawn.indices[i + 2]};
                // Skips triangles that lie between two neighbouring columns or rows of pixel
                // centres, as most triangles of a large plant do: they cover no centre.
                const std::uint32_t spread = (cells_[corners[0]] ^ cells_[corners[1]]) |
                                             (cells_[corners[0]] ^ cells_[corners[2]]);
                if ((spread & kRowBits) != 0 && (spread & ~kRowBits) != 0) {
                    draw(drawn, corners, surface);
                }
            }
        }
    }

    [[nodiscard]] VisibleAreas areas() const {
        VisibleAreas areas;
        for (const Pixel& pixel : pixels_) {
            if (pixel.surface == nullptr) {
                continue;
            }
            (pixel.surface->is_wood ? areas.wood : areas.foliage) += 1.0;
            const glm::vec3 texel = pixel.surface->texture == nullptr
                                        ? glm::vec3(1.0F)
                                        : glm::vec3(pixel.surface->texture->at(pixel.coordinates));
            areas.colour += glm::dvec3(pixel.surface->colour * texel);
        }
        return areas;
    }

private:
    struct Pixel {
        const Surface* surface = nullptr;
        glm::vec2 coordinates{}; // texture coordinates
    };

    [[nodiscard]] glm::vec3 place(const glm::vec3& position) const {
        const glm::vec3 p = position - middle_;
        const float near = cosine_ * p.z - sine_ * p.x;
        return offset_ + scale_ * glm::vec3(cosine_ * p.x + sine_ * p.z + reach_,
                                            tilt_cosine_ * p.y - tilt_sine_ * near + reach_,
                                            tilt_cosine_ * near + tilt_sine_ * p.y);
    }
    /// Number of the square between four pixel centres, composed of its column and its row.
    [[nodiscard]] static std::uint32_t cell(const glm::vec3& place) {
        const auto number = [](float at) {
            return static_cast<std::uint32_t>(std::clamp(at + 0.5F, 0.0F, 1024.0F));
        };
        return number(place.x) << 16U | number(place.y);
    }
    void draw(const DrawnMesh& drawn,
              const std::array<std::uint32_t, 3>& corners,
              const Surface& surface) {
        const std::array<glm::vec3, 3> places{places_[corners[0]], places_[corners[1]],
                                              places_[corners[2]]};
        raster_triangle(places, depth_, [&](std::size_t pixel, const glm::vec3& weights) {
            glm::vec2 coordinates(0.0F);
            if (surface.texture != nullptr) {
                const LargeVector<glm::vec2>& all = drawn.mesh.texture_coordinates;
                coordinates = weights.x * all[corners[0]] + weights.y * all[corners[1]] +
                              weights.z * all[corners[2]];
                if (surface.has_holes && !surface.texture->is_opaque(coordinates)) {
                    return false;
                }
            }
            pixels_[pixel] = {&surface, coordinates};
            return true;
        });
    }

    glm::vec3 middle_; // middle of the frame, m
    float cosine_;     // of the turn about +Y
    float sine_;
    float tilt_cosine_; // of the elevation of the eye
    float tilt_sine_;
    float reach_ = 1.0F; // half the side of the view, m
    float scale_ = 1.0F; // pixels per m
    glm::vec3 offset_{}; // pixels
    DepthBuffer depth_;
    std::vector<Pixel> pixels_;
    std::vector<glm::vec3> places_;    // pixels, place of each vertex of a mesh
    std::vector<std::uint32_t> cells_; // cell() of each place
};

/// Offset of the plant in a view, 0 to 1 pixels. It differs from view to view, so that a trunk in
/// the middle does not lie between the same pixel centres in all views. R2 sequence (Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
glm::vec2 offset_of(std::uint64_t view) {
    const glm::vec2 at = static_cast<float>(view + 1) * glm::vec2(0.7548777F, 0.5698403F);
    return at - glm::floor(at);
}

VisibleAreas sum_of(const std::vector<VisibleAreas>& each) {
    VisibleAreas sum;
    for (const VisibleAreas& areas : each) {
        sum.add(areas);
    }
    return sum;
}

} // namespace

AreaMeter::AreaMeter(const Mesh& wood,
                     const Mesh& foliage,
                     const Bounds& frame,
                     std::uint32_t threads)
    : frame_(frame), size_(kTrialSize), workers_(threads) {
    const double covered = sum_of(measure_views(wood, foliage, kTrialViews, 1)).all() / kTrialViews;
    const double factor = std::sqrt(kTargetPixels / std::max(covered, 1.0));
    size_ = static_cast<int>(std::clamp(factor * kTrialSize, double{kMinSize}, double{kMaxSize}));
}

VisibleAreas AreaMeter::measure(const Mesh& wood, const Mesh& foliage, VisibleAreas* third) {
    const std::vector<VisibleAreas> each = measure_views(wood, foliage, kViews, 1);
    if (third != nullptr) {
        *third = {};
        for (std::size_t i = 0; i < each.size(); i += kViewStep) {
            third->add(each[i]);
        }
    }
    return sum_of(each);
}

VisibleAreas AreaMeter::measure_third(const Mesh& wood, const Mesh& foliage) {
    return sum_of(measure_views(wood, foliage, kViews / kViewStep, kViewStep));
}

std::vector<VisibleAreas> AreaMeter::measure_views(const Mesh& wood,
                                                   const Mesh& foliage,
                                                   std::size_t count,
                                                   std::size_t step) {
    const std::array<DrawnMesh, 2> meshes{DrawnMesh(wood, true, textures_),
                                          DrawnMesh(foliage, false, textures_)};
    std::vector<VisibleAreas> each(count);
    workers_.for_each(count, [&](std::uint64_t i) {
        const std::uint64_t number = step * i;
        View view(frame_, kTurns[number / kTilts.size()], kTilts[number % kTilts.size()],
                  offset_of(number), size_);
        for (const DrawnMesh& drawn : meshes) {
            view.draw(drawn);
        }
        each[i] = view.areas();
    });
    return each;
}

} // namespace lsys
