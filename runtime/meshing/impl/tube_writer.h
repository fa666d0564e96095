// SPDX-License-Identifier: MIT
// TubeWriter: writes the vertices of the rings of runs. The normal is transported from edge to edge
// by double reflection (Wang, Juettler, Zheng and Liu, "Computation of rotation minimizing frames",
// ACM TOG 27(1), 2008, section 4), so that a tube does not twist where the turtle rolls. The normal
// is perpendicular to the edge, so the first reflection, along the edge, does not change it; only
// the second reflection, in the plane that halves the bend, is computed. Lines between corners of
// neighbouring rings are parallel to the edge between the rings.
#pragma once

#include "runtime/meshing/impl/axis_reader.h"
#include "runtime/meshing/impl/mesh_builder.h"

#include <cstddef>
#include <cstdint>

namespace lsys {

class BarkNoise;
class Grooves;
class Roots;

/// Number of vertices of a ring: one more than sides if texture coordinates need a seam.
[[nodiscard]] inline std::uint32_t columns_of(std::uint32_t sides, const MeshOptions& options) {
    return sides + (options.texture_coordinates || options.tangents ? 1U : 0U);
}

class TubeWriter {
public:
    /// `looks`: may be null. `vertex`: index in `block` of the next vertex to write.
    TubeWriter(const MeshBlock& block,
               const MeshOptions& options,
               const Flare& flare,
               const Looks* looks,
               std::uint64_t vertex);

    /// Progress within a run: a place between two joints, and the frame there.
    struct Place {
        std::size_t joint = 0;      // index of the next joint
        std::uint64_t vertex = 0;   // index of the next vertex to write
        double arc = 0.0;           // arc length from the begin of the run
        double circumference = 0.0; // at the mean radius; 0 if not needed
        glm::vec3 normal{};         // across the edge, towards the first corner
        std::uint32_t steps = 0;    // number of edges since the begin of the run
    };

    /// Writes a whole run.
    void write(const Run& run);
    /// The place at the begin of a run, where the vertices written so far end.
    [[nodiscard]] Place begin(const Run& run) const;
    /// Writes the rings before joint `end` and moves `place` there.
    void write(const Run& run, Place& place, std::size_t end);
    /// Moves `place` to joint `end` as write() does, without writing vertices.
    void skip(const Run& run, Place& place, std::size_t end) const;

    [[nodiscard]] std::uint64_t vertex() const { return at_.vertex; }

private:
    /// Position and shape of a ring: an ellipse across the tangent.
    struct Ring {
        glm::vec3 centre{};
        float radius = 0.0F;
        float slope = 0.0F; // change of the radius per arc length
        glm::vec3 tangent{};
        glm::vec3 normal{}; // unit; direction of the first corner
        glm::vec3 binormal{};
        glm::vec3 wide_normal{}; // the normal and the binormal, stretched along the bend
        glm::vec3 wide_binormal{};
        double arc = 0.0;
        std::uint32_t sides = 0;
        ItemColour colour = 0;
    };

    void advance(const Run& run, std::size_t end);              // writes up to joint `end`
    void set_straight(const glm::vec3& edge, Ring& ring) const; // sets a ring across `edge`
    /// Sets a ring in the plane that halves the bend.
    void set_mitred(const glm::vec3& in, const glm::vec3& out, Ring& ring) const;
    /// Rotates the normal of `place` by the shortest rotation from `in` to `out`.
    static void transport_normal(const glm::vec3& in, const glm::vec3& out, Place& place);
    /// Writes the two or three rings of a sharp bend.
    void bend(const Joint& before, const Joint& joint, Ring& ring);
    void put_ring(const Ring& ring);
    /// Writes the texture coordinates and tangents of a ring.
    void put_textured(const Ring& ring, std::uint64_t first);
    void put_normal_map(const Ring& ring,
                        std::uint64_t first); // writes a ring with noise or grooves
    void put_tip(const glm::vec3& position, const glm::vec3& normal, const Ring& ring);
    void close(const Run& run, Ring& ring);     // closes the end of the run; `ring`: written last
    void put_break(const Run& run, Ring& ring); // writes the two rings of a broken end
    /// Whether bark noise, grooves or roots move the vertices of a ring.
    [[nodiscard]] bool has_normal_map(const Ring& ring) const;
    [[nodiscard]] float v_of(const Ring& ring);

    MeshBlock block_;
    const MeshOptions& options_;
    const Flare& flare_;
    const Looks* looks_;
    bool seam_; // rings have a seam: one vertex more than sides
    Place at_;  // up to where the run is written
    // The picture of the ring written last:
    ItemColour picture_colour_ = 0xFFFFFFFFu; // its colour; no colour before the first ring
    float picture_length_ = 1.0F;             // Look::picture_length
    // State of the run being written:
    double v_scale_ = 0.0;             // texture coordinate v per arc length
    const BarkNoise* noise_ = nullptr; // null: none
    const Grooves* grooves_ = nullptr; // null: none
    const Roots* roots_ = nullptr;     // null: none
};

} // namespace lsys
