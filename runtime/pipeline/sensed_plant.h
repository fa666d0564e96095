// SPDX-License-Identifier: MIT
// SensedPlant: the last word that a plant sensed, for dumps and viewers: places and answers of its
// sense modules, voxels and markers of the environments, and obstacles.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/environment/environment.h"
#include "runtime/environment/word_sense.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/project.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lsys {

/// A voxel of an environment of kind Shadow (value: exposure) or Sky (value: area in m^2).
struct SensedVoxel {
    Vector3 middle{}; // m
    double value = 0.0;
};

/// A module that asked an environment.
struct SensedModule {
    std::uint64_t position = 0; // index in the word
    SensePlace place;
    std::span<const float> answer; // a part of SensedPart::answers
};

/// An environment, and what the modules of the word sensed of it.
struct SensedPart {
    std::string name; // name of the environment, without the `?`
    EnvironmentKind kind = EnvironmentKind::Shadow;
    double cell = 0.0; // edge of a voxel, m; 0: no voxels
    std::vector<SensedModule> modules;
    std::vector<float> answers;      // of all `modules`
    std::vector<SensedVoxel> voxels; // voxels with a sense module or leaf area; sorted by x, y, z
    std::vector<Vector3> markers;    // markers that are left; kind Space
    // Obstacles of an environment of kind Solid.
    std::vector<EnvironmentMesh> meshes;
    std::vector<std::array<float, 4>> planes; // EnvironmentSurface::plane
};

struct SensedPlant {
    std::uint32_t generation = 0;  // age of the last word that was sensed
    bool has_sensed = false;       // whether any word was sensed
    std::vector<SensedPart> parts; // by index in Bytecode::environments
    /// Size of the drawn plant / size of the plant while it sensed, since `#set height` or `#set
    /// scale` scales the drawn plant.
    double scale = 1.0;
};

/// The SensedPlant of the word that `senses` has sensed last, in a derivation with `bytecode`.
/// `files`: the files of the environments.
[[nodiscard]] SensedPlant sensed_plant_of(const Bytecode& bytecode,
                                          const std::vector<EnvironmentFiles>& files,
                                          const EnvironmentSense& senses);

/// Derives the grammar and returns the last word that it sensed. Uses `file`, `generations` and
/// `seed` of the options.
[[nodiscard]] Outcome<SensedPlant>
sense_plant(const PlantOptions& options, const Grammar& grammar, const Project& project);

} // namespace lsys
