// SPDX-License-Identifier: MIT
// BoxWriter: rings of four corners and the faces between them. The mesh is closed once every
// segment is closed and every side of a joint is divided.
#pragma once

#include "runtime/meshing/impl/catmull_clark.h"
#include "runtime/turtle/skeleton.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

inline constexpr std::size_t kMaxOnSide = 4; // max children per side of a joint

/// An open square from which a segment grows, seen from outside. Its corners lie at (right, up) =
/// (+, +), (-, +), (-, -), (+, -). Between two corners there may be a vertex of a neighbouring
/// tile.
struct BoxSocket {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
    std::array<std::uint32_t, 4> corners{};
    std::array<std::uint32_t, 4> between{kNone, kNone, kNone, kNone}; // vertex after each corner
    glm::vec3 right{};
    glm::vec3 up{};
    glm::vec3 normal{};
    float reach = 0.0F;     // distance from the base of the segment to the square
    bool continues = false; // the segment is as wide as the square and needs no opening
    float v = 0.0F;         // texture coordinate of the square
};

/// The sides of a joint: sides 0 to 3 lie around it, side 4 is the top.
struct BoxJoint {
    std::array<BoxSocket, 5> sides;
};

/// The shape of a ring in the side of a joint.
struct BoxOpening {
    float reach = 0.0F; // distance from the base of the segment to the farthest corner
    float size = 1.0F;  // as a fraction of the cross-section of the segment, which may not fit
    bool moved = false; // its middle is not on the axis of the segment
};
/// Max size of an opening, as a fraction of the side of the joint or of the tile that contains it.
inline constexpr float kMaxOpening = 0.94F;
/// Fraction of a divided side that its tiles take.
inline constexpr float kInnerPart = 0.85F;

/// The socket with its axes turned by the smallest angle that makes them perpendicular to the unit
/// vector `direction`.
[[nodiscard]] BoxSocket axes_across(const BoxSocket& socket, const glm::vec3& direction);

class BoxWriter {
public:
    /// Begins `segment`, number `number`; `half`: half side of its box at the base.
    void begin_segment(const Segment& segment, std::uint32_t number, float half);
    /// Begins with an end at a distance from the base of the segment. `rim` below 1: the face of
    /// the end has an inner square of this size, which keeps the end flat when it is smoothed.
    void begin_root(float distance, float half, float rim);
    /// Begins at a socket of a joint or of a divided side.
    void begin_at(const BoxSocket& socket);
    /// Adds a ring across `direction`, at a distance from the base of the segment, joined to the
    /// ring or socket before it.
    void add_ring(float distance, const glm::vec3& direction, float half);
    /// Adds a ring in the plane of the socket of begin_at(): the section of this plane with a box
    /// along the unit vector `along`, scaled down if the socket has no room for it.
    BoxOpening add_opening(const glm::vec3& along, float half);
    /// Adds a ring without joining it to the ring before it. The sides of the joint are the four
    /// sides between the two rings, and the new ring as the top.
    [[nodiscard]] BoxJoint add_joint(float distance, const glm::vec3& direction, float half);
    /// The socket for the next segment.
    [[nodiscard]] const BoxSocket& end_socket() const { return end_; }
    /// Closes the end; `rim` as for begin_root().
    void close(float rim);
    /// Divides a side into tiles for segments that grow towards `places`, given in (right, up).
    /// Returns a socket for each segment, valid until the next call. Closes the side if there are
    /// no places.
    [[nodiscard]] std::span<const BoxSocket> divide(const BoxSocket& side,
                                                    std::span<const glm::vec2> places);

    [[nodiscard]] PolygonMesh take();

private:
    /// A part of the side that divide() divides; (right, up) from -1 to 1.
    struct Tile {
        glm::vec2 low;
        glm::vec2 high;
        std::size_t first = 0; // index in tile_order_
        std::size_t count = 0;
    };
    std::uint32_t add_vertex(const glm::vec3& position, float u, float v, float radius);
    void add_face(std::span<const std::uint32_t> corners);
    /// Sets `ring` to a ring of new vertices across `direction`, without faces.
    void place_ring(float distance, const glm::vec3& direction, float half, BoxSocket& ring);
    void join(const BoxSocket& from, const BoxSocket& to); // adds the faces between two rings
    void fade_radii();                                     // ends the grooves at end_
    /// Halves `tile` until each part contains at most one place; adds the parts to tiles_.
    void cut_tiles(const Tile& tile, std::span<const glm::vec2> places);
    /// The vertex at a place within a side; added if it does not exist yet.
    std::uint32_t tile_corner(const BoxSocket& side, const glm::vec2& place);
    /// The face between an edge of a side and its tiles.
    void add_border(const BoxSocket& side, std::size_t edge);

    PolygonMesh mesh_;
    const Segment* segment_ = nullptr;
    std::uint32_t number_ = kNoSegment; // number of segment_
    BoxSocket end_;                     // the ring or socket written last
    float distance_ = 0.0F;             // distance of end_ from the base of the segment
    float v_per_length_ = 0.0F;

    std::vector<std::size_t> tile_order_; // indices of places, by tile
    std::vector<Tile> tiles_;
    std::vector<glm::vec2> tile_corners_;      // corners of the tiles of a side, each once
    std::vector<std::uint32_t> tile_vertices_; // vertex of each of these corners
    std::vector<BoxSocket> sockets_;           // the result of divide()
};

} // namespace lsys
