// SPDX-License-Identifier: MIT
// SenseDrawing: what a plant senses as coloured triangles, lines and points. Drawn by viewer/gl
// within the picture: the plant hides what lies behind it.
#pragma once

#include "viewer/scene/lines.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys::view {

enum class SensePrimitive : std::uint8_t {
    Triangles, // surfaces, transparent by the alpha of their colour
    Lines,
    Points, // discs of `diameter`
};

/// Vertices of one kind, next to each other.
struct SenseGroup {
    SensePrimitive primitive = SensePrimitive::Triangles;
    std::size_t first = 0; // in SenseDrawing::vertices
    std::size_t count = 0;
    float diameter = 0.0F; // m, of points
};

struct SenseDrawing {
    std::vector<LineVertex> vertices;
    std::vector<SenseGroup> groups; // in the order in which they are drawn: triangles last
};

} // namespace lsys::view
