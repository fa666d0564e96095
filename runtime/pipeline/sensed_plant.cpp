// SPDX-License-Identifier: MIT
#include "runtime/pipeline/sensed_plant.h"

#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/step.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace lsys {

namespace {

using Voxel = std::array<double, 3>; // whole numbers

/// Adds the voxels that contain places of an environment of kind Shadow, with their exposure.
void add_exposures(const SensedEnvironment& sensed, SensedPart& part) {
    std::map<Voxel, double> exposures;
    for (std::size_t i = 0; i < sensed.places.size(); ++i) {
        const Vector3& place = sensed.places[i].position;
        exposures[{
            std::floor(place[0] / part.cell + 0.5), std::floor(place[1] / part.cell + 0x1p-20),
            std::floor(place[2] / part.cell + 0.5)}] = static_cast<double>(sensed.answers[4 * i]);
    }
    for (const auto& [voxel, exposure] : exposures) {
        part.voxels.push_back(
            {{voxel[0] * part.cell, (voxel[1] + 0.5) * part.cell, voxel[2] * part.cell}, exposure});
    }
}

/// Adds the voxels of an environment of kind Sky that contain organs, with the total area of these
/// organs.
void add_areas(const std::vector<SensedOrgan>& organs, SensedPart& part) {
    std::map<Voxel, double> areas;
    for (const SensedOrgan& organ : organs) {
        const auto index = [&](std::size_t axis) {
            return std::floor(organ.middle[axis] / part.cell);
        };
        areas[{index(0), index(1), index(2)}] += organ.area;
    }
    for (const auto& [voxel, area] : areas) {
        part.voxels.push_back({{(voxel[0] + 0.5) * part.cell, (voxel[1] + 0.5) * part.cell,
                                (voxel[2] + 0.5) * part.cell},
                               area});
    }
}

/// Adds the modules that asked the environment, with their answers.
void add_modules(const SensedEnvironment& sensed, SensedPart& part) {
    part.answers = sensed.answers;
    const std::uint32_t fixed = answer_size(part.kind);
    std::size_t first_answer = 0;
    for (std::size_t i = 0; i < sensed.modules.size(); ++i) {
        const std::uint32_t size = fixed == kUnknownAnswerSize ? sensed.sizes[i] : fixed;
        part.modules.push_back({sensed.modules[i].position, sensed.places[i],
                                std::span<const float>(part.answers).subspan(first_answer, size)});
        first_answer += size;
    }
}

/// The part of an environment as it is declared, before any word is sensed.
SensedPart declared_part(const BytecodeEnvironment& declared, const EnvironmentFiles& files) {
    SensedPart part;
    part.name = declared.name;
    part.kind = declared.kind;
    if (declared.kind == EnvironmentKind::Solid) {
        part.meshes = files.meshes;
        for (const EnvironmentSurface& surface : declared.surfaces) {
            if (surface.path.empty()) {
                part.planes.push_back(surface.plane);
            }
        }
    }
    return part;
}

} // namespace

SensedPlant sensed_plant_of(const Bytecode& bytecode,
                            const std::vector<EnvironmentFiles>& files,
                            const EnvironmentSense& senses) {
    SensedPlant plant;
    plant.has_sensed = !senses.sensed().empty();
    plant.generation = senses.age();
    for (std::size_t i = 0; i < bytecode.environments.size(); ++i) {
        const BytecodeEnvironment& declared = bytecode.environments[i];
        SensedPart& part = plant.parts.emplace_back(declared_part(declared, files[i]));
        if (!plant.has_sensed) {
            continue;
        }
        const SensedEnvironment& sensed = senses.sensed()[i];
        add_modules(sensed, part);
        if (part.kind == EnvironmentKind::Shadow) {
            part.cell = static_cast<double>(declared.cell);
            add_exposures(sensed, part);
        } else if (part.kind == EnvironmentKind::Sky) {
            part.cell = static_cast<double>(declared.cell);
            add_areas(senses.organs(), part);
        }
        senses.environment(i).append_markers(part.markers);
    }
    return plant;
}

Outcome<SensedPlant>
sense_plant(const PlantOptions& options, const Grammar& grammar, const Project& project) {
    Step step(project);
    const Bytecode& bytecode = grammar.bytecode;
    PlantSenses senses;
    if (!step.take(read_senses(options.file, grammar, project), senses)) {
        return step.end();
    }
    const std::unique_ptr<EnvironmentSense> sense = senses.make(bytecode);
    DeriveOptions derive = derive_options(options, bytecode, project);
    derive.senses = sense.get();
    project.begin(LongStep::Derive);
    Derivation derivation(bytecode, derive);
    if (const std::optional<Stop> stop = derivation.derive()) {
        if (stop != Stop::Cancelled) {
            step.diagnose(derivation_diagnostic(derivation.end(), derive.limits, grammar),
                          grammar.sources);
        }
        return step.end(*stop);
    }
    return step.done(sense == nullptr || sense->sensed().empty()
                         ? SensedPlant{}
                         : sensed_plant_of(bytecode, senses.files, *sense));
}

} // namespace lsys
