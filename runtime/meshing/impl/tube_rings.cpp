// SPDX-License-Identifier: MIT
// TubeWriter: the functions that write rings to the arrays of the mesh.
#include "runtime/meshing/impl/bark_noise.h"
#include "runtime/meshing/impl/directions.h"
#include "runtime/meshing/impl/float4.h"
#include "runtime/meshing/impl/grooves.h"
#include "runtime/meshing/impl/stem_base.h"
#include "runtime/meshing/impl/tube_writer.h"
#include "runtime/meshing/looks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// An ellipse in space: the positions of a ring, or the ends of its normals.
struct Ellipse {
    Float4 centre;
    Float4 at_cosine;
    Float4 at_sine;

    [[nodiscard]] Float4 at(Float4 cosine, Float4 sine) const {
        return centre + (cosine * at_cosine + sine * at_sine);
    }
};

/// Writes `columns` vectors of both ellipses, three floats each. Every vector except the last is
/// stored as four floats; the next vector overwrites the fourth float.
void put_ellipses(glm::vec3* positions,
                  const Ellipse& position,
                  glm::vec3* normals,
                  const Ellipse& normal,
                  const Direction* at,
                  std::uint32_t columns) {
    const std::uint32_t last = columns - 1;
    for (std::uint32_t i = 0; i < last; ++i) {
        const Float4 cosine = float4(at[i].cosine);
        const Float4 sine = float4(at[i].sine);
        store_four(positions + i, position.at(cosine, sine));
        store_four(normals + i, normal.at(cosine, sine));
    }
    const Float4 cosine = float4(at[last].cosine);
    const Float4 sine = float4(at[last].sine);
    store_three(positions + last, position.at(cosine, sine));
    store_three(normals + last, normal.at(cosine, sine));
}

} // namespace

/// Whether bark, grooves or roots move the vertices of a ring.
bool TubeWriter::has_normal_map(const Ring& ring) const {
    return noise_ != nullptr || grooves_ != nullptr ||
           (roots_ != nullptr && ring.arc < roots_->reach());
}

void TubeWriter::put_ring(const Ring& ring) {
    const std::uint64_t first = at_.vertex;
    const std::uint32_t columns = columns_of(ring.sides, options_);
    at_.vertex += columns;
    if (has_normal_map(ring)) {
        put_normal_map(ring, first);
    } else {
        const float part =
            ring.slope == 0.0F ? 1.0F : 1.0F / std::sqrt(1.0F + ring.slope * ring.slope);
        const Ellipse position{float4(ring.centre), float4(ring.radius * ring.wide_normal),
                               float4(ring.radius * ring.wide_binormal)};
        const Ellipse normal{float4((-ring.slope * part) * ring.tangent),
                             float4(part * ring.normal), float4(part * ring.binormal)};
        put_ellipses(block_.positions.data() + first, position, block_.normals.data() + first,
                     normal, directions(ring.sides), columns);
    }
    if (seam_) {
        put_textured(ring, first);
    }
    if (options_.colours) {
        std::fill_n(block_.colours.data() + first, columns, ring.colour);
    }
}

float TubeWriter::v_of(const Ring& ring) {
    if (ring.colour != picture_colour_) {
        picture_colour_ = ring.colour;
        picture_length_ = picture_length(looks_, ring.colour);
    }
    return static_cast<float>(-ring.arc * v_scale_) / picture_length_;
}

void TubeWriter::put_textured(const Ring& ring, std::uint64_t first) {
    const std::uint32_t columns = ring.sides + 1;
    if (options_.texture_coordinates) {
        glm::vec2* to = block_.texture_coordinates.data() + first;
        const float v = v_of(ring);
        const float step = 1.0F / static_cast<float>(ring.sides);
        for (std::uint32_t i = 0; i < columns; ++i) {
            to[i] = {static_cast<float>(i) * step, v};
        }
        to[ring.sides].x = 1.0F;
    }
    if (!options_.tangents) {
        return;
    }
    glm::vec4* to = block_.tangents.data() + first;
    const Direction* at = directions(ring.sides);
    if (!has_normal_map(ring)) {
        const Float4 a = float4(ring.normal);
        const Float4 b = float4(ring.binormal);
        const Float4 sign = float4(glm::vec3(0.0F), 1.0F);
        for (std::uint32_t i = 0; i < columns; ++i) {
            store_four(to + i, sign + (float4(at[i].cosine) * b - float4(at[i].sine) * a));
        }
        return;
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        const glm::vec3& normal = block_.normals[first + i];
        const glm::vec3 around = at[i].cosine * ring.binormal - at[i].sine * ring.normal;
        to[i] = glm::vec4(glm::normalize(around - normal * glm::dot(normal, around)), 1.0F);
    }
}

void TubeWriter::put_normal_map(const Ring& ring, std::uint64_t first) {
    constexpr float kMinFactor = 0.05F;
    constexpr float kMeanGroove = -0.5F;
    const Direction* at = directions(ring.sides);
    const float amount = std::min(options_.bark_noise, 0.9F);
    const float depth = std::min(options_.grooves, 0.9F);
    const bool shows_grooves = grooves_ != nullptr && ring.sides >= 2 * grooves_->count();
    for (std::uint32_t i = 0; i < ring.sides; ++i) {
        const glm::vec3 out = at[i].cosine * ring.normal + at[i].sine * ring.binormal;
        const glm::vec3 around = at[i].cosine * ring.binormal - at[i].sine * ring.normal;
        const float turn = static_cast<float>(i) / static_cast<float>(ring.sides);
        NoiseSample normal_map{.value = grooves_ == nullptr ? 0.0F : depth * kMeanGroove};
        if (shows_grooves) {
            const NoiseSample groove = grooves_->at(turn, ring.arc);
            normal_map = {depth * groove.value, depth * groove.by_angle, depth * groove.by_length};
        }
        const auto add = [&](float weight, const NoiseSample& sample) {
            normal_map.value += weight * sample.value;
            normal_map.by_angle += weight * sample.by_angle;
            normal_map.by_length += weight * sample.by_length;
        };
        if (noise_ != nullptr) {
            add(amount, noise_->at(turn, ring.arc));
        }
        if (roots_ != nullptr) {
            add(1.0F, roots_->at(turn, ring.arc));
        }
        const float factor = std::max(1.0F + normal_map.value, kMinFactor);
        const glm::vec3 offset = at[i].cosine * ring.wide_normal + at[i].sine * ring.wide_binormal;
        const float along =
            std::clamp(ring.slope * factor + ring.radius * normal_map.by_length, -8.0F, 8.0F);
        block_.positions[first + i] = ring.centre + (ring.radius * factor) * offset;
        block_.normals[first + i] =
            glm::normalize(out - along * ring.tangent - (normal_map.by_angle / factor) * around);
    }
    if (seam_) {
        block_.positions[first + ring.sides] = block_.positions[first];
        block_.normals[first + ring.sides] = block_.normals[first];
    }
}

void TubeWriter::put_tip(const glm::vec3& position, const glm::vec3& normal, const Ring& ring) {
    block_.set(at_.vertex++, {.position = position,
                              .normal = normal,
                              .texture_coordinate = {0.5F, v_of(ring)},
                              .tangent = glm::vec4(ring.normal, 1.0F),
                              .palette = ring.colour});
}

} // namespace lsys
