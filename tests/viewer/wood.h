// SPDX-License-Identifier: MIT
// Wood: a small forest for tests of draw lists and pictures.
#pragma once

#include "viewer/scene/forest_lod.h"

#include <cstdint>
#include <memory>

namespace lsys::tests {

/// Trees of one species on a square of ground.
struct Wood {
    Forest forest;
    std::unique_ptr<Terrain> terrain;
    view::ForestModel model;
};

/// A wood on level ground. `side`: side of the square in m.
[[nodiscard]] std::unique_ptr<Wood> make_wood(std::uint32_t count, float side);
/// A wood on hills. `side`: side of the square in m.
[[nodiscard]] std::unique_ptr<Wood> make_wood_on_hills(std::uint32_t count, float side);
/// Hills 30 m high and 120 m apart, on a square of `side` m at the origin.
[[nodiscard]] Terrain hills(float side);
/// Options with which all LOD bands occur in pictures of 640 by 480 pixels.
[[nodiscard]] view::LodOptions wood_lod();

} // namespace lsys::tests
