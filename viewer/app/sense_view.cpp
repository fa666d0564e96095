// SPDX-License-Identifier: MIT
#include "viewer/app/sense_view.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lsys::view {

namespace {

using SenseColour = std::array<std::uint8_t, 4>;

constexpr SenseColour kObstacleColour = {150, 165, 190, 110};
constexpr SenseColour kMarkerColour = {60, 200, 230, 255};
/// Colours of arrows, by the index of the environment in SensedPlant::parts; they repeat.
constexpr std::array<SenseColour, 6> kArrowColours = {{{255, 210, 40, 255},
                                                       {235, 90, 60, 255},
                                                       {90, 170, 255, 255},
                                                       {130, 220, 90, 255},
                                                       {220, 110, 220, 255},
                                                       {240, 240, 240, 255}}};

struct SenseWord {
    std::string_view word;
    bool SenseLook::*shown;
};
constexpr std::array<SenseWord, 4> kSenseWords = {{{"obstacles", &SenseLook::obstacles},
                                                   {"light", &SenseLook::light},
                                                   {"markers", &SenseLook::markers},
                                                   {"directions", &SenseLook::directions}}};

/// Colour of a light value, from dark blue (0, no light) to yellow (1, all light).
SenseColour colour_of_light(double light) {
    const auto between = [at = std::clamp(light, 0.0, 1.0)](double dark, double bright) {
        return static_cast<std::uint8_t>(std::lround(dark + at * (bright - dark)));
    };
    return {between(25.0, 255.0), between(35.0, 225.0), between(110.0, 90.0), 255};
}

class SenseDrawer {
public:
    SenseDrawer(double scale, SenseDrawing& drawing) : scale_(scale), drawing_(drawing) {}

    /// Begins a group of vertices; groups that stay empty are dropped.
    void begin(SensePrimitive primitive, double diameter) {
        end();
        drawing_.groups.push_back(
            {primitive, drawing_.vertices.size(), 0, static_cast<float>(diameter)});
    }
    void end() {
        if (drawing_.groups.empty()) {
            return;
        }
        SenseGroup& last = drawing_.groups.back();
        last.count = drawing_.vertices.size() - last.first;
        if (last.count == 0) {
            drawing_.groups.pop_back();
        }
    }
    /// Adds a vertex. `place`: in m, before scaling by SensedPlant::scale.
    void add(const glm::dvec3& place, const SenseColour& colour) {
        drawing_.vertices.push_back({glm::vec3(scale_ * place), colour});
    }

private:
    double scale_;
    SenseDrawing& drawing_;
};

glm::dvec3 point_of(const Vector3& place) {
    return {place[0], place[1], place[2]};
}

glm::dvec3 point_of(const std::array<float, 3>& place) {
    return {static_cast<double>(place[0]), static_cast<double>(place[1]),
            static_cast<double>(place[2])};
}

/// Middle and radius of a ball that contains the plant and the obstacles of kind Mesh.
struct SenseExtent {
    glm::dvec3 middle{};
    double radius = 1.0; // m
};

/// `bounds`: of the plant as drawn. The result is in m, before scaling by SensedPlant::scale.
SenseExtent extent_of(const SensedPlant& plant, const Bounds& bounds) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    const auto add = [&](const glm::dvec3& place) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    };
    if (!bounds.empty) {
        add(glm::dvec3(bounds.low) / plant.scale);
        add(glm::dvec3(bounds.high) / plant.scale);
    }
    for (const SensedPart& part : plant.parts) {
        for (const EnvironmentMesh& mesh : part.meshes) {
            for (const Vector3& vertex : mesh.vertices) {
                add(point_of(vertex));
            }
        }
    }
    const double radius = 0.5 * glm::distance(low, high);
    return radius > 0.0 && std::isfinite(radius) ? SenseExtent{0.5 * (low + high), radius}
                                                 : SenseExtent{};
}

/// Adds a square of a plane as two triangles, around the point of the plane nearest to the middle
/// of `extent`.
void add_plane(const std::array<float, 4>& plane,
               const SenseExtent& extent,
               const glm::dvec3& by,
               SenseDrawer& drawer) {
    constexpr double kReach = 3.0; // in radii of the extent
    const glm::dvec3 normal(plane[0], plane[1], plane[2]);
    const double square = glm::dot(normal, normal);
    const double offset = static_cast<double>(plane[3]) - glm::dot(normal, by);
    const glm::dvec3 foot =
        extent.middle - (glm::dot(normal, extent.middle) + offset) / square * normal;
    const glm::dvec3 axis =
        std::abs(normal.y) < 0.9 * std::sqrt(square) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const double reach = kReach * extent.radius;
    const glm::dvec3 u = reach * glm::normalize(glm::cross(normal, axis));
    const glm::dvec3 v = reach * glm::normalize(glm::cross(normal, u));
    for (const glm::dvec3& corner : {-u - v, u - v, u + v, -u - v, u + v, v - u}) {
        drawer.add(foot + corner, kObstacleColour);
    }
}

/// Adds the obstacles of an environment as triangles.
void add_obstacles(const SensedPart& part,
                   const SenseExtent& extent,
                   const std::vector<EnvironmentMove>& moves,
                   SenseDrawer& drawer) {
    const glm::dvec3 by = point_of(move_of(moves, part.name));
    for (const std::array<float, 4>& plane : part.planes) {
        add_plane(plane, extent, by, drawer);
    }
    for (const EnvironmentMesh& mesh : part.meshes) {
        for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) {
                drawer.add(point_of(mesh.vertices[corner]) + by, kObstacleColour);
            }
        }
    }
}

void add_light(const SensedPart& part, double scale, SenseDrawer& drawer) {
    constexpr double kPart = 0.6; // diameter of a point / edge of a voxel
    if (part.kind == EnvironmentKind::Shadow) {
        double most = 1.0; // max light of a voxel, at least 1; a voxel without shadow may have more
        for (const SensedVoxel& voxel : part.voxels) {
            most = std::max(most, voxel.value);
        }
        drawer.begin(SensePrimitive::Points, kPart * scale * part.cell);
        for (const SensedVoxel& voxel : part.voxels) {
            drawer.add(point_of(voxel.middle), colour_of_light(voxel.value / most));
        }
    } else if (part.kind == EnvironmentKind::Sky) {
        drawer.begin(SensePrimitive::Points, 0.5 * kPart * scale * part.cell);
        for (const SensedModule& module : part.modules) {
            drawer.add(point_of(module.place.position),
                       colour_of_light(static_cast<double>(module.answer.front())));
        }
    }
}

/// Adds an arrow that begins at `from` and points along the unit vector `along`.
void add_arrow(const glm::dvec3& from,
               const glm::dvec3& along,
               double length,
               const SenseColour& colour,
               SenseDrawer& drawer) {
    const glm::dvec3 tip = from + length * along;
    const glm::dvec3 axis = std::abs(along.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 side = 0.12 * length * glm::normalize(glm::cross(along, axis));
    const glm::dvec3 neck = from + 0.7 * length * along;
    for (const glm::dvec3& end : {from, neck + side, neck - side}) {
        drawer.add(end, colour);
        drawer.add(tip, colour);
    }
}

void add_directions(const SensedPart& part,
                    double length,
                    const SenseColour& colour,
                    SenseDrawer& drawer) {
    if (answer_size(part.kind) != 4) {
        return;
    }
    for (const SensedModule& module : part.modules) {
        const glm::dvec3 along(module.answer[1], module.answer[2], module.answer[3]);
        if (along != glm::dvec3(0.0)) {
            add_arrow(point_of(module.place.position), along, length, colour, drawer);
        }
    }
}

/// The parameter of the ray where it meets a triangle (Möller and Trumbore 1997); infinite if it
/// misses the triangle.
double distance_to(const Ray& ray, const LineVertex* corners) {
    const glm::dvec3 base(corners[0].position);
    const glm::dvec3 u = glm::dvec3(corners[1].position) - base;
    const glm::dvec3 v = glm::dvec3(corners[2].position) - base;
    const glm::dvec3 p = glm::cross(ray.direction, v);
    const double determinant = glm::dot(u, p);
    const glm::dvec3 from = ray.origin - base;
    const glm::dvec3 q = glm::cross(from, u);
    const double a = glm::dot(from, p) / determinant;
    const double b = glm::dot(ray.direction, q) / determinant;
    const double distance = glm::dot(v, q) / determinant;
    const bool is_inside = a >= 0.0 && b >= 0.0 && a + b <= 1.0; // false for NaN
    return is_inside && distance > 0.0 ? distance : std::numeric_limits<double>::infinity();
}

} // namespace

Result<SenseLook> parse_senses(std::string_view text) {
    if (text == "all") {
        return SenseLook{true, true, true, true};
    }
    SenseLook look;
    look.obstacles = false;
    for (std::string_view left = text; text != "none";) {
        const std::size_t comma = left.find(',');
        const std::string_view word = left.substr(0, comma);
        const auto* const found =
            std::find_if(kSenseWords.begin(), kSenseWords.end(),
                         [word](const SenseWord& each) { return each.word == word; });
        if (found == kSenseWords.end()) {
            return Error{fmt::format("`{}` is not a sense; write `all`, `none` or a list of "
                                     "`obstacles`, `light`, `markers` and `directions`",
                                     word)};
        }
        look.*(found->shown) = true;
        if (comma == std::string_view::npos) {
            break;
        }
        left.remove_prefix(comma + 1);
    }
    return look;
}

std::string to_text(const SenseLook& look) {
    std::string text;
    for (const SenseWord& each : kSenseWords) {
        if (look.*(each.shown)) {
            text += (text.empty() ? "" : ",") + std::string(each.word);
        }
    }
    return text.empty() ? "none" : text;
}

std::array<float, 3> move_of(const std::vector<EnvironmentMove>& moves, std::string_view name) {
    const auto found =
        std::find_if(moves.begin(), moves.end(),
                     [name](const EnvironmentMove& each) { return each.name == name; });
    return found == moves.end() ? std::array<float, 3>{} : found->by;
}

void set_move(std::string_view name,
              const std::array<float, 3>& by,
              std::vector<EnvironmentMove>& moves) {
    std::erase_if(moves, [name](const EnvironmentMove& each) { return each.name == name; });
    if (by != std::array<float, 3>{}) {
        moves.push_back({std::string(name), by});
    }
}

SenseDrawing make_sense_drawing(const SensedPlant& plant,
                                const SenseLook& look,
                                const std::vector<EnvironmentMove>& moves,
                                const Bounds& bounds) {
    // Lengths of arrows, as fractions of the diagonal of the plant. A few arrows are long; many
    // arrows are short, to leave room for each other.
    constexpr double kShortestArrow = 0.04;
    constexpr double kLongestArrow = 0.3;
    constexpr double kMarkerPart = 0.006; // size of a marker, as a fraction of that diagonal
    const SenseExtent extent = extent_of(plant, bounds);
    const double diagonal =
        bounds.empty ? 2.0 * extent.radius
                     : static_cast<double>(glm::distance(bounds.low, bounds.high)) / plant.scale;
    SenseDrawing drawing;
    SenseDrawer drawer(plant.scale, drawing);
    for (std::size_t i = 0; i < plant.parts.size(); ++i) {
        const SensedPart& part = plant.parts[i];
        if (look.light) {
            add_light(part, plant.scale, drawer);
        }
        if (look.markers) {
            drawer.begin(SensePrimitive::Points, kMarkerPart * plant.scale * diagonal);
            for (const Vector3& marker : part.markers) {
                drawer.add(point_of(marker), kMarkerColour);
            }
        }
        if (look.directions) {
            drawer.begin(SensePrimitive::Lines, 0.0);
            const double spread = 0.5 / std::cbrt(static_cast<double>(part.modules.size()));
            add_directions(part, std::clamp(spread, kShortestArrow, kLongestArrow) * diagonal,
                           kArrowColours[i % kArrowColours.size()], drawer);
        }
    }
    drawer.begin(SensePrimitive::Triangles, 0.0);
    for (const SensedPart& part : plant.parts) {
        if (look.obstacles) {
            add_obstacles(part, extent, moves, drawer);
        }
    }
    drawer.end();
    return drawing;
}

std::optional<ObstacleHit> first_obstacle(const SensedPlant& plant,
                                          const std::vector<EnvironmentMove>& moves,
                                          const Bounds& bounds,
                                          const Ray& ray) {
    const SenseExtent extent = extent_of(plant, bounds);
    std::optional<ObstacleHit> first;
    for (const SensedPart& part : plant.parts) {
        SenseDrawing drawing;
        SenseDrawer drawer(plant.scale, drawing);
        add_obstacles(part, extent, moves, drawer);
        for (std::size_t i = 0; i + 2 < drawing.vertices.size(); i += 3) {
            const double distance = distance_to(ray, drawing.vertices.data() + i);
            if (std::isfinite(distance) && (!first || distance < first->distance)) {
                first = ObstacleHit{part.name, distance};
            }
        }
    }
    return first;
}

} // namespace lsys::view
