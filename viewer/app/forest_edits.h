// ForestEdits: what a user has set in place of what a scene says, while it is shown.
#pragma once

#include "runtime/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

struct SpeciesEdit {
    std::string name;
    std::optional<double> share;
    std::optional<float> least_scale;
    std::optional<float> greatest_scale;
    std::optional<std::uint32_t> heroes;
    std::optional<float> rho;

    friend bool operator==(const SpeciesEdit&, const SpeciesEdit&) = default;
};

struct ForestEdits {
    std::vector<SpeciesEdit> species; // of some; those that a scene does not have do nothing
    std::optional<std::uint32_t> cap;
    std::optional<std::uint64_t> key;
    std::optional<PlacementMethod> method;
    std::optional<std::uint64_t> count;
    std::optional<double> spacing;
    std::optional<double> density;
    std::optional<std::uint32_t> years;
    std::optional<TerrainKind> ground; // Flat or Noise
    std::optional<double> hill_height;
    std::optional<double> hill_feature;
    std::optional<std::uint64_t> hill_seed;

    /// That of a species, which is made if there is none.
    [[nodiscard]] SpeciesEdit& of(const std::string& name);
    /// Other trees may stand elsewhere than the scene says.
    [[nodiscard]] bool changes_placement() const;
    /// Those that set nothing are as if they were not there.
    [[nodiscard]] bool is_same(const ForestEdits& other) const;
};

void apply(const ForestEdits& edits, Scene& scene);

/// Another method, with what it needs and that of `scene` does not: for about as many trees.
void choose_method(ForestEdits& edits, PlacementMethod method, const Scene& scene);

/// What a placement reads.
[[nodiscard]] bool reads_count(PlacementMethod method);
[[nodiscard]] bool reads_spacing(PlacementMethod method);
[[nodiscard]] bool reads_density(PlacementMethod method);

} // namespace lsys::view
