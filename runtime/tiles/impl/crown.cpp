// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/crown.h"

#include "runtime/meshing/looks.h"
#include "runtime/meshing/texture.h"
#include "runtime/meshing/triangle_list.h"
#include "runtime/turtle/skeleton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

/// Mean appearance of the triangles of a material.
struct Shade {
    glm::dvec3 colour{1.0};
    double opacity = 1.0; // opaque fraction of the area of the triangles
};

double opacity_of(const Texture& picture) {
    const std::size_t count = picture.texels.size() / 4;
    std::size_t opaque = 0;
    for (std::size_t i = 0; i < count; ++i) {
        opaque += picture.texels[4 * i + 3] >= 128 ? 1U : 0U;
    }
    return count == 0 ? 1.0 : static_cast<double>(opaque) / static_cast<double>(count);
}

Shade shade_of(const Material& material) {
    Shade shade{glm::dvec3(material.colour)};
    if (!material.textured) {
        return shade;
    }
    const Texture made = material.picture == nullptr ? material_texture(material.kind) : Texture{};
    const Texture& picture = material.picture == nullptr ? made : *material.picture;
    shade.colour *= glm::dvec3(mean_colour(picture));
    if (material.cut_out) {
        shade.opacity = opacity_of(picture);
    }
    return shade;
}

/// A square of the ground, seen from above.
struct Sample {
    float height = -std::numeric_limits<float>::infinity(); // m, of the highest surface
    glm::dvec3 colour{0.0};                                 // linear, of this surface
    double cover = 0.0;                                     // opaque fraction of the square, 0 to 1
};

} // namespace

Crown crown_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    const double width = static_cast<double>(bounds.high.x - bounds.low.x);
    const double depth = static_cast<double>(bounds.high.z - bounds.low.z);
    Crown crown;
    if (bounds.empty || width <= 0.0 || depth <= 0.0) {
        return crown;
    }
    const double step_x = width / kCrownLines;
    const double step_z = depth / kCrownLines;
    std::vector<Sample> samples(std::size_t{kCrownLines} * kCrownLines);
    TriangleReader reader(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const Shade shade = shade_of(mesh.materials[part.material]);
        for (std::uint64_t i = part.first_index; i + 2 < part.first_index + part.index_count;
             i += 3) {
            const std::array<std::uint32_t, 3> corner{reader[i], reader[i + 1], reader[i + 2]};
            std::array<glm::dvec3, 3> at{};
            for (std::size_t k = 0; k < 3; ++k) { // x and z in samples, y in m
                const glm::dvec3 position(mesh.positions[corner[k]]);
                at[k] = {(position.x - static_cast<double>(bounds.low.x)) / step_x, position.y,
                         (position.z - static_cast<double>(bounds.low.z)) / step_z};
            }
            const double twice_area = (at[1].x - at[0].x) * (at[2].z - at[0].z) -
                                      (at[2].x - at[0].x) * (at[1].z - at[0].z);
            if (twice_area == 0.0) {
                continue;
            }
            const glm::dvec3 colour =
                mesh.colours.empty()
                    ? shade.colour
                    : glm::dvec3(plain_colour(mesh.looks.get(), mesh.colours[corner[0]]));
            const auto first = [](double low) {
                return std::max(0, static_cast<int>(std::ceil(low - 0.5)));
            };
            const auto last = [](double high) {
                return std::min(kCrownLines - 1, static_cast<int>(std::floor(high - 0.5)));
            };
            const int end_z = last(std::max({at[0].z, at[1].z, at[2].z}));
            const int end_x = last(std::max({at[0].x, at[1].x, at[2].x}));
            for (int row = first(std::min({at[0].z, at[1].z, at[2].z})); row <= end_z; ++row) {
                for (int column = first(std::min({at[0].x, at[1].x, at[2].x})); column <= end_x;
                     ++column) {
                    const double x = column + 0.5;
                    const double z = row + 0.5;
                    const double w1 = ((x - at[0].x) * (at[2].z - at[0].z) -
                                       (at[2].x - at[0].x) * (z - at[0].z)) /
                                      twice_area;
                    const double w2 = ((at[1].x - at[0].x) * (z - at[0].z) -
                                       (x - at[0].x) * (at[1].z - at[0].z)) /
                                      twice_area;
                    if (w1 < 0.0 || w2 < 0.0 || w1 + w2 > 1.0) {
                        continue;
                    }
                    const auto height = static_cast<float>(at[0].y + w1 * (at[1].y - at[0].y) +
                                                           w2 * (at[2].y - at[0].y));
                    Sample& sample = samples[static_cast<std::size_t>(row) * kCrownLines +
                                             static_cast<std::size_t>(column)];
                    // A triangle with holes covers its opaque fraction of the area that is not
                    // covered yet.
                    sample.cover = 1.0 - (1.0 - sample.cover) * (1.0 - shade.opacity);
                    if (height > sample.height) {
                        sample.height = height;
                        sample.colour = colour;
                    }
                }
            }
        }
    }
    for (const Sample& sample : samples) {
        crown.area += sample.cover;
        if (sample.cover > 0.0) {
            crown.height += sample.cover * static_cast<double>(sample.height);
            crown.colour += sample.cover * sample.colour;
        }
    }
    if (crown.area > 0.0) {
        crown.height /= crown.area;
        crown.colour /= crown.area;
        crown.area *= step_x * step_z;
    }
    return crown;
}

} // namespace lsys
