// SPDX-License-Identifier: MIT
// Places of a scene on the Earth: the WGS 84 ellipsoid (NGA.STND.0036), without a map projection.
#pragma once

#include "runtime/terrain/region.h"
#include "runtime/tiles/tiles.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace lsys {

/// Earth-centred, Earth-fixed coordinates in m.
[[nodiscard]] glm::dvec3 earth_fixed(const GeoPlace& place);
/// The end of the geodesic of `distance` m that leaves `start` in the direction (east, north),
/// which has length 1. The end has the height of `start`. The error is below 0.1 mm for 1,000 km.
/// Source: Vincenty 1975, "Direct and inverse solutions of geodesics on the ellipsoid", direct
/// formula.
[[nodiscard]] GeoPlace
along_geodesic(const GeoPlace& start, double east, double north, double distance);

/// Maps the scene (x east, y up, z south, in m) to the coordinates of the tileset, which has +Z up.
class GroundFrame {
public:
    /// `origin`: the place of the scene's origin (0, 0, 0), at its ellipsoidal height. The scene's
    /// ground then follows the ellipsoid: distances and directions from the origin are those of
    /// geodesics. nullopt: the tileset has the scene's coordinates, turned to +Z up.
    explicit GroundFrame(const std::optional<GeoPlace>& origin) : origin_(origin) {}

    /// Whether the ground follows the ellipsoid.
    [[nodiscard]] bool is_curved() const { return origin_.has_value(); }
    /// The point (x, y, z) of the scene, in the coordinates of the tileset.
    [[nodiscard]] glm::dvec3 place(double x, double y, double z) const;
    /// The frame with axes east, north and up at the point (x, 0, z) of the scene, as a matrix to
    /// the coordinates of the tileset. Each tile has such a frame at its middle.
    [[nodiscard]] glm::dmat4 frame(double x, double z) const;

private:
    [[nodiscard]] GeoPlace geographic(double x, double z) const; // only with an origin

    std::optional<GeoPlace> origin_;
};

/// Maps points of the scene near a tile to the frame of the tile. On the ellipsoid, places in a
/// tile of up to kMaxInterpolatedSide are interpolated from nine points, with an error below 2 mm.
class TileFrame {
public:
    /// `to_tile`: matrix from the coordinates of the tileset to the frame of the tile. `earth` must
    /// outlive the object.
    TileFrame(const GroundFrame& earth, const glm::dmat4& to_tile, const Region& region);

    struct Place {
        glm::dvec3 foot{0.0}; // m, in the frame of the tile, of the point (x, 0, z)
        glm::dvec3 up{0.0};   // change of the place per m of altitude
    };
    /// The place of the point (x, 0, z) of the scene.
    [[nodiscard]] Place at(double x, double z) const;
    /// The point (x, y, z) of the scene, in the frame of the tile.
    [[nodiscard]] glm::dvec3 place(double x, double y, double z) const;

private:
    static constexpr std::size_t kNodes = 3; // along each side

    [[nodiscard]] glm::dvec3 exact(double x, double y, double z) const; // not interpolated
    [[nodiscard]] Place exact_place(double x, double z) const;          // not interpolated

    const GroundFrame& earth_;
    glm::dmat4 to_tile_;
    Region region_;
    bool is_interpolated_ = false;
    std::array<Place, kNodes * kNodes> nodes_; // rows along X
};
inline constexpr double kMaxInterpolatedSide = 20e3; // m

/// The inverse of a frame, whose axes are perpendicular and of length 1.
[[nodiscard]] glm::dmat4 inverse_of_frame(const glm::dmat4& frame);

} // namespace lsys
