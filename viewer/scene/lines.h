// Lines: what the turtle did, drawn without surfaces.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace lsys::view {

enum class LineKind : std::uint8_t {
    None,
    Skeleton,   // segments, coloured by how many brackets are around them; outlines of polygons
    TurtlePath, // segments, coloured by when they were drawn; grey where the turtle jumped
};

struct LineVertex {
    glm::vec3 position{};
    std::array<std::uint8_t, 4> colour{}; // sRGB
};

/// Two vertices for each line.
[[nodiscard]] std::vector<LineVertex> make_lines(const Skeleton& skeleton, LineKind kind);

} // namespace lsys::view
