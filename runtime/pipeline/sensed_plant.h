// SPDX-License-Identifier: MIT
// SensedPlant: what a plant sensed last: the places that asked, the answers, what the environments
// held, and its obstacles. For dumps and viewers.
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

struct SensedPart {
    std::string name;
    EnvironmentKind kind = EnvironmentKind::Shadow;
    double cell = 0.0; // edge of a voxel, m; 0: no voxels
    std::vector<SensedModule> modules;
    std::vector<float> answers;
    std::vector<SensedVoxel> voxels; // voxels with a place or a leaf area; sorted by x, y, z
    std::vector<Vector3> markers;    // markers that are left; kind Space
    // Obstacles, of kind Solid.
    std::vector<EnvironmentMesh> meshes;
    std::vector<std::array<float, 4>> planes; // EnvironmentSurface::plane
};

struct SensedPlant {
    std::uint32_t generation = 0;  // age of the last word that was sensed
    bool has_sensed = false;       // whether any word was sensed
    std::vector<SensedPart> parts; // by index in Bytecode::environments
    /// Size of the drawn plant as a multiple of the size that sensed: `#set height` scales it.
    double scale = 1.0;
};

/// What `senses`, which has sensed words of a derivation with `bytecode`, holds now. `files`: what
/// the environments read.
[[nodiscard]] SensedPlant sensed_plant_of(const Bytecode& bytecode,
                                          const std::vector<EnvironmentFiles>& files,
                                          const EnvironmentSense& senses);

/// Derives the grammar. Uses `file`, `generations` and `seed` of the options.
[[nodiscard]] Outcome<SensedPlant>
sense_plant(const PlantOptions& options, const Grammar& grammar, const Project& project);

} // namespace lsys
