// SPDX-License-Identifier: MIT
// Impostors in the light: their mean lit colour is about that of the plant, also against the sun
// and from behind a card. The test lights its own pictures as viewers of glTF do: normal maps in
// the frame of the tangents, normals of back faces reversed, a sun without ambient light.
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/impl/raster.h"
#include "runtime/meshing/mesh.h"
#include "runtime/meshing/texture.h"
#include "tests/support/sample_plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr int kSide = 256; // samples along each side of a picture
constexpr std::size_t kViews = 6;
constexpr float kTurn = 1.0471976F;                          // radians between two views
constexpr std::array<float, 3> kEyeTilts{0.25F, 0.7F, 1.1F}; // radians, elevations of the eye

/// A sun, and bounds of the brightness of an impostor as a fraction of that of the plant. Against the
/// sun both are dark, and cards, which are not all turned to the eye, are lit a little more.
struct Sun {
    const char* name;
    glm::vec3 direction; // to the sun: right, up, towards the eye
    double darkest;
    double brightest;
};
const std::array<Sun, 4> kSuns{{{"behind the eye", {0.3F, 0.6F, 0.74F}, 0.63, 1.1},
                                {"above", {0.0F, 1.0F, 0.1F}, 0.7, 1.5},
                                {"beside", {0.9F, 0.4F, 0.0F}, 0.75, 1.2},
                                {"in front", {0.3F, 0.75F, -0.6F}, 0.7, 2.9}}};

/// Mean lit colours of the samples that a mesh covers, by sun.
using LitColours = std::array<glm::dvec3, kSuns.size()>;

class LitDrawing {
public:
    explicit LitDrawing(const Mesh& mesh) : mesh_(mesh), indices_(mesh.indices.expanded()) {}

    /// Draws the mesh into a square around `frame`, from one of six directions.
    LitColours lit(const Bounds& frame, std::size_t view, float tilt) {
        const float turn = kTurn * static_cast<float>(view);
        const glm::vec3 towards(std::sin(turn) * std::cos(tilt), std::sin(tilt),
                                std::cos(turn) * std::cos(tilt));
        const glm::vec3 right(std::cos(turn), 0.0F, -std::sin(turn));
        const glm::mat3 axes(right, glm::cross(towards, right), towards);
        const glm::vec3 middle = 0.5F * (frame.low + frame.high);
        const float scale = 0.5F * kSide / glm::distance(middle, frame.high);
        std::vector<glm::vec3> places;
        for (const glm::vec3& at : mesh_.positions) {
            places.push_back(scale * ((at - middle) * axes) + 0.5F * kSide);
        }
        DepthBuffer buffer(kSide, kSide);
        std::vector<Sample> samples(buffer.depths.size());
        for (const MeshPart& part : mesh_.parts) {
            draw_part(part, places, towards, buffer, samples);
        }
        LitColours colours{};
        double count = 0.0;
        for (const Sample& sample : samples) {
            count += sample.is_covered ? 1.0 : 0.0;
            for (std::size_t i = 0; i < kSuns.size() && sample.is_covered; ++i) {
                const glm::vec3 sun = axes * glm::normalize(kSuns[i].direction);
                colours[i] +=
                    glm::dvec3(std::max(glm::dot(sample.normal, sun), 0.0F) * sample.colour);
            }
        }
        for (glm::dvec3& colour : colours) {
            colour /= count;
        }
        return colours;
    }

private:
    struct Sample {
        bool is_covered = false;
        glm::vec3 colour{};
        glm::vec3 normal{};
    };

    void draw_part(const MeshPart& part,
                   const std::vector<glm::vec3>& places,
                   const glm::vec3& towards,
                   DepthBuffer& buffer,
                   std::vector<Sample>& samples) {
        const Material& material = mesh_.materials[part.material];
        const LinearTexture& texture = textures_.texture_of(material);
        for (std::uint64_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
            const std::array<std::uint32_t, 3> v{indices_[i], indices_[i + 1], indices_[i + 2]};
            const glm::vec3 face = glm::cross(mesh_.positions[v[1]] - mesh_.positions[v[0]],
                                              mesh_.positions[v[2]] - mesh_.positions[v[0]]);
            const bool is_back = glm::dot(face, towards) < 0.0F;
            if (is_back && !material.two_sided) {
                continue;
            }
            raster_triangle({places[v[0]], places[v[1]], places[v[2]]}, buffer,
                            [&](std::size_t pixel, const glm::vec3& w) {
                                return shade(material, texture, v, w, is_back, samples[pixel]);
                            });
        }
    }

    bool shade(const Material& material,
               const LinearTexture& texture,
               const std::array<std::uint32_t, 3>& v,
               const glm::vec3& w,
               bool is_back,
               Sample& sample) const {
        const glm::vec2 at = w.x * mesh_.texture_coordinates[v[0]] +
                             w.y * mesh_.texture_coordinates[v[1]] +
                             w.z * mesh_.texture_coordinates[v[2]];
        if (material.cut_out && !texture.texels.empty() && !texture.is_opaque(at)) {
            return false;
        }
        glm::vec3 normal =
            w.x * mesh_.normals[v[0]] + w.y * mesh_.normals[v[1]] + w.z * mesh_.normals[v[2]];
        if (material.normal_map != nullptr) {
            const Texture& map = *material.normal_map;
            const std::uint8_t* const texel =
                &map.texels[4 * texel_number(at.x, at.y, map.width, map.height)];
            const glm::vec4& tangent = mesh_.tangents[v[0]];
            const glm::mat3 frame(glm::vec3(tangent),
                                  tangent.w * glm::cross(normal, glm::vec3(tangent)), normal);
            normal = frame * (glm::vec3(texel[0], texel[1], texel[2]) / 127.5F - 1.0F);
        }
        sample = {true, glm::vec3(material.colour),
                  (is_back ? -1.0F : 1.0F) * glm::normalize(normal)};
        if (!texture.texels.empty()) {
            sample.colour *= glm::vec3(texture.at(at));
        }
        return true;
    }

    const Mesh& mesh_;
    LargeVector<std::uint32_t> indices_;
    LinearTextures textures_;
};

/// Mean over all views.
LitColours mean_lit(const Mesh& mesh, const Bounds& frame, float tilt) {
    LitDrawing drawing(mesh);
    LitColours mean{};
    for (std::size_t view = 0; view < kViews; ++view) {
        const LitColours lit = drawing.lit(frame, view, tilt);
        for (std::size_t i = 0; i < kSuns.size(); ++i) {
            mean[i] += lit[i] / static_cast<double>(kViews);
        }
    }
    return mean;
}

} // namespace

TEST_CASE("impostors are about as bright as the plant under any sun", "[levels]") {
    const std::string name =
        GENERATE("carey-type-0", "carey-type-2", "species/norway-spruce", "species/european-beech");
    const Plant plant = test::sample_plant(name);
    DetailLevels levels;
    REQUIRE(plan_detail_levels(plant.skeleton, plant.user_meshes, {.threads = 1},
                               {.pictures = true}, levels) == std::nullopt);
    const auto mesh_of = [&](std::size_t number) {
        Mesh mesh;
        REQUIRE(make_detail_mesh(plant.skeleton, plant.user_meshes, levels, number, {.threads = 1},
                                 mesh) == std::nullopt);
        return mesh;
    };
    const Mesh fine = mesh_of(0);
    Bounds frame;
    for (const glm::vec3& at : fine.positions) {
        frame.add(at);
    }
    std::size_t impostors = 0;
    for (std::size_t number = 1; number < levels.levels.size(); ++number) {
        if (!levels.levels[number].is_impostor) {
            continue;
        }
        ++impostors;
        const Mesh coarse = mesh_of(number);
        for (const float tilt : kEyeTilts) {
            const LitColours wanted = mean_lit(fine, frame, tilt);
            const LitColours lit = mean_lit(coarse, frame, tilt);
            for (std::size_t i = 0; i < kSuns.size(); ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    CAPTURE(name, number, tilt, kSuns[i].name, channel, wanted[i][channel]);
                    CHECK(lit[i][channel] >= kSuns[i].darkest * wanted[i][channel]);
                    CHECK(lit[i][channel] <= kSuns[i].brightest * wanted[i][channel]);
                }
            }
        }
    }
    CHECK(impostors >= 2);
}

} // namespace lsys
