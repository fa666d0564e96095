// SPDX-License-Identifier: MIT
// Plant: the drawing of a word by the turtle, a skeleton of segments, objects and polygons; and its
// Mesh, triangles with materials. Metres, kilograms, right-handed axes, +Y up. Arrays are spans
// into the plant or mesh, without a copy: they are valid as long as any copy of the plant or mesh
// exists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lsys/api.h>
#include <lsys/grammar.h>
#include <lsys/outcome.h>
#include <lsys/project.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::LSYS_INTERFACE {

struct Vector2 {
    float x = 0.0F;
    float y = 0.0F;
};
struct Vector3 {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
};
struct Vector4 {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
    float w = 0.0F;
};
/// A unit quaternion that takes the turtle's axes at the start (right +X, heading +Y, up +Z) to the
/// turtle's axes at an item.
struct Quaternion {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F;
    float w = 1.0F;
};

inline constexpr std::uint32_t kNoParent = 0xFFFFFFFFu;

/// The colour of an item: an index of the grammar's palette up to 65,535, or an RGB colour,
/// kRgbColour + red * 65,536 + green * 256 + blue in sRGB.
using Colour = std::uint32_t;
inline constexpr Colour kRgbColour = 0x01000000u;

/// A straight piece of a stem, from `base` by `length` along its frame's +Y. 60 bytes.
struct Segment {
    Vector3 base;
    float length = 0.0F;
    Quaternion frame;
    float base_radius = 0.0F;
    float tip_radius = 0.0F;
    float spring = 0.0F;              // N m / rad, of the joint at the base
    float mass = 0.0F;                // kg
    std::uint32_t parent = kNoParent; // the segment before it on its path; earlier in the array
    Colour colour = 0;
    std::uint16_t order = 0; // number of open brackets: 0 is the trunk
    std::uint8_t sides = 0;  // corners of its cross-section; 0: the grammar does not set them
    std::uint8_t flags = 0;  // bit 0: begins where its parent ends
};

/// A leaf, flower, sphere or mesh of the object library, drawn from `position` along its frame's
/// +Y. 56 bytes.
struct Object {
    std::uint8_t kind = 0;  // index in object_kinds()
    std::uint32_t file = 0; // index in Plant::files(), for the kind "mesh_file"
    Vector3 position;
    float size = 1.0F; // factor
    Quaternion frame;
    std::uint32_t parent = kNoParent; // index in Plant::segments()
    Colour colour = 0;
    std::uint16_t order = 0; // number of open brackets
};

inline constexpr std::uint32_t kNoPicture = 0xFFFFFFFFu;

/// A filled polygon of at least three corners. 44 bytes.
struct Polygon {
    std::uint32_t first_corner = 0; // index in Plant::corners()
    std::uint32_t corner_count = 0;
    Quaternion frame;                 // frame of the turtle where the polygon begins
    std::uint32_t parent = kNoParent; // index in Plant::segments()
    Colour colour = 0;
    std::uint32_t picture = kNoPicture; // index in Plant::files()
    std::uint16_t order = 0;            // number of open brackets
};

/// Names of Object::kind.
[[nodiscard]] LSYS_API const std::vector<std::string>& object_kinds();

struct GrowOptions {
    std::optional<std::uint32_t> generations; // unset: Grammar::generations(), else 0
    std::optional<std::uint64_t> seed;        // unset: Grammar::seed()
    std::optional<float> height;              // m; if set, the plant is scaled to this height
    /// Draw while deriving, without storing the last word. For grammars without contexts.
    bool stream = false;
};

/// Measures of a plant.
struct PlantSize {
    Vector3 low; // bounds of axes, objects and corners, without radii
    Vector3 high;
    double height = 0.0;      // m
    double crown_width = 0.0; // m, twice the max horizontal distance from the start
    double length = 0.0;      // m, sum over all segments
    double volume = 0.0;      // m^3, sum over all segments
    double mass = 0.0;        // kg, sum over all segments
    std::vector<std::uint64_t> segments_by_order; // number of segments, by Segment::order
};

/// A drawn plant. Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Plant {
public:
    [[nodiscard]] std::uint64_t modules() const; // number of modules in the word
    [[nodiscard]] std::uint32_t generations() const;
    [[nodiscard]] std::uint64_t seed() const;
    [[nodiscard]] std::span<const Segment> segments() const;
    [[nodiscard]] std::span<const Object> objects() const;
    [[nodiscard]] std::span<const Polygon> polygons() const;
    [[nodiscard]] std::span<const Vector3> corners() const;
    /// Paths of the meshes and pictures of `#object`, as written in the grammar.
    [[nodiscard]] const std::vector<std::string>& files() const;
    [[nodiscard]] PlantSize measure() const;

    struct Data;
    explicit Plant(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

[[nodiscard]] LSYS_API Outcome<Plant>
grow(const Grammar& grammar, const GrowOptions& options = {}, const Project& project = {});

enum class MeshMethod : std::uint8_t {
    Default,   // boxes or tubes, depending on the dialect of the grammar
    Tubes,     // tubes along axes with shared rings at joints
    Cylinders, // one closed cylinder for each segment
    Boxes,     // joined boxes, smoothed by Catmull-Clark subdivision
    Solid,     // one closed surface, for printing
};

struct MeshOptions {
    MeshMethod method = MeshMethod::Default;
    std::uint32_t sides = 0; // sides of all cross-sections; 0: the values of the grammar
    /// Tubes: max distance in metres of a ring from its circle; rings get the fewest sides within
    /// this distance. 0: rings have the given sides.
    float deviation = 0.0F;
    bool texture_coordinates = true;
    bool tangents = true;
    bool smooth_joints = false; // Tubes: axes bend along smooth curves through their joints
    float min_width = 0.0F;     // m, of MeshMethod::Solid; 0: 1/150 of the largest extent
};

/// Colours are linear, 0 to 1.
struct Material {
    std::string name;
    Vector4 colour; // red, green, blue, opacity
    float roughness = 1.0F;
    bool two_sided = false;
    bool cut_out = false; // texels below half opacity are discarded
};

/// Triangles of one material: `index_count` indices from `first_index` on.
struct MeshPart {
    std::uint32_t material = 0; // index in Mesh::materials()
    std::uint64_t first_index = 0;
    std::uint64_t index_count = 0;
};

/// Output arrays of read_vertices(). Each pointer is the place for the first vertex, or null to
/// skip the attribute; the next vertex is `stride` bytes later. For interleaved vertices all
/// pointers are within the first vertex.
struct VertexTarget {
    void* positions = nullptr;           // 3 floats
    void* normals = nullptr;             // 3 floats
    void* texture_coordinates = nullptr; // 2 floats
    void* tangents = nullptr;            // 4 floats
    void* colours = nullptr;             // 4 floats: linear red, green, blue, 1
    std::size_t stride = 0;              // bytes, of all arrays; 0: each array is packed
};

/// Triangles, counter-clockwise seen from outside. Cheap to copy, immutable, safe to use from
/// several threads at once.
class LSYS_API Mesh {
public:
    [[nodiscard]] std::span<const Vector3> positions() const;
    [[nodiscard]] std::span<const Vector3> normals() const;             // unit length
    [[nodiscard]] std::span<const Vector2> texture_coordinates() const; // may be empty; v goes down
    [[nodiscard]] std::span<const Vector4>
    tangents() const;                                      // may be empty; w: sign of the bitangent
    [[nodiscard]] std::span<const Colour> colours() const; // one colour per vertex
    [[nodiscard]] std::uint64_t index_count() const;       // three for each triangle
    /// Writes the indices [first, first + count), which the mesh stores in a packed form.
    /// Precondition: first + count <= index_count().
    void read_indices(std::uint64_t first, std::uint64_t count, std::uint32_t* to) const;
    /// Writes all vertices, on several threads.
    void read_vertices(const VertexTarget& target) const;
    [[nodiscard]] const std::vector<MeshPart>& parts() const; // in the order of indices
    [[nodiscard]] const std::vector<Material>& materials() const;

    struct Data;
    explicit Mesh(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

[[nodiscard]] LSYS_API Outcome<Mesh>
make_mesh(const Plant& plant, const MeshOptions& options = {}, const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
