// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/moved_environments.h"

namespace lsys {

namespace {

void move_environment(const std::array<float, 3>& by, BytecodeEnvironment& environment) {
    if (environment.kind == EnvironmentKind::Map) { // `at` is x z
        environment.at[0] += by[0];
        environment.at[1] += by[2];
        return;
    }
    for (std::size_t axis = 0; axis < by.size(); ++axis) {
        environment.at[axis] += by[axis];
    }
    for (EnvironmentSurface& surface : environment.surfaces) {
        // The moved plane is a (x - dx) + b (y - dy) + c (z - dz) + d = 0. For a mesh, a, b and c
        // are 0.
        for (std::size_t axis = 0; axis < by.size(); ++axis) {
            surface.plane[3] -= surface.plane[axis] * by[axis];
        }
    }
}

} // namespace

void move_environments(const std::vector<EnvironmentMove>& moves, Bytecode& bytecode) {
    for (const EnvironmentMove& move : moves) {
        for (BytecodeEnvironment& environment : bytecode.environments) {
            const bool has_place = environment.kind == EnvironmentKind::Solid ||
                                   environment.kind == EnvironmentKind::Space ||
                                   environment.kind == EnvironmentKind::Map;
            if (has_place && environment.name == move.name) {
                move_environment(move.by, environment);
            }
        }
    }
}

} // namespace lsys
