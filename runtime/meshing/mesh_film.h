// SPDX-License-Identifier: MIT
// MeshFilm: successive frames of a growing plant as morph-target shapes. Frames with the same
// triangles and materials are one shape, whose vertices move; a frame that differs in these begins
// another shape. Made by MeshFilmBuilder; written by runtime/export as morph targets.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <vector>

namespace lsys {

struct MeshFilm {
    /// Vertices of a frame.
    struct Frame {
        LargeVector<glm::vec3> positions;
        LargeVector<glm::vec3> normals;
    };
    struct Shape {
        std::uint32_t first_frame = 0;
        std::vector<Frame> earlier; // all frames except the last one, which is in MeshFilm::mesh
        std::uint64_t first_vertex = 0; // index in MeshFilm::mesh
        std::uint32_t first_part = 0;   // index in Mesh::parts of MeshFilm::mesh
        std::uint32_t part_count = 0;   // 0: nothing is drawn

        [[nodiscard]] std::uint32_t frame_count() const {
            return static_cast<std::uint32_t>(earlier.size()) + 1;
        }
    };

    Mesh mesh; // the last frame of each shape, one after the other
    std::vector<Shape> shapes;
    float frames_per_second = 24.0F;

    [[nodiscard]] std::uint32_t frame_count() const {
        return shapes.empty() ? 0 : shapes.back().first_frame + shapes.back().frame_count();
    }
    [[nodiscard]] std::uint64_t byte_count() const;
};

class MeshFilmBuilder {
public:
    explicit MeshFilmBuilder(float frames_per_second) {
        film_.frames_per_second = frames_per_second;
    }

    /// Adds a frame. A shape has the texture coordinates, tangents and colours of its last frame.
    /// May throw std::bad_alloc.
    void add(Mesh frame);
    /// Bytes of all frames so far.
    [[nodiscard]] std::uint64_t byte_count() const;
    /// The film. The builder cannot be used afterwards.
    [[nodiscard]] MeshFilm finish();

private:
    void close_shape(); // moves the frames of the open shape to film_

    MeshFilm film_;
    Mesh last_;                            // the last frame of the open shape
    std::vector<MeshFilm::Frame> earlier_; // frames of the open shape before last_
    std::uint32_t frames_ = 0;             // number of frames added so far
};

} // namespace lsys
