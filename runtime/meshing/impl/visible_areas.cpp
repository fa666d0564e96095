#include "runtime/meshing/impl/visible_areas.h"

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
/// Cosine and sine of the turn about +Y of each view.
constexpr std::array<std::array<float, 2>, 4> kTurns{
    {{1.0F, 0.0F}, {kDiagonal, kDiagonal}, {0.0F, 1.0F}, {-kDiagonal, kDiagonal}}};
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
    const auto index = [](float value, std::uint32_t size) {
        const float part = value - std::floor(value);
        return std::min(static_cast<std::uint32_t>(part * static_cast<float>(size)), size - 1);
    };
    const std::size_t texel =
        std::size_t{index(place.y, texture.height)} * texture.width + index(place.x, texture.width);
    return texture.texels[4 * texel + 3] >= kHalfOpaque;
}

/// One view: the nearest surface at each pixel.
class View {
public:
    View(const Bounds& frame, float cosine, float sine)
        : middle_(0.5F * (frame.low + frame.high)), cosine_(cosine), sine_(sine),
          depth_(std::size_t{kSize} * kSize, -std::numeric_limits<float>::infinity()),
          cover_(std::size_t{kSize} * kSize, Cover::Nothing) {
        const glm::vec3 half = frame.high - middle_;
        reach_ = std::max({half.y, std::sqrt(half.x * half.x + half.z * half.z),
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
        return scale_ * glm::vec3(cosine_ * p.x + sine_ * p.z + reach_, p.y + reach_,
                                  cosine_ * p.z - sine_ * p.x);
    }
    static int pixel(float at) {
        return static_cast<int>(std::clamp(at, 0.0F, static_cast<float>(kSize - 1)));
    }

    void draw(const Mesh& mesh,
              const std::array<std::uint32_t, 3>& corners,
              const Texture* cut,
              Cover cover) {
        const glm::vec3 a = place(mesh.positions[corners[0]]);
        const glm::vec3 b = place(mesh.positions[corners[1]]);
        const glm::vec3 c = place(mesh.positions[corners[2]]);
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (!(std::abs(area) > 0.0F)) {
            return;
        }
        const int end_x = pixel(std::max({a.x, b.x, c.x}));
        const int end_y = pixel(std::max({a.y, b.y, c.y}));
        for (int y = pixel(std::min({a.y, b.y, c.y})); y <= end_y; ++y) {
            for (int x = pixel(std::min({a.x, b.x, c.x})); x <= end_x; ++x) {
                const glm::vec2 p(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
                const float u = ((c.x - b.x) * (p.y - b.y) - (c.y - b.y) * (p.x - b.x)) / area;
                const float v = ((a.x - c.x) * (p.y - c.y) - (a.y - c.y) * (p.x - c.x)) / area;
                const float w = 1.0F - u - v;
                const float z = u * a.z + v * b.z + w * c.z;
                const std::size_t at =
                    static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x);
                if (u < 0.0F || v < 0.0F || w < 0.0F || !(z > depth_[at])) {
                    continue;
                }
                if (cut != nullptr &&
                    !is_opaque(*cut, u * mesh.texture_coordinates[corners[0]] +
                                         v * mesh.texture_coordinates[corners[1]] +
                                         w * mesh.texture_coordinates[corners[2]])) {
                    continue;
                }
                depth_[at] = z;
                cover_[at] = cover;
            }
        }
    }

    glm::vec3 middle_;
    float cosine_;
    float sine_;
    float reach_ = 1.0F;
    float scale_ = 1.0F;
    std::vector<float> depth_;
    std::vector<Cover> cover_;
};

} // namespace

VisibleAreas visible_areas(const Mesh& wood, const Mesh& foliage, const Bounds& frame) {
    VisibleAreas areas;
    for (const auto& [cosine, sine] : kTurns) {
        View view(frame, cosine, sine);
        view.draw(wood, Cover::Wood);
        view.draw(foliage, Cover::Foliage);
        view.add_to(areas);
    }
    return areas;
}

} // namespace lsys
