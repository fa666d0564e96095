// SPDX-License-Identifier: MIT
// Writes a plant as files: one, or one for each level of detail or frame, with the pictures,
// materials and buffers beside them. Used by `lsc export` and the public library.
#pragma once

#include "runtime/output/file_options.h"
#include "runtime/output/output_set.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace lsys {

/// Times and bytes of all files of an export.
struct ExportTiming {
    double physics_seconds = 0.0;
    double mesh_seconds = 0.0;
    double write_seconds = 0.0;
    std::uint64_t bytes = 0;
};

/// Results of writing, for statistics.
struct PlantFileReport {
    ExportTiming timing;
    Mesh mesh; // mesh of the last frame, or of the finest level
};

/// The inputs of a plant: the path of its grammar and the compiled grammar.
struct PlantSource {
    std::string file;
    const Grammar& grammar;
};

/// A message about options that conflict or that the format does not support; empty if none.
[[nodiscard]] std::string
find_conflict(const PlantFileOptions& options, ExportFormat format, const OutputContext& context);

/// Writes the plant at rest, bent or moving. Precondition: no conflict, and not `options.grow`.
[[nodiscard]] ExitStatus write_plant_files(const PlantFileOptions& options,
                                           ExportFormat format,
                                           const PlantSource& source,
                                           const Plant& plant,
                                           const OutputContext& context,
                                           PlantFileReport& report);

/// Writes the growth of a plant. `last` becomes the plant of the last frame. Precondition: no
/// conflict, and `options.grow`.
[[nodiscard]] ExitStatus write_growth_files(const PlantFileOptions& options,
                                            ExportFormat format,
                                            const PlantOptions& plant,
                                            Grammar& grammar,
                                            const OutputContext& context,
                                            PlantFileReport& report,
                                            Plant& last);

/// Compiles the grammar for entry `number` of the values of a variant, and grows its plant.
using GrowVariant = std::function<ExitStatus(std::size_t number, Grammar& grammar, Plant& plant)>;
/// Writes one plant for each of `values` into one file. `first` becomes the first plant.
/// Precondition: no conflict; `file`: the path of the grammar.
[[nodiscard]] ExitStatus write_variant_files(const PlantFileOptions& options,
                                             ExportFormat format,
                                             const std::string& file,
                                             const VariantValues& values,
                                             const GrowVariant& grow,
                                             const OutputContext& context,
                                             PlantFileReport& report,
                                             Plant& first);

} // namespace lsys
