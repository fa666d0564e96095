// SPDX-License-Identifier: MIT
// The variants of a USD layer (OpenUSD, "VariantSet"): meshes of levels of detail, or of plants.
// Readers show one of them.
#pragma once

#include "runtime/export/export.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct UsdaVariants {
    std::string set;                 // name of the variant set
    std::vector<std::string> names;  // of the variants; the first is the selected one
    std::vector<const Mesh*> meshes; // of each variant
    std::vector<double> coverages;   // of levels of detail: min fraction of the screen, 0 to 1
    Mesh samples;                    // their distinct materials in use (material_samples.h)
    std::vector<std::vector<std::uint32_t>> materials; // by mesh and part: index in `samples`
};

/// The variants of a file; none if it has one mesh only. The result refers to `mesh` and `info`.
[[nodiscard]] std::optional<UsdaVariants> find_usda_variants(const Mesh& mesh,
                                                             const ExportInfo& info);

/// A valid name for a variant of USD: `0_25` for `0.25`.
[[nodiscard]] std::string usda_variant_name(const std::string& text);

} // namespace lsys
