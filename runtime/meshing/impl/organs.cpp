// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/organs.h"

#include "runtime/base/workers.h"
#include "runtime/meshing/organ_shape.h"
#include "runtime/turtle/organs.h"

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lsys {

namespace {

/// Organs whose surfaces are in memory at a time, beside the mesh.
constexpr std::size_t kOrgansPerBatch = 256;

void write_part(const PlacedObject& object, const OrganPart& part, const MeshBlock& block) {
    const ShapePart& shape = part.shape;
    const glm::mat3 turn = glm::mat3_cast(object.frame);
    const glm::mat3 turn_and_scale = object.size * turn;
    const bool mirrored = object.size < 0.0F; // the surface is inside out
    const float side = mirrored ? -1.0F : 1.0F;
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const glm::vec4& tangent = shape.tangents[i];
        block.set(i, {.position = object.position + turn_and_scale * shape.positions[i],
                      .normal = side * (turn * shape.normals[i]),
                      .texture_coordinate = shape.texture_coordinates[i],
                      .tangent = glm::vec4(side * (turn * glm::vec3(tangent)), side * tangent.w),
                      .palette = part.colour,
                      .segment = object.parent});
    }
    for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
        block.indices[i] = block.first_vertex + shape.indices[i];
        block.indices[i + 1] = block.first_vertex + shape.indices[i + (mirrored ? 2 : 1)];
        block.indices[i + 2] = block.first_vertex + shape.indices[i + (mirrored ? 1 : 2)];
    }
}

} // namespace

void append_organs(const Skeleton& skeleton, const MeshOptions& options, MeshBuilder& builder) {
    std::vector<std::uint32_t> items;
    for (std::uint32_t i = 0; !skeleton.organs.empty() && i < skeleton.objects.size(); ++i) {
        if (is_organ(skeleton.objects[i]) && skeleton.objects[i].size != 0.0F) {
            items.push_back(i);
        }
    }
    if (items.empty()) {
        return;
    }
    Workers workers(options.threads);
    std::vector<OrganShape> shapes(std::min(items.size(), kOrgansPerBatch));
    for (std::size_t first = 0; first < items.size(); first += kOrgansPerBatch) {
        const std::size_t count = std::min(kOrgansPerBatch, items.size() - first);
        workers.for_each(count, [&](std::uint64_t i) {
            shapes[i] = make_organ(skeleton, skeleton.objects[items[first + i]], options.sides,
                                   options.level);
        });
        for (std::size_t i = 0; i < count; ++i) {
            for (const OrganPart& part : shapes[i].parts) {
                MeshBlock block;
                if (part.shape.indices.empty()) {
                    continue;
                }
                if (!builder.reserve(builder.part(part.shape.material, "surface"),
                                     part.shape.positions.size(), part.shape.indices.size(),
                                     block)) {
                    return;
                }
                write_part(skeleton.objects[items[first + i]], part, block);
            }
        }
    }
}

} // namespace lsys
