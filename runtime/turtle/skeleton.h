// SPDX-License-Identifier: MIT
// Skeleton: the drawing of the turtle, without surfaces. Segments, objects and polygons are in the
// order of drawing, so that a parent comes before its children. Metres, kilograms, right-handed
// axes, +Y up. A frame is the unit quaternion that takes the turtle's axes at the start (right +X,
// heading +Y, up +Z) to its axes at the item.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/large_vector.h"
#include "runtime/derive/origin.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsys {

struct Looks; // runtime/meshing/looks.h

inline constexpr std::uint32_t kNoSegment = 0xFFFFFFFFu;

/// The colour of an item: an index up to kMaxColourIndex, whose look a `#material` or the palette
/// defines; or a colour of its own, kOwnColour + red << 16 + green << 8 + blue, in sRGB.
using ItemColour = std::uint32_t;
inline constexpr ItemColour kOwnColour = 0x01000000u;
[[nodiscard]] constexpr bool is_own(ItemColour colour) {
    return colour >= kOwnColour;
}
/// The colour as text: "3", or "#664D33" for a colour of its own.
[[nodiscard]] std::string text_of(ItemColour colour);

/// A straight piece drawn by one module, from `base` by `length` along its frame's +Y.
struct Segment {
    glm::vec3 base{};
    float length = 0.0F; // never negative: segments drawn backwards are reversed
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
    float base_radius = 0.0F;
    float tip_radius = 0.0F;
    float spring = 0.0F;               // N m / rad, of the joint at the base
    float mass = 0.0F;                 // kg
    std::uint32_t parent = kNoSegment; // the segment drawn before it on its path
    ItemColour colour = 0;
    std::uint16_t order = 0;     // number of open brackets around it: 0 is the trunk
    std::uint8_t sides = 0;      // corners of its cross-section, if set by the author; else 0
    bool linked : 1 = false;     // begins where its parent ends
    bool forked : 1 = false;     // branches that the skeleton leaves out begin at its tip
    bool cut : 1 = false;        // begins within its parent, with a closed surface of its own
    std::uint8_t unused : 5 = 0; // so that every bit of a segment has a value
};
static_assert(sizeof(Segment) == 60);

/// An item of the object library, drawn from `position` along the frame's +Y.
struct PlacedObject {
    TurtleOperation kind = TurtleOperation::Nothing; // an operation that places an object
    // Index in Skeleton::mesh_files, for MeshFile; in Skeleton::organs, for SurfaceBegin.
    std::uint32_t mesh_file = 0;
    glm::vec3 position{};
    float size = 1.0F; // scale factor
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
    std::uint32_t parent = kNoSegment; // the segment drawn before it on its path
    ItemColour colour = 0;
    std::uint16_t order = 0; // number of open brackets around it
};

inline constexpr std::uint32_t kNoContour = 0xFFFFFFFFu;

/// The curve of an organ's radius in m over the fraction of the way to the next point: its tangents
/// before and after a point, each a fraction and a radius. A tangent of (0, 0): a straight line.
struct RadiusTangents {
    float part_before = 0.0F;
    float radius_before = 0.0F;
    float part_after = 0.0F;
    float radius_after = 0.0F;
    bool per_chord = false; // in the piece before the point, radius components are in chords, not m
};

/// A point of the axis of an organ (docs/language.md section 15), in the frame of its PlacedObject,
/// at size 1.
struct OrganPoint {
    glm::vec3 position{}; // m
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
    float width = 0.0F;          // m, by which the contour is scaled
    float tangent_before = 1.0F; // length of the tangent before the point / length of the chord
    float tangent_after = 1.0F;  // length of the tangent after the point / length of the chord
    RadiusTangents radii;
    std::uint32_t contour = kNoContour; // index in Skeleton::contours; kNoContour: a circle
    ItemColour colour = 0;
    std::uint8_t sides = 0;
};

/// The axis of an organ: `point_count` items, at least two, of Skeleton::organ_points.
struct Organ {
    std::uint32_t first_point = 0;
    std::uint32_t point_count = 0;
};

inline constexpr std::uint32_t kNoPicture = 0xFFFFFFFFu;

/// A filled polygon. Its corners are `corner_count` items, at least three, of Skeleton::corners.
struct Polygon {
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0;
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F}; // frame of the turtle at `{`
    std::uint32_t parent = kNoSegment;       // the segment drawn before it on its path
    ItemColour colour = 0;
    std::uint32_t picture = kNoPicture; // index in Skeleton::mesh_files
    std::uint16_t order = 0;            // number of open brackets around it
};

/// Shapes of tubes that settings add (docs/language.md section 7.8).
struct TubeShape {
    Flare flare;         // height in m once apply_pipe() and scaling are done
    float collar = 0.0F; // width of a branch at its base, relative to its width above; 0: none
    TipShape tips = TipShape::Flat;

    [[nodiscard]] bool has_flare() const { return flare.factor > 1.0F; }
};

struct Skeleton {
    LargeVector<Segment> segments;
    LargeVector<PlacedObject> objects;
    LargeVector<Polygon> polygons;
    LargeVector<glm::vec3> corners;
    LargeVector<Organ> organs;
    LargeVector<OrganPoint> organ_points;
    std::shared_ptr<const std::vector<BytecodeContour>> contours; // null: none
    std::vector<std::string> mesh_files; // paths of meshes and pictures, as written in the grammar
    std::shared_ptr<const Looks> looks;  // looks of the `#material`s; null: none
    bool l3d_compatible_surface = false; // meshes as the program L3D makes them
    bool box_segments = false;           // MeshMethod::Default draws boxes
    float leaf_droop = 0.0F;             // default of MeshOptions::droop
    TubeShape tube_shape;
    // Origins of the modules that drew the items (for a polygon, its `{`); empty unless the words
    // had origins.
    LargeVector<Origin> segment_origins;
    LargeVector<Origin> object_origins;
    LargeVector<Origin> polygon_origins;

    [[nodiscard]] std::uint64_t byte_count() const {
        return segments.size() * sizeof(Segment) + objects.size() * sizeof(PlacedObject) +
               polygons.size() * sizeof(Polygon) + corners.size() * sizeof(glm::vec3) +
               organs.size() * sizeof(Organ) + organ_points.size() * sizeof(OrganPoint) +
               (segment_origins.size() + object_origins.size() + polygon_origins.size()) *
                   sizeof(Origin);
    }
};

[[nodiscard]] inline glm::vec3 heading(const glm::quat& frame) {
    return frame * glm::vec3(0.0F, 1.0F, 0.0F);
}
[[nodiscard]] inline glm::vec3 tip(const Segment& segment) {
    return segment.base + segment.length * heading(segment.frame);
}

struct Bounds {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};
    bool empty = true;

    void add(const glm::vec3& point) {
        low = empty ? point : glm::min(low, point);
        high = empty ? point : glm::max(high, point);
        empty = false;
    }
};

struct SkeletonStats {
    Bounds bounds;            // bounds of axes, object positions and corners, without radii
    double height = 0.0;      // m, from the lowest to the highest point
    double crown_width = 0.0; // m, twice the max horizontal distance from the start
    double length = 0.0;      // m, sum over all segments
    double volume = 0.0;      // m^3, sum over truncated cones
    double mass = 0.0;        // kg, sum over all segments
    std::vector<std::uint64_t> segments_by_order; // number of segments of each order
};
[[nodiscard]] SkeletonStats measure(const Skeleton& skeleton);

/// Number of lines of the skeleton as text: a line per segment, then per object, then per polygon.
[[nodiscard]] std::uint64_t line_count(const Skeleton& skeleton);
/// Appends a line of the text, with the origin of the item unless `origins` is null.
/// Precondition: line < line_count(); with `origins`, the skeleton has them.
void append_line(const Skeleton& skeleton,
                 std::uint64_t line,
                 OriginPrinter* origins,
                 std::string& text);

} // namespace lsys
