// SPDX-License-Identifier: MIT
// Lines: skeleton and turtle path as coloured lines.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace lsys::view {

enum class LineKind : std::uint8_t {
    None,
    Skeleton,   // segments, coloured by branching order; outlines of polygons
    TurtlePath, // segments, coloured by time; jumps of the turtle in grey
};

struct LineVertex {
    glm::vec3 position{};
    std::array<std::uint8_t, 4> colour{}; // sRGB
};

/// Makes the lines: two vertices for each line.
[[nodiscard]] std::vector<LineVertex> make_lines(const Skeleton& skeleton, LineKind kind);

} // namespace lsys::view
