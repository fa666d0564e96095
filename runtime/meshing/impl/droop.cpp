// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/droop.h"

#include "grammar/base/contract.h"
#include "grammar/base/trigonometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

// Max number of rows of vertices of a leaf.
constexpr std::size_t kMaxRows = 16;
// Max turn, in radians, of a leaf that stands on its edge.
constexpr float kSidewaysTurn = 2.1F;

/// Fraction of the whole turn that is reached at `distance`, from 0 (the base) to 1 (the tip). The
/// midrib bends most at the base.
float part_of_turn(float distance) {
    const float rest = 1.0F - distance;
    return 1.0F - rest * rest;
}

} // namespace

Droop::Droop(const ShapePart& part) {
    rows_.push_back(0.0F);
    for (const glm::vec3& position : part.positions) {
        rows_.push_back(position.y);
    }
    std::sort(rows_.begin(), rows_.end());
    rows_.erase(std::unique(rows_.begin(), rows_.end()), rows_.end());
    LSYS_CHECK(rows_.size() <= kMaxRows && rows_.front() == 0.0F, rows_.size());
    for (const float row : rows_) {
        turn_parts_.push_back(part_of_turn(row));
    }
    for (const glm::vec3& position : part.positions) {
        const auto row = std::lower_bound(rows_.begin(), rows_.end(), position.y);
        row_of_.push_back(static_cast<std::uint32_t>(row - rows_.begin()));
    }
}

void Droop::bend(const ShapePart& part,
                 const glm::quat& frame,
                 float amount,
                 ShapePart& bent) const {
    // The direction to the ground in the leaf's space, the component of this direction across the
    // midrib, and the axis about which the leaf bends.
    const glm::vec3 down = glm::conjugate(frame) * glm::vec3(0.0F, -1.0F, 0.0F);
    glm::vec3 across(down.x, 0.0F, down.z);
    const float length = glm::length(across);
    // A leaf that points straight up bends towards its lower side.
    across = length > 1e-5F ? across / length : glm::vec3(0.0F, 0.0F, -1.0F);
    const glm::vec3 axis(across.z, 0.0F, -across.x);
    // A blade is stiff sideways: if it bent further, it would fold at its inner edge.
    const float max_turn = glm::mix(std::numbers::pi_v<float>, kSidewaysTurn, std::abs(across.x));
    const auto to_ground =
        static_cast<float>(polar_angle(static_cast<double>(length), static_cast<double>(down.y)));
    const float turn = amount * std::min(to_ground, max_turn);

    struct Row {
        glm::vec3 centre;
        glm::vec3 along;  // image of +Y
        glm::vec3 across; // image of `across`
    };
    std::array<Row, kMaxRows> rows;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const SineCosine bend_here = sine_cosine(static_cast<double>(turn * turn_parts_[i]));
        const auto c = static_cast<float>(bend_here.cosine);
        const auto s = static_cast<float>(bend_here.sine);
        rows[i] = {.centre = glm::vec3(0.0F),
                   .along = glm::vec3(0.0F, c, 0.0F) + s * across,
                   .across = c * across - glm::vec3(0.0F, s, 0.0F)};
        if (i > 0) {
            const glm::vec3 halfway = glm::normalize(rows[i - 1].along + rows[i].along);
            rows[i].centre = rows[i - 1].centre + (rows_[i] - rows_[i - 1]) * halfway;
        }
    }
    const auto turned = [&](const glm::vec3& v, const Row& row) {
        return glm::dot(v, axis) * axis + glm::dot(v, across) * row.across + v.y * row.along;
    };
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        const Row& row = rows[row_of_[i]];
        const glm::vec3& at = part.positions[i];
        bent.positions[i] = row.centre + turned({at.x, 0.0F, at.z}, row);
        bent.normals[i] = turned(part.normals[i], row);
        const glm::vec4& tangent = part.tangents[i];
        bent.tangents[i] = glm::vec4(turned(glm::vec3(tangent), row), tangent.w);
    }
}

} // namespace lsys
