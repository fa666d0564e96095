// SPDX-License-Identifier: MIT
// The part of a glTF file that shows a film: a node and a mesh for each shape, whose vertices move
// by morph targets, and an animation that shows one shape at a time (glTF 2.0, sections 3.7.2.2 and
// 3.11). Target k of a mesh is frame k of its shape; the mesh itself is the last frame.
#pragma once

#include "runtime/export/impl/gltf_motion.h"
#include "runtime/meshing/mesh_film.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// Counts of items in the arrays of the animation; all 0 for a film of one frame.
struct GltfFilmCounts {
    std::uint64_t times = 0;
    std::uint64_t scales = 0;
    std::uint64_t weights = 0; // of morph targets
};
[[nodiscard]] GltfFilmCounts count_film_items(const MeshFilm& film);
/// Times of the frames, then times at which each shape appears and disappears.
void write_film_times(const MeshFilm& film, const GltfBytes& write);
/// Scales at the times at which shapes appear and disappear: 1 while a shape is shown, else 0.
void write_film_scales(const MeshFilm& film, const GltfBytes& write);
/// Weights of the targets of each shape, frame by frame.
void write_film_weights(const MeshFilm& film, const GltfBytes& write);

/// Shapes that are not empty. Each of these has a node and a mesh, in order from mesh 0 on.
[[nodiscard]] std::vector<std::uint32_t> drawn_shapes(const MeshFilm& film);
/// A node for each mesh. Readers without animations show the last shape.
void put_film_nodes(JsonWriter& json, const MeshFilm& film);
/// Accessors: times and scales for each shape, then times and weights for each shape. Accessors
/// without items are left out. The views of times, scales and weights are consecutive from
/// `first_view` on; empty views are left out.
void put_film_accessors(JsonWriter& json, const MeshFilm& film, std::size_t first_view);
/// The member `animations`. `first_node`: number of the first node of put_film_nodes(); `accessor`:
/// number of the first accessor of put_film_accessors().
void put_film_animation(JsonWriter& json,
                        const MeshFilm& film,
                        std::size_t first_node,
                        std::size_t accessor);

} // namespace lsys
