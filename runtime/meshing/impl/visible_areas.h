// SPDX-License-Identifier: MIT
// Visible areas: the areas of a picture that wood and foliage cover, with hidden surfaces removed.
// Levels of detail keep both areas, and therefore the mean colour.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/meshing/impl/linear_textures.h"
#include "runtime/meshing/mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

/// Pixels covered by wood and by foliage, summed over all views.
struct VisibleAreas {
    double wood = 0.0;
    double foliage = 0.0;
    glm::dvec3 colour{0.0}; // linear; sum over the pixels of wood and foliage

    [[nodiscard]] glm::dvec3 mean_colour() const {
        return all() > 0.0 ? colour / all() : glm::dvec3(0.0);
    }
    [[nodiscard]] double all() const { return wood + foliage; }
    void add(const VisibleAreas& other) {
        wood += other.wood;
        foliage += other.foliage;
        colour += other.colour;
    }
};

/// Measures meshes in 24 square views of one frame: from twelve horizontal directions, each once
/// level with the plant and once from above.
class AreaMeter {
public:
    /// Computes the size of the views from trial views of the finest mesh: plants with thin
    /// branches get more pixels. `threads`: as MeshOptions::threads.
    AreaMeter(const Mesh& wood, const Mesh& foliage, const Bounds& frame, std::uint32_t threads);

    /// Draws both meshes by pixel centres, with the opacity of pictures and the colours of
    /// materials. The result is the same on every machine and for every number of threads.
    /// `third`, unless null, receives the result of measure_third().
    [[nodiscard]] VisibleAreas
    measure(const Mesh& wood, const Mesh& foliage, VisibleAreas* third = nullptr);
    /// Like measure(), but in every third view only.
    [[nodiscard]] VisibleAreas measure_third(const Mesh& wood, const Mesh& foliage);

private:
    /// The areas in each of `count` views whose numbers are `step` apart.
    std::vector<VisibleAreas>
    measure_views(const Mesh& wood, const Mesh& foliage, std::size_t count, std::size_t step);

    Bounds frame_; // shown by each view
    int size_;     // pixels per side of a view
    Workers workers_;
    LinearTextures textures_;
};

} // namespace lsys
