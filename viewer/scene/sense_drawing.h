// SPDX-License-Identifier: MIT
// SenseDrawing: what a plant senses, as coloured triangles, lines and points. viewer/gl draws it
// within the picture, so that the plant hides what is behind it.
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

/// Consecutive vertices of one kind.
struct SenseGroup {
    SensePrimitive primitive = SensePrimitive::Triangles;
    std::size_t first = 0; // index in SenseDrawing::vertices
    std::size_t count = 0;
    float diameter = 0.0F; // m, diameter of points
};

struct SenseDrawing {
    std::vector<LineVertex> vertices;
    std::vector<SenseGroup> groups; // in the order of drawing: triangles are last
};

} // namespace lsys::view
