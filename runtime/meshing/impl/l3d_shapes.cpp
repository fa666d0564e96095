// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/l3d_shapes.h"

#include "grammar/base/trigonometry.h"
#include "runtime/base/axis_rotation.h"
#include "runtime/base/glibc_random.h"

#include <glm/ext/quaternion_double.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace lsys {

namespace {

constexpr std::uint16_t kLeafGreen = 1;
constexpr std::size_t kLeafCorners = 8;
/// Max angle in radians that L3D treats as 0.
constexpr double kNoTurn = 0.001;

/// The shortest rotation that takes +Y to `heading`. The identity if L3D finds no axis, for example
/// for a heading straight down.
glm::dquat turn_to(const glm::dvec3& heading) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    glm::dvec3 axis = glm::cross(up, heading);
    const double length = glm::length(axis);
    if (!(length > 0.0)) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    axis /= length;
    const double angle = arc_cosine(std::clamp(heading.y / glm::length(heading), -1.0, 1.0));
    if (std::abs(angle) <= kNoTurn) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    return rotation_about(axis, angle);
}

glm::dvec3 heading_of(const glm::quat& frame) {
    return glm::dquat(frame) * glm::dvec3(0.0, 1.0, 0.0);
}

std::uint64_t index_count(const Segment& segment) {
    return 3 * (2 * std::uint64_t{segment.sides} + 2 * (std::uint64_t{segment.sides} - 2));
}

/// Writes into a block from its begin.
class ShapeWriter {
public:
    explicit ShapeWriter(const MeshBlock& block) : block_(block) {}

    void cylinder(const Segment& segment, std::uint32_t number);
    void leaf(const PlacedObject& object, double bend);

private:
    void triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        for (const std::uint64_t corner : {a, b, c}) {
            block_.indices[index_++] = static_cast<std::uint32_t>(block_.first_vertex + corner);
        }
    }

    const MeshBlock& block_;
    std::uint64_t vertex_ = 0; // the next vertex to write
    std::uint64_t index_ = 0;  // the next index to write
};

void ShapeWriter::cylinder(const Segment& segment, std::uint32_t number) {
    const std::uint32_t sides = segment.sides;
    const glm::dquat turn = turn_to(heading_of(segment.frame));
    const auto length = static_cast<double>(segment.length);
    const std::uint64_t first = vertex_;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        const SineCosine around = sine_cosine(angle);
        const glm::dvec3 out(around.cosine, 0.0, around.sine);
        const glm::dvec3 along(-out.z, 0.0, out.x);
        for (const bool top : {true, false}) {
            const auto radius = static_cast<double>(top ? segment.tip_radius : segment.base_radius);
            const glm::dvec3 place =
                turn * (radius * out + glm::dvec3(0.0, top ? length : 0.0, 0.0));
            MeshVertex vertex;
            vertex.position = segment.base + glm::vec3(place);
            vertex.normal = glm::vec3(turn * out);
            vertex.texture_coordinate = {2.0F * static_cast<float>(i) / static_cast<float>(sides),
                                         top ? 0.0F : 1.0F};
            vertex.tangent = glm::vec4(glm::vec3(turn * along), 1.0F);
            vertex.segment = number;
            block_.set(vertex_++, vertex);
        }
    }
    const auto top = [&](std::uint32_t i) { return first + 2 * (i % sides); };
    const auto bottom = [&](std::uint32_t i) { return first + 2 * (i % sides) + 1; };
    for (std::uint32_t i = 0; i < sides; ++i) {
        triangle(top(i), top(i + 1), bottom(i));
        triangle(bottom(i), top(i + 1), bottom(i + 1));
    }
    for (std::uint32_t i = 1; i + 1 < sides; ++i) {
        triangle(top(0), top(i + 1), top(i));
        triangle(bottom(0), bottom(i), bottom(i + 1));
    }
}

/// Writes a leaf. `bend`: distance of the tip of the leaf from its plane.
void ShapeWriter::leaf(const PlacedObject& object, double bend) {
    const std::array<glm::dvec3, kLeafCorners> corners{{
        {0.0, 0.01, 0.0},
        {0.2, 0.1, 0.0},
        {0.25, 0.3, 0.0},
        {0.2, 0.6, bend / 2.0},
        {0.0, 1.0 - bend, bend},
        {-0.2, 0.6, bend / 2.0},
        {-0.25, 0.3, 0.0},
        {-0.2, 0.1, 0.0},
    }};
    const glm::dquat turn = turn_to(heading_of(object.frame));
    const std::uint64_t first = vertex_;
    for (const glm::dvec3& corner : corners) {
        MeshVertex vertex;
        vertex.position =
            object.position + glm::vec3(turn * (static_cast<double>(object.size) * corner));
        vertex.normal = glm::vec3(turn * glm::dvec3(0.0, 0.0, 1.0));
        vertex.texture_coordinate = {static_cast<float>(0.5 + 2.0 * corner.x),
                                     static_cast<float>(1.0 - corner.y)};
        vertex.tangent = glm::vec4(glm::vec3(turn * glm::dvec3(1.0, 0.0, 0.0)), 1.0F);
        vertex.palette = kLeafGreen;
        vertex.segment = object.parent;
        block_.set(vertex_++, vertex);
    }
    for (std::size_t i = 1; i + 1 < kLeafCorners; ++i) {
        triangle(first, first + i, first + i + 1);
    }
}

} // namespace

void append_l3d_shapes(const Skeleton& skeleton, MeshBuilder& builder) {
    std::uint64_t vertices = 0;
    std::uint64_t indices = 0;
    for (const Segment& segment : skeleton.segments) {
        vertices += 2 * std::uint64_t{segment.sides};
        indices += index_count(segment);
    }
    MeshBlock block;
    if (vertices != 0) {
        if (!builder.reserve(builder.part(wood_material(0)), vertices, indices, block)) {
            return;
        }
        ShapeWriter writer(block);
        for (std::uint32_t i = 0; i < skeleton.segments.size(); ++i) {
            writer.cylinder(skeleton.segments[i], i);
        }
    }
    const auto is_leaf = [](const PlacedObject& object) {
        return object.kind == TurtleOperation::Leaf;
    };
    const auto leaves = static_cast<std::uint64_t>(
        std::count_if(skeleton.objects.begin(), skeleton.objects.end(), is_leaf));
    const MaterialKey green{
        .kind = MaterialKind::Leaf, .palette = kLeafGreen, .two_sided = true, .textured = true};
    if (leaves == 0 || !builder.reserve(builder.part(green), kLeafCorners * leaves,
                                        3 * (kLeafCorners - 2) * leaves, block)) {
        return;
    }
    ShapeWriter writer(block);
    GlibcRandom random;
    for (const PlacedObject& object : skeleton.objects) {
        if (is_leaf(object)) {
            double bend = heading_of(object.frame).y / 4.0;
            if (bend == 0.0) {
                bend = (static_cast<double>(random.next() % 20) - 10.0) / 100.0;
            }
            writer.leaf(object, bend);
        }
    }
}

} // namespace lsys
