// Visible areas: how much of a picture wood and foliage cover, where one hides the other. Levels of
// detail keep both, and with them their mean colour.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec3.hpp>

namespace lsys {

/// Pixels of all views together.
struct VisibleAreas {
    double wood = 0.0;
    double foliage = 0.0;
    glm::dvec3 colour{0.0}; // linear, sum over the pixels of both

    [[nodiscard]] glm::dvec3 mean_colour() const {
        return all() > 0.0 ? colour / all() : glm::dvec3(0.0);
    }
    [[nodiscard]] double all() const { return wood + foliage; }
};

/// Draws both meshes into square views of `frame` from six sides, each level with the plant and from
/// above, by pixel centres and with the opacity of pictures. The result is the same on every
/// machine.
[[nodiscard]] VisibleAreas
visible_areas(const Mesh& wood, const Mesh& foliage, const Bounds& frame);

} // namespace lsys
