// TubeWriter: rings and strips of triangles for the runs of axes. Frames are carried along an axis
// by double reflection (Wang, Juettler, Zheng and Liu, "Computation of rotation minimizing frames",
// ACM TOG 27(1), 2008, section 4), so that a tube does not twist where the turtle rolls.
#pragma once

#include "runtime/meshing/axis_reader.h"
#include "runtime/meshing/mesh_builder.h"
#include "runtime/turtle.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

class BarkNoise;

/// Vertices of a ring: one more than sides where texture coordinates begin and end.
[[nodiscard]] inline std::uint32_t columns_of(std::uint32_t sides, const MeshOptions& options) {
    return sides + (options.texture_coordinates || options.tangents ? 1U : 0U);
}

/// Index of each colour in Axes::colours.
using ColourSlots = std::vector<std::uint32_t>;

/// What a TubeWriter will write. `indices` has an item for each slot.
void count_tube(const Run& run,
                const MeshOptions& options,
                const ColourSlots& slots,
                std::uint64_t& vertices,
                std::vector<std::uint64_t>& indices);

class TubeWriter {
public:
    /// Writes vertices from `vertex` of the block on, and indices of each slot from `index` on.
    TubeWriter(const MeshBlock& block,
               const MeshOptions& options,
               const ColourSlots& slots,
               std::uint64_t vertex,
               std::span<const std::uint64_t> index);

    void write(const Run& run);

    [[nodiscard]] std::uint64_t vertex() const { return vertex_; }
    [[nodiscard]] const std::vector<std::uint64_t>& index() const { return index_; }

private:
    /// Where a ring lies and how; the axes of its ellipse are stretched along `mitre`.
    struct Ring {
        glm::vec3 centre{};
        float radius = 0.0F;
        float slope = 0.0F;   // of the radius by arc length
        glm::vec3 mitre{};    // perpendicular to the tangent
        float stretch = 0.0F; // added per square of the length of `mitre`
        double arc = 0.0;
        std::uint32_t sides = 0;
        std::uint16_t colour = 0;
    };

    void carry(const glm::vec3& edge, const glm::vec3& tangent);
    void bend(const Joint& before, const Joint& joint, Ring ring, bool from_point);
    void change_colour(Ring& ring, std::uint16_t colour);
    void link_ring(const Ring& ring, std::uint32_t slot, bool from_point);
    void put_ring(const Ring& ring);
    void put_textured(const Ring& ring, std::uint64_t first);
    void put_noise(const Ring& ring, std::uint64_t first);
    void put_tip(const glm::vec3& position, const glm::vec3& normal, double arc, const Ring& ring);
    void begin(const Run& run, const Ring& ring);
    void end(const Run& run, Ring ring);
    void strip(std::uint64_t low,
               std::uint32_t low_sides,
               std::uint64_t high,
               std::uint32_t high_sides,
               std::uint32_t slot);
    void uneven_strip(std::uint64_t low,
                      std::uint32_t low_sides,
                      std::uint64_t high,
                      std::uint32_t high_sides,
                      std::uint32_t slot);
    /// Triangles from each side of a ring to `point`, which moves on by `step`.
    void fan(std::uint64_t ring,
             std::uint32_t sides,
             std::uint64_t point,
             std::uint32_t step,
             bool upwards,
             std::uint32_t slot);
    [[nodiscard]] float v_of(double arc) const { return static_cast<float>(-arc * v_scale_); }

    MeshBlock block_;
    const MeshOptions& options_;
    const ColourSlots& slots_;
    bool seam_;
    std::uint64_t vertex_;
    std::vector<std::uint64_t> index_;
    // Offsets of the triangles between two rings of the same sides, made when first used.
    std::array<std::vector<std::uint32_t>, kMaxSides + 1> patterns_;
    // Of the run that is being written:
    glm::vec3 tangent_{};
    glm::vec3 normal_{}; // where the first corner is seen from the axis
    std::uint32_t steps_ = 0;
    double v_scale_ = 0.0;
    const BarkNoise* noise_ = nullptr;
    std::uint64_t ring_ = 0; // first vertex of the last ring
    std::uint32_t ring_sides_ = 0;
};

} // namespace lsys
