// SPDX-License-Identifier: MIT
#include "tests/reference/environments/space.h"

#include "tests/reference/environments/exact.h"
#include "tests/reference/philox.h"

#include <algorithm>

namespace lsys::reference {

namespace {

constexpr std::uint32_t kGenerationOfMarkers = 0xFFFFFFFD;

struct Box {
    Vector low{};
    Vector high{};
};

Box box_of(const Space& space) {
    Box box;
    if (space.shape == Shape::Mesh) {
        box = {space.mesh[0][0], space.mesh[0][0]};
        for (const Triangle& triangle : space.mesh) {
            for (const Vector& corner : triangle) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    box.low[axis] = std::min(box.low[axis], corner[axis]);
                    box.high[axis] = std::max(box.high[axis], corner[axis]);
                }
            }
        }
        return box; // that of the mesh before it is moved by `at`
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double half = space.size[axis] / 2;
        box.low[axis] = axis == 1 ? space.at[axis] : space.at[axis] - half;
        box.high[axis] = space.at[axis] + (axis == 1 ? space.size[axis] : half);
    }
    return box;
}

// Whether the point of the box with these draws is inside the shape.
bool holds(const Space& space, const Surface& mesh, const Vector& draws, const Vector& point) {
    const double x = 2 * draws[0] - 1;
    const double y = 2 * draws[1] - 1;
    const double z = 2 * draws[2] - 1;
    switch (space.shape) {
    case Shape::Ball:
        return x * x + y * y + z * z <= 1;
    case Shape::Dome:
        return x * x + draws[1] * draws[1] + z * z <= 1;
    case Shape::Cone:
        return x * x + z * z <= (1 - draws[1]) * (1 - draws[1]);
    case Shape::Mesh:
        return winding_number(mesh, point) != 0;
    default:
        return true;
    }
}

} // namespace

Markers::Markers(const Space& space, std::uint64_t seed, std::uint32_t number)
    : space_(space), cosine_(sine_cosine_of_degrees(space.angle / 2).cosine) {
    const Box box = box_of(space);
    const Surface mesh = space.shape == Shape::Mesh ? oriented(space.mesh) : Surface{};
    const PhiloxKey key = {static_cast<std::uint32_t>(seed),
                           static_cast<std::uint32_t>(seed >> 32U)};
    for (std::uint64_t m = 0; m < 64 * std::uint64_t{space.count}; ++m) {
        const PhiloxCounter words =
            philox4x32_10({static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(m >> 32U),
                           kGenerationOfMarkers, number},
                          key);
        Vector draws{};
        Vector point{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            draws[axis] = static_cast<double>(words[axis] >> 8U) * std::exp2(-24.0);
            point[axis] = box.low[axis] + draws[axis] * (box.high[axis] - box.low[axis]);
        }
        if (!holds(space, mesh, draws, point)) {
            continue;
        }
        if (space.shape == Shape::Mesh) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                point[axis] += space.at[axis];
            }
        }
        markers_.push_back(point);
        m |= 63U; // of each 64 drawn points, the first one inside the shape is a marker
    }
}

bool Markers::sees(const Place& place, const Vector& marker) const {
    const Vector way = difference(marker, place.position);
    const double squared = dot(way, way);
    if (squared > space_.radius * space_.radius) {
        return false;
    }
    return space_.angle == 360 || squared == 0 ||
           dot(place.heading, way) >= cosine_ * std::sqrt(squared);
}

// The index of the nearest place that sees the marker; the number of places if none does.
std::size_t Markers::owner_of(const Vector& marker, const std::vector<Place>& places) const {
    std::size_t owner = places.size();
    double least = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vector way = difference(marker, places[i].position);
        const double squared = dot(way, way);
        if (sees(places[i], marker) && (owner == places.size() || squared < least)) {
            owner = i;
            least = squared;
        }
    }
    return owner;
}

Answers Markers::answers(const std::vector<Place>& places) {
    std::erase_if(markers_, [&](const Vector& marker) {
        return std::any_of(places.begin(), places.end(), [&](const Place& place) {
            const Vector way = difference(marker, place.position);
            return dot(way, way) < space_.kill * space_.kill;
        });
    });
    std::vector<double> counts(places.size());
    std::vector<Vector> sums(places.size());
    for (const Vector& marker : markers_) {
        const std::size_t owner = owner_of(marker, places);
        if (owner == places.size()) {
            continue;
        }
        const Vector towards = unit(difference(marker, places[owner].position));
        counts[owner] += 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sums[owner][axis] += towards[axis];
        }
    }
    Answers answers;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Vector mean{};
        for (std::size_t axis = 0; axis < 3 && counts[i] > 0; ++axis) {
            mean[axis] = sums[i][axis] / counts[i];
        }
        mean = unit(mean);
        answers.push_back({counts[i], mean[0], mean[1], mean[2]});
    }
    return answers;
}

} // namespace lsys::reference
