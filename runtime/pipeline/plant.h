// SPDX-License-Identifier: MIT
// Plant: derives and draws a compiled grammar as a skeleton, and meshes it.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/derive/derive.h"
#include "runtime/derive/word.h"
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/project.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct SensedPlant;

struct PlantOptions {
    std::string file;                         // path of the grammar, base of files of `#object`
    std::optional<std::uint32_t> generations; // unset: the value of #n
    std::optional<std::uint64_t> seed;        // unset: the value of #set seed
    std::optional<float> height;              // m; unset: the value of #set height
    bool stream = false;                      // draw while deriving, store no word
    bool origins = false;                     // keep the origins of segments and objects
    bool senses = false;                      // store the last sensed word in Plant::sensed
};

/// A plant, and the durations of its steps.
struct Plant {
    Skeleton skeleton;
    std::vector<UserMesh> user_meshes; // the meshes of skeleton.mesh_files, in the same order
    std::uint64_t modules = 0;         // number of modules of the derived word
    std::uint32_t generations = 0;     // of the derived word
    std::uint64_t seed = 0;
    double derive_seconds = 0.0; // includes drawing with PlantOptions::stream
    double draw_seconds = 0.0;
    std::shared_ptr<const SensedPlant> sensed{}; // null: not requested, or no sense modules
};

/// Options for a derivation of the grammar: generations, seed, limits, threads, cancellation. The
/// caller sets DeriveOptions::senses (PlantSenses::make()).
[[nodiscard]] DeriveOptions
derive_options(const PlantOptions& options, const Bytecode& bytecode, const Project& project);

/// Folds all modules that a derivation from the axiom can reach (fold_reached()): the bytecode then
/// derives the same words faster, with other module codes.
void fold_modules(const DeriveOptions& options, Bytecode& bytecode);

/// The result of derive_word().
struct DerivedWord {
    Word word;
    /// Bytecode that defines the codes of `word`; unset: the bytecode of the grammar does.
    std::optional<Bytecode> folded;
    std::uint32_t generations = 0; // of the derived word
    std::uint64_t seed = 0;
};

/// Derives the grammar, with a folded copy of its bytecode unless fold_reached() returns nothing.
/// Uses only `file`, `generations`, `seed` and `origins` of the options.
[[nodiscard]] Outcome<DerivedWord>
derive_word(const PlantOptions& options, const Grammar& grammar, const Project& project);

/// Derives the grammar and draws its word. Folds the bytecode of the grammar (fold_modules()).
[[nodiscard]] Outcome<Plant>
grow_plant(const PlantOptions& options, Grammar& grammar, const Project& project);

/// Meshes `skeleton`, which is the skeleton of `plant` or a bent copy of it, with the threads and
/// the memory limit of the project.
[[nodiscard]] Outcome<Mesh> mesh_plant(const Plant& plant,
                                       const Skeleton& skeleton,
                                       const MeshOptions& options,
                                       const Project& project);

/// Plans the levels of detail of `skeleton` that `chain` requests. Level 0 has `options`.
[[nodiscard]] Outcome<DetailLevels> plan_plant_levels(const Plant& plant,
                                                      const Skeleton& skeleton,
                                                      const MeshOptions& options,
                                                      const DetailChain& chain,
                                                      const Project& project);
/// Meshes level `number` of `skeleton`, which is the skeleton of plan_plant_levels() or a pose of
/// it, with the vertex arrays that `options` requests. Precondition: number < levels.levels.size().
[[nodiscard]] Outcome<Mesh> mesh_plant_level(const Plant& plant,
                                             const Skeleton& skeleton,
                                             const DetailLevels& levels,
                                             std::size_t number,
                                             const MeshOptions& options,
                                             const Project& project);

/// The diagnostic of a derivation that has stopped. Precondition: the stop is not Stop::Cancelled.
[[nodiscard]] Diagnostic
derivation_diagnostic(const DerivationEnd& end, const Limits& limits, const Grammar& grammar);

} // namespace lsys
