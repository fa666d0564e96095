// SPDX-License-Identifier: MIT
// Collision shapes of a plant: capsules or convex hulls along trunk and boughs, as small meshes in
// glTF. Engines recognise collision shapes by their names.
#pragma once

#include "runtime/export/export.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// Max count of shapes of a plant.
inline constexpr std::size_t kMaxCollisionShapes = 60;

/// A closed convex mesh.
struct CollisionShape {
    std::string name;
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles; // counter-clockwise from outside
};

/// A nearly straight run of about equally thick segments, each the child of the one before.
struct BoughPiece {
    std::vector<std::uint32_t> segments;
    glm::vec3 from{}; // ends of the chord of the run
    glm::vec3 to{};
    float radius = 0.0F; // mean along the segments of the run
    double area = 0.0;   // 2 * radius * length: the area seen from the side
};

/// The largest pieces of trunk and boughs, by descending area. Their count is the smallest that
/// covers nine tenths of the area of all pieces, but at least 10 if the plant has as many, and at
/// most kMaxCollisionShapes. The trunk and each bough continue in the thickest segment that begins
/// at their end.
[[nodiscard]] std::vector<BoughPiece> find_boughs(const Skeleton& skeleton);

/// The shapes of find_boughs(). `info` states the kind of shapes, the kind of names and the name of
/// the plant.
[[nodiscard]] std::vector<CollisionShape> make_collision(const Skeleton& skeleton,
                                                         const ExportInfo& info);

} // namespace lsys
