#include "runtime/export/outline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr int kDirections = 128;

/// Points of a spiral that covers the sphere evenly (Swinbank and Purser, "Fibonacci grids", 2006).
glm::vec3 direction(int i) {
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * i + 1.0) / kDirections;
    const double radius = std::sqrt(1.0 - z * z);
    return glm::vec3(static_cast<float>(radius * std::cos(golden * i)),
                     static_cast<float>(radius * std::sin(golden * i)), static_cast<float>(z));
}

/// The point that lies farthest in each of many directions, once each.
template <typename Points>
std::vector<glm::vec3> extreme_points(const Points& points) {
    std::vector<std::size_t> extreme;
    for (int i = 0; i < kDirections && !points.empty(); ++i) {
        const glm::vec3 ahead = direction(i);
        std::size_t farthest = 0;
        for (std::size_t p = 1; p < points.size(); ++p) {
            if (glm::dot(points[p], ahead) > glm::dot(points[farthest], ahead)) {
                farthest = p;
            }
        }
        extreme.push_back(farthest);
    }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    std::vector<glm::vec3> found;
    for (const std::size_t p : extreme) {
        found.push_back(points[p]);
    }
    return found;
}

/// What is seen of a card that is cut out by the texture of a leaf: the pointed ellipse in its box.
std::vector<glm::vec3> leaf_outline(const Bounds& box) {
    constexpr int kSteps = 8;
    std::vector<glm::vec3> corners;
    const glm::vec3 middle = 0.5F * (box.low + box.high);
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i <= kSteps; ++i) {
            const float t = static_cast<float>(i) / kSteps;
            const float half = 2.0F * t * (1.0F - t) * (box.high.x - box.low.x);
            corners.emplace_back(middle.x + static_cast<float>(side) * half,
                                 box.low.y + t * (box.high.y - box.low.y), middle.z);
        }
    }
    return corners;
}

float turn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

Outline object_outline(const Skeleton& skeleton,
                       const PlacedObject& object,
                       const std::vector<UserMesh>& user_meshes) {
    Skeleton alone;
    alone.objects.push_back(object);
    alone.objects[0].position = glm::vec3(0.0F);
    alone.objects[0].frame = glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
    alone.objects[0].size = 1.0F;
    alone.objects[0].parent = kNoSegment;
    alone.mesh_files = skeleton.mesh_files;
    MeshOptions options;
    options.tangents = false;
    options.colours = false;
    options.threads = 1;
    Mesh mesh;
    Outline outline;
    if (make_mesh(alone, user_meshes, options, mesh) != MeshStatus::Ok || mesh.parts.empty()) {
        return outline;
    }
    const Material& material = mesh.materials[mesh.parts[0].material];
    outline.colour = glm::vec3(material.colour);
    if (material.cut_out) {
        Bounds box;
        for (const glm::vec3& position : mesh.positions) {
            box.add(position);
        }
        outline.corners = leaf_outline(box);
    } else {
        outline.corners = extreme_points(mesh.positions);
    }
    return outline;
}

std::vector<glm::vec2> convex_hull(std::vector<glm::vec2>& points) {
    // Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
    std::sort(points.begin(), points.end(), [](const glm::vec2& a, const glm::vec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<glm::vec2> chain;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = chain.size();
        for (const glm::vec2& point : points) {
            while (chain.size() >= start + 2 &&
                   turn(chain[chain.size() - 2], chain.back(), point) <= 0.0F) {
                chain.pop_back();
            }
            chain.push_back(point);
        }
        if (!chain.empty()) {
            chain.pop_back(); // the first point of the other chain
        }
        std::reverse(points.begin(), points.end());
    }
    return chain;
}

} // namespace lsys
