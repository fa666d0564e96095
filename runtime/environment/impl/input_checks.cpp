// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/input_checks.h"

#include "runtime/environment/impl/vectors.h"

namespace lsys {

std::optional<EnvironmentFailure> check_places(std::span<const SensePlace> places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!is_finite(places[i].position)) {
            EnvironmentFailure failure = refused("the turtle is at a place that is not finite",
                                                 "keep the lengths of segments finite");
            failure.failed_place = i;
            return failure;
        }
    }
    return std::nullopt;
}

std::optional<EnvironmentFailure> check_mesh(const EnvironmentMesh& mesh) {
    for (const Vector3& vertex : mesh.vertices) {
        if (!is_finite(vertex)) {
            return refused("its mesh has a vertex that is not finite",
                           "give all vertices finite coordinates");
        }
    }
    return std::nullopt;
}

} // namespace lsys
