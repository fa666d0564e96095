// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/thinning.h"

#include "runtime/base/random.h"
#include "runtime/meshing/impl/directions.h"
#include "runtime/meshing/shapes.h"
#include "runtime/turtle/organs.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace lsys {

namespace {

constexpr std::uint64_t kSeed = 0x7468696E; // fixed: the order depends on no seed of the user
// Argument `block` of draw_block().
constexpr std::uint32_t kPathBlock = 0;    // for paths
constexpr std::uint32_t kFoliageBlock = 1; // for foliage
constexpr int kWideningSteps = 40;         // halvings of the interval of the radius

std::uint32_t random_word(std::uint64_t number, std::uint32_t block) {
    return draw_block(kSeed, kStartGeneration, number, block)[0];
}

void order_paths(const Skeleton& skeleton, ThinningOrder& order) {
    const std::size_t count = skeleton.segments.size();
    std::vector<double> areas(count, 0.0);   // outline area of a segment and its descendants
    std::vector<double> reaches(count, 0.0); // length of the longest path through a child
    std::vector<std::uint32_t> path_children(count,
                                             kNoSegment); // the child that continues the path
    for (std::size_t i = count; i-- > 0;) {
        const Segment& segment = skeleton.segments[i];
        areas[i] += outline_area(segment);
        const double reach = reaches[i] + static_cast<double>(segment.length);
        if (segment.parent < i) {
            areas[segment.parent] += areas[i];
            if (path_children[segment.parent] == kNoSegment || reach >= reaches[segment.parent]) {
                reaches[segment.parent] = reach;
                path_children[segment.parent] = static_cast<std::uint32_t>(i);
            }
        }
    }
    struct Path {
        double area = 0.0;        // outline area of the path and its branches
        std::uint32_t order = 0;  // number of ancestors
        std::uint32_t random = 0; // decides between equal paths
        std::uint32_t number = 0; // number of the path before sorting
    };
    std::vector<Path> paths;
    order.path_ranks.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = skeleton.segments[i].parent;
        if (parent < i && path_children[parent] == i) {
            order.path_ranks[i] = order.path_ranks[parent];
            continue;
        }
        order.path_ranks[i] = static_cast<std::uint32_t>(paths.size());
        paths.push_back({.area = areas[i],
                         .order = parent < i ? paths[order.path_ranks[parent]].order + 1 : 0,
                         .random = random_word(i, kPathBlock),
                         .number = static_cast<std::uint32_t>(paths.size())});
    }
    // A path has at most as much wood as its parent path; of paths with equal areas the parent
    // comes first.
    std::sort(paths.begin(), paths.end(), [](const Path& a, const Path& b) {
        return std::tie(b.area, a.order, a.random, a.number) <
               std::tie(a.area, b.order, b.random, b.number);
    });
    std::vector<std::uint32_t> ranks(paths.size());
    for (std::size_t rank = 0; rank < paths.size(); ++rank) {
        ranks[paths[rank].number] = static_cast<std::uint32_t>(rank);
        order.path_orders.push_back(
            static_cast<std::uint16_t>(std::min<std::uint32_t>(paths[rank].order, 0xFFFF)));
    }
    for (std::uint32_t& rank : order.path_ranks) {
        rank = ranks[rank];
    }
}

/// Triangles of an organ, with about two steps between points.
std::uint64_t estimated_triangles(std::span<const OrganPoint> points) {
    constexpr std::uint64_t kTrianglesPerSide = 4;
    return kTrianglesPerSide * (points.size() - 1) * usable_sides(points.front().sides);
}

void order_foliage(const Skeleton& skeleton, ThinningOrder& order) {
    using Key = std::tuple<bool, std::uint8_t, std::uint32_t, ItemColour>;
    std::map<Key, std::uint32_t> numbers;
    const std::size_t objects = skeleton.objects.size();
    const std::size_t count = objects + skeleton.polygons.size();
    order.group_of.resize(count);
    std::vector<std::uint64_t> sizes;
    for (std::size_t i = 0; i < count; ++i) {
        FoliageGroup group;
        Key key;
        if (i < objects) {
            const PlacedObject& object = skeleton.objects[i];
            group = {.kind = object.kind, .mesh_file = object.mesh_file};
            if (is_organ(object)) { // all organs of a colour are a group
                group.mesh_file = 0;
                group.organ_triangles = estimated_triangles(points_of(skeleton, object));
            }
            key = {false, static_cast<std::uint8_t>(object.kind), group.mesh_file, object.colour};
        } else {
            const Polygon& polygon = skeleton.polygons[i - objects];
            group.is_polygons = true;
            key = {true, std::uint8_t{0}, polygon.picture, polygon.colour};
        }
        const auto [place, is_new] =
            numbers.try_emplace(key, static_cast<std::uint32_t>(order.groups.size()));
        if (is_new) {
            order.groups.push_back(group);
            sizes.push_back(0);
        }
        order.group_of[i] = place->second;
        ++sizes[place->second];
    }
    // The items of a group are in random order. Item::place is the fraction of the items of its
    // group that come before it; sorting all items by `place` mixes the groups evenly.
    struct Item {
        std::uint32_t group = 0;
        std::uint32_t random = 0;
        std::uint32_t number = 0;
        double place = 0.0;
    };
    std::vector<Item> items(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        items[i] = {
            .group = order.group_of[i], .random = random_word(i, kFoliageBlock), .number = i};
    }
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
        return std::tie(a.group, a.random, a.number) < std::tie(b.group, b.random, b.number);
    });
    std::uint64_t within = 0;
    for (std::size_t i = 0; i < count; ++i) {
        within = i > 0 && items[i].group == items[i - 1].group ? within + 1 : 0;
        items[i].place =
            (static_cast<double>(within) + 0.5) / static_cast<double>(sizes[items[i].group]);
    }
    std::sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
        return std::tie(a.place, a.number) < std::tie(b.place, b.number);
    });
    order.foliage.resize(count);
    for (std::size_t rank = 0; rank < count; ++rank) {
        order.foliage[rank] = items[rank].number;
    }
}

double triangle_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return 0.5 *
           glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
}

double polygon_area(std::span<const glm::vec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 2; i < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i - 1]) - glm::dvec3(corners[0]),
                          glm::dvec3(corners[i]) - glm::dvec3(corners[0]));
    }
    return 0.5 * glm::length(sum);
}

/// The radius, at most `max`, up to which thinner wood of `thin` is widened so that the outline
/// areas of all wood add up to `area`.
double widening_radius(const Skeleton& thin, double area, double max) {
    const auto area_at = [&](double radius) {
        double sum = 0.0;
        for (const Segment& segment : thin.segments) {
            sum +=
                std::max(outline_area(segment), 2.0 * radius * static_cast<double>(segment.length));
        }
        return sum;
    };
    if (area_at(max) <= area) {
        return max;
    }
    double low = 0.0;
    double high = max;
    for (int i = 0; i < kWideningSteps; ++i) {
        const double middle = 0.5 * (low + high);
        (area_at(middle) <= area ? low : high) = middle;
    }
    return low;
}

/// Copies the segments that stay to `thin`. The bracket order of a segment becomes the order of its
/// path, so that a path becomes one tube. `places`: for each segment its number in `thin`, or the
/// number of the nearest ancestor that stays.
void thin_wood(const Skeleton& skeleton,
               const ThinningOrder& order,
               const Thinning& thinning,
               std::vector<std::uint32_t>& places,
               Skeleton& thin,
               LargeVector<std::uint32_t>& segments) {
    double area = 0.0;
    places.assign(skeleton.segments.size(), kNoSegment);
    for (std::uint32_t i = 0; i < skeleton.segments.size(); ++i) {
        const Segment& segment = skeleton.segments[i];
        area += outline_area(segment);
        const std::uint32_t parent = segment.parent < i ? places[segment.parent] : kNoSegment;
        if (order.path_ranks[i] >= thinning.paths) {
            places[i] = parent;
            continue;
        }
        places[i] = static_cast<std::uint32_t>(thin.segments.size());
        Segment& kept = thin.segments.emplace_back(segment);
        kept.parent = parent;
        if (thinning.paths < order.path_count()) {
            kept.order = order.path_orders[order.path_ranks[i]];
        }
        segments.push_back(i);
    }
    float radius = 0.0F;
    if (thinning.paths < order.path_count()) {
        radius = static_cast<float>(
            widening_radius(thin, area, static_cast<double>(thinning.max_radius)));
    }
    const auto widen = [&](float own) {
        return thinning.wood_scale * (own > 0.0F ? std::max(own, radius) : own);
    };
    for (Segment& segment : thin.segments) {
        segment.base_radius = widen(segment.base_radius);
        segment.tip_radius = widen(segment.tip_radius);
    }
}

/// For each group the factor of size with which the items that stay have the area of all items.
std::vector<float> growth_of(const Skeleton& skeleton,
                             const ThinningOrder& order,
                             std::uint64_t kept,
                             std::span<const FoliageShape> fine,
                             std::span<const FoliageShape> coarse) {
    std::vector<double> total_area(order.groups.size(), 0.0);
    std::vector<double> kept_area(order.groups.size(), 0.0);
    for (std::size_t rank = 0; rank < order.foliage.size(); ++rank) {
        const std::uint32_t item = order.foliage[rank];
        const std::uint32_t group = order.group_of[item];
        double area = 1.0;
        double coarse_area = 1.0;
        if (order.groups[group].is_polygons) {
            const Polygon& polygon = skeleton.polygons[item - skeleton.objects.size()];
            area = polygon_area(
                std::span(skeleton.corners).subspan(polygon.first_corner, polygon.corner_count));
            coarse_area = area;
        } else {
            const PlacedObject& object = skeleton.objects[item];
            const auto size = static_cast<double>(object.size);
            const bool organ = is_organ(object);
            area = organ ? organ_area(skeleton, object) : size * size * fine[group].area;
            coarse_area = organ ? area : size * size * coarse[group].area;
        }
        total_area[group] += area;
        kept_area[group] += rank < kept ? coarse_area : 0.0;
    }
    // The area of groups without remaining items is divided among all other groups.
    const double sum_of_areas = std::accumulate(total_area.begin(), total_area.end(), 0.0);
    double represented = 0.0;
    for (std::size_t group = 0; group < total_area.size(); ++group) {
        represented += kept_area[group] > 0.0 ? total_area[group] : 0.0;
    }
    const double share = represented > 0.0 ? sum_of_areas / represented : 1.0;
    std::vector<float> factors(order.groups.size(), 1.0F);
    for (std::size_t group = 0; group < total_area.size(); ++group) {
        if (kept_area[group] > 0.0) {
            factors[group] =
                static_cast<float>(std::sqrt(share * total_area[group] / kept_area[group]));
        }
    }
    return factors;
}

void add_polygon(const Skeleton& skeleton,
                 std::uint32_t number,
                 float factor,
                 std::span<const std::uint32_t> places,
                 Skeleton& thin) {
    Polygon polygon = skeleton.polygons[number];
    const std::span<const glm::vec3> corners =
        std::span(skeleton.corners).subspan(polygon.first_corner, polygon.corner_count);
    polygon.first_corner = static_cast<std::uint32_t>(thin.corners.size());
    polygon.parent = polygon.parent < places.size() ? places[polygon.parent] : kNoSegment;
    thin.polygons.push_back(polygon);
    glm::dvec3 centre(0.0);
    for (const glm::vec3& corner : corners) {
        centre += glm::dvec3(corner);
    }
    centre /= static_cast<double>(corners.size());
    for (const glm::vec3& corner : corners) {
        thin.corners.push_back(
            glm::vec3(centre + static_cast<double>(factor) * (glm::dvec3(corner) - centre)));
    }
}

} // namespace

double outline_area(const Segment& segment) {
    return static_cast<double>(segment.length) *
           (static_cast<double>(segment.base_radius) + static_cast<double>(segment.tip_radius));
}

ThinningOrder thinning_order(const Skeleton& skeleton) {
    ThinningOrder order;
    order_paths(skeleton, order);
    order_foliage(skeleton, order);
    return order;
}

std::vector<FoliageShape> foliage_shapes(const ThinningOrder& order,
                                         const std::vector<UserMesh>& user_meshes,
                                         std::uint32_t level) {
    std::vector<FoliageShape> shapes(order.groups.size());
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const FoliageGroup& group = order.groups[i];
        if (group.organ_triangles != 0) {
            shapes[i].triangles = std::max<std::uint64_t>(4, group.organ_triangles >> 2 * level);
            continue;
        }
        const bool is_file = group.kind == TurtleOperation::MeshFile;
        if (group.is_polygons || (is_file && group.mesh_file >= user_meshes.size())) {
            continue;
        }
        const Shape shape =
            is_file ? make_shape(user_meshes[group.mesh_file]) : make_shape(group.kind, level);
        glm::dvec3 centre(0.0);
        for (const ShapePart& part : shape.parts) {
            shapes[i].triangles += part.indices.size() / 3;
            for (std::size_t k = 0; k + 2 < part.indices.size(); k += 3) {
                const glm::vec3& a = part.positions[part.indices[k]];
                const glm::vec3& b = part.positions[part.indices[k + 1]];
                const glm::vec3& c = part.positions[part.indices[k + 2]];
                const double area = triangle_area(a, b, c);
                shapes[i].area += area;
                centre += area / 3.0 * (glm::dvec3(a) + glm::dvec3(b) + glm::dvec3(c));
            }
        }
        shapes[i].centre =
            shapes[i].area > 0.0 ? glm::vec3(centre / shapes[i].area) : glm::vec3(0.0F);
    }
    return shapes;
}

void thin_skeleton(const Skeleton& skeleton,
                   const ThinningOrder& order,
                   const Thinning& thinning,
                   std::span<const FoliageShape> fine,
                   std::span<const FoliageShape> coarse,
                   Skeleton& thin,
                   LargeVector<std::uint32_t>& segments) {
    thin = {};
    segments.clear();
    thin.mesh_files = skeleton.mesh_files;
    thin.looks = skeleton.looks;
    thin.contours = skeleton.contours;
    thin.leaf_droop = skeleton.leaf_droop;
    thin.tube_shape = skeleton.tube_shape;
    std::vector<std::uint32_t> places;
    thin_wood(skeleton, order, thinning, places, thin, segments);
    const std::uint64_t kept = std::min<std::uint64_t>(thinning.foliage, order.foliage.size());
    if (kept == 0) {
        return;
    }
    const std::vector<float> factors = growth_of(skeleton, order, kept, fine, coarse);
    std::vector<std::uint32_t> items(order.foliage.begin(),
                                     order.foliage.begin() + static_cast<std::ptrdiff_t>(kept));
    std::sort(items.begin(), items.end()); // in the order of drawing
    const auto objects = static_cast<std::uint32_t>(skeleton.objects.size());
    for (const std::uint32_t item : items) {
        const std::uint32_t group = order.group_of[item];
        const float factor = thinning.foliage_scale * factors[group];
        if (item >= objects) {
            add_polygon(skeleton, item - objects, factor, places, thin);
            continue;
        }
        PlacedObject& object = thin.objects.emplace_back(skeleton.objects[item]);
        copy_organ(skeleton, object, thin);
        object.parent = object.parent < places.size() ? places[object.parent] : kNoSegment;
        const glm::vec3 centre = object.frame * (object.size * fine[group].centre);
        object.size *= factor;
        object.position += centre - object.frame * (object.size * coarse[group].centre);
    }
}

} // namespace lsys
