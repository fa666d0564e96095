#include "runtime/meshing/impl/visible_areas.h"

#include "runtime/meshing/impl/raster.h"
#include "runtime/meshing/texture.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr int kSize = 384; // pixels of a side
constexpr float kDiagonal = 0.70710678F;
/// Cosine and sine of the turn about +Y, and of the height of the eye above the horizon.
constexpr std::array<std::array<float, 2>, 4> kTurns{
    {{1.0F, 0.0F}, {kDiagonal, kDiagonal}, {0.0F, 1.0F}, {-kDiagonal, kDiagonal}}};
constexpr std::array<std::array<float, 2>, 2> kTilts{{{1.0F, 0.0F}, {0.8F, 0.6F}}};
constexpr std::uint8_t kHalfOpaque = 128;

enum class Cover : std::uint8_t { Nothing, Wood, Foliage };

/// The texture whose opacity cuts a material out; empty where it is opaque.
Texture cut_out_texture(const Material& material) {
    if (!material.cut_out || !material.textured) {
        return {};
    }
    return material.picture != nullptr ? *material.picture : material_texture(material.kind);
}

bool is_opaque(const Texture& texture, const glm::vec2& place) {
    const std::size_t texel = texel_number(place.x, place.y, texture.width, texture.height);
    return texture.texels[4 * texel + 3] >= kHalfOpaque;
}

/// One view: the nearest surface at each pixel.
class View {
public:
    View(const Bounds& frame, const std::array<float, 2>& turn, const std::array<float, 2>& tilt)
        : middle_(0.5F * (frame.low + frame.high)), cosine_(turn[0]), sine_(turn[1]),
          tilt_cosine_(tilt[0]), tilt_sine_(tilt[1]), depth_(kSize, kSize),
          cover_(std::size_t{kSize} * kSize, Cover::Nothing) {
        const glm::vec3 half = frame.high - middle_;
        const float across = std::sqrt(half.x * half.x + half.z * half.z);
        reach_ = std::max({tilt_cosine_ * half.y + tilt_sine_ * across, across,
                           std::numeric_limits<float>::min()});
        scale_ = 0.5F * static_cast<float>(kSize) / reach_;
    }

    void draw(const Mesh& mesh, Cover cover) {
        TriangleReader indices(mesh.indices);
        for (const MeshPart& part : mesh.parts) {
            const Texture texture = cut_out_texture(mesh.materials[part.material]);
            const bool is_cut = !texture.texels.empty() && !mesh.texture_coordinates.empty();
            for (std::uint64_t i = 0; i + 2 < part.index_count; i += 3) {
                const std::uint64_t first = part.first_index + i;
                draw(mesh, {indices[first], indices[first + 1], indices[first + 2]},
                     is_cut ? &texture : nullptr, cover);
            }
        }
    }

    void add_to(VisibleAreas& areas) const {
        areas.wood += static_cast<double>(std::count(cover_.begin(), cover_.end(), Cover::Wood));
        areas.foliage +=
            static_cast<double>(std::count(cover_.begin(), cover_.end(), Cover::Foliage));
    }

private:
    [[nodiscard]] glm::vec3 place(const glm::vec3& position) const {
        const glm::vec3 p = position - middle_;
        const float near = cosine_ * p.z - sine_ * p.x;
        return scale_ * glm::vec3(cosine_ * p.x + sine_ * p.z + reach_,
                                  tilt_cosine_ * p.y - tilt_sine_ * near + reach_,
                                  tilt_cosine_ * near + tilt_sine_ * p.y);
    }
    void draw(const Mesh& mesh,
              const std::array<std::uint32_t, 3>& corners,
              const Texture* cut,
              Cover cover) {
        const std::array<glm::vec3, 3> places{place(mesh.positions[corners[0]]),
                                              place(mesh.positions[corners[1]]),
                                              place(mesh.positions[corners[2]])};
        raster_triangle(places, depth_, [&](std::size_t pixel, const glm::vec3& weights) {
            if (cut != nullptr &&
                !is_opaque(*cut, weights.x * mesh.texture_coordinates[corners[0]] +
                                     weights.y * mesh.texture_coordinates[corners[1]] +
                                     weights.z * mesh.texture_coordinates[corners[2]])) {
                return false;
            }
            cover_[pixel] = cover;
            return true;
        });
    }

    glm::vec3 middle_;
    float cosine_;
    float sine_;
    float tilt_cosine_;
    float tilt_sine_;
    float reach_ = 1.0F;
    float scale_ = 1.0F;
    DepthBuffer depth_;
    std::vector<Cover> cover_;
};

} // namespace

VisibleAreas visible_areas(const Mesh& wood, const Mesh& foliage, const Bounds& frame) {
    VisibleAreas areas;
    for (const std::array<float, 2>& tilt : kTilts) {
        for (const std::array<float, 2>& turn : kTurns) {
            View view(frame, turn, tilt);
            view.draw(wood, Cover::Wood);
            view.draw(foliage, Cover::Foliage);
            view.add_to(areas);
        }
    }
    return areas;
}

} // namespace lsys
