#include "runtime/meshing/impl/visible_areas.h"

#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/impl/raster.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr int kSize = 256;              // pixels of a side
constexpr float kCosine15 = 0.9659258F; // of 15 degrees: no card of an impostor is seen edge-on
constexpr float kSine15 = 0.2588190F;
constexpr float kDiagonal = 0.7071068F;
/// Cosine and sine of the turn about +Y, and of the height of the eye above the horizon.
constexpr std::array<std::array<float, 2>, 6> kTurns{{{kCosine15, kSine15},
                                                      {kDiagonal, kDiagonal},
                                                      {kSine15, kCosine15},
                                                      {-kSine15, kCosine15},
                                                      {-kDiagonal, kDiagonal},
                                                      {-kCosine15, kSine15}}};
constexpr std::array<std::array<float, 2>, 2> kTilts{{{1.0F, 0.0F}, {0.8F, 0.6F}}};

enum class Cover : std::uint8_t { Nothing, Wood, Foliage };

/// One view: the nearest surface at each pixel.
class View {
public:
    View(const Bounds& frame, const std::array<float, 2>& turn, const std::array<float, 2>& tilt)
        : middle_(0.5F * (frame.low + frame.high)), cosine_(turn[0]), sine_(turn[1]),
          tilt_cosine_(tilt[0]), tilt_sine_(tilt[1]), depth_(kSize, kSize),
          cover_(std::size_t{kSize} * kSize, Cover::Nothing), colours_(cover_.size()) {
        const glm::vec3 half = frame.high - middle_;
        const float across = std::sqrt(half.x * half.x + half.z * half.z);
        reach_ = std::max({tilt_cosine_ * half.y + tilt_sine_ * across, across,
                           std::numeric_limits<float>::min()});
        scale_ = 0.5F * static_cast<float>(kSize) / reach_;
    }

    void draw(const Mesh& mesh, Cover cover, LinearTextures& textures) {
        TriangleReader indices(mesh.indices);
        for (const MeshPart& part : mesh.parts) {
            const Material& material = mesh.materials[part.material];
            const LinearTexture& texture = textures.of(material);
            for (std::uint64_t i = 0; i + 2 < part.index_count; i += 3) {
                const std::uint64_t first = part.first_index + i;
                draw(mesh, {indices[first], indices[first + 1], indices[first + 2]}, material,
                     texture, cover);
            }
        }
    }

    void add_to(VisibleAreas& areas) const {
        for (std::size_t i = 0; i < cover_.size(); ++i) {
            areas.wood += cover_[i] == Cover::Wood ? 1.0 : 0.0;
            areas.foliage += cover_[i] == Cover::Foliage ? 1.0 : 0.0;
            areas.colour += glm::dvec3(colours_[i]);
        }
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
              const Material& material,
              const LinearTexture& texture,
              Cover cover) {
        const std::array<glm::vec3, 3> places{place(mesh.positions[corners[0]]),
                                              place(mesh.positions[corners[1]]),
                                              place(mesh.positions[corners[2]])};
        const bool is_textured = !texture.texels.empty() && !mesh.texture_coordinates.empty();
        raster_triangle(places, depth_, [&](std::size_t pixel, const glm::vec3& weights) {
            glm::vec4 texel(1.0F);
            if (is_textured) {
                texel = texture.at(weights.x * mesh.texture_coordinates[corners[0]] +
                                   weights.y * mesh.texture_coordinates[corners[1]] +
                                   weights.z * mesh.texture_coordinates[corners[2]]);
            }
            if (material.cut_out && texel.a == 0.0F) {
                return false;
            }
            cover_[pixel] = cover;
            colours_[pixel] = glm::vec3(material.colour) * glm::vec3(texel);
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
    std::vector<glm::vec3> colours_; // linear
};

} // namespace

VisibleAreas visible_areas(const Mesh& wood, const Mesh& foliage, const Bounds& frame) {
    VisibleAreas areas;
    LinearTextures textures;
    for (const std::array<float, 2>& tilt : kTilts) {
        for (const std::array<float, 2>& turn : kTurns) {
            View view(frame, turn, tilt);
            view.draw(wood, Cover::Wood, textures);
            view.draw(foliage, Cover::Foliage, textures);
            view.add_to(areas);
        }
    }
    return areas;
}

} // namespace lsys
