// SPDX-License-Identifier: MIT
// Environments of kind `space`, computed from every pair of a marker and a place.

#pragma once

#include "tests/reference/environments/place.h"
#include "tests/reference/environments/surface.h"

#include <cstdint>

namespace lsys::reference {

enum class Shape { Box, Ball, Dome, Cone, Mesh };

// The keys of `#sense NAME space` (docs/language.md, section 13.2).
struct Space {
    Shape shape = Shape::Box;
    Surface mesh; // of Shape::Mesh
    Vector size{1, 1, 1};
    Vector at{};
    std::uint32_t count = 0;
    double radius = 0; // m, max distance at which a place sees a marker
    double angle = 90; // degrees
    double kill = 0;   // m, markers nearer than this to a place vanish
};

// The markers of one derivation. Words are answered in the order of their ages.
class Markers {
public:
    // Draws the markers. `number`: index of the environment in the grammar.
    Markers(const Space& space, std::uint64_t seed, std::uint32_t number);

    // For each place: number n of its markers and their mean direction x y z, after markers nearer
    // than `kill` have vanished.
    Answers answers(const std::vector<Place>& places);

    // The markers that are left.
    [[nodiscard]] const std::vector<Vector>& places() const { return markers_; }

private:
    // The index of the nearest place that sees the marker; the number of places if none does.
    [[nodiscard]] std::size_t owner_of(const Vector& marker,
                                       const std::vector<Place>& places) const;
    // Whether the marker is in reach and within the angle of the place.
    [[nodiscard]] bool sees(const Place& place, const Vector& marker) const;

    Space space_;
    double cosine_ = 0; // of half of the angle
    std::vector<Vector> markers_;
};

} // namespace lsys::reference
