#include "runtime/export/impl/outline.h"

#include "runtime/meshing/shapes.h"

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

/// The farthest point in each of many directions, without duplicates.
std::vector<glm::vec3> extreme_points(const std::vector<glm::vec3>& points) {
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
    found.reserve(extreme.size());
    for (const std::size_t p : extreme) {
        found.push_back(points[p]);
    }
    return found;
}

float turn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

std::vector<Outline> object_outlines(const PlacedObject& object,
                                     const std::vector<UserMesh>& user_meshes) {
    Shape shape;
    if (object.kind != TurtleOperation::MeshFile) {
        shape = make_shape(object.kind, 0);
    } else if (object.mesh_file < user_meshes.size()) {
        shape = make_shape(user_meshes[object.mesh_file]);
    }
    std::vector<Outline> outlines;
    for (const ShapePart& part : shape.parts) {
        const bool own = part.takes_colour && object.colour != 0;
        outlines.push_back({extreme_points(part.positions),
                            palette_colour(own ? object.colour : part.material.palette)});
    }
    // The calyx, the last part of a flower, is drawn first: petals hide it.
    std::rotate(outlines.begin(), outlines.end() - (outlines.size() > 1 ? 1 : 0), outlines.end());
    return outlines;
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
