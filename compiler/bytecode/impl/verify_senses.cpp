// SPDX-License-Identifier: MIT
#include "compiler/bytecode/impl/verify_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

bool has_valid_numbers(const BytecodeEnvironment& e) {
    const auto is_positive = [](float value) { return std::isfinite(value) && value > 0.0F; };
    const auto is_length = [](float value) { return std::isfinite(value) && value >= 0.0F; };
    const auto is_finite = [](float value) { return std::isfinite(value); };
    const bool has_size = e.kind == EnvironmentKind::Map ||
                          (e.kind == EnvironmentKind::Space && e.shape != SpaceShape::Mesh);
    const std::size_t axes = e.kind == EnvironmentKind::Map ? 2 : has_size ? 3 : 0;
    return is_positive(e.cell) && is_positive(e.ratio) && is_positive(e.radius) &&
           is_length(e.strength) && is_length(e.extinction) && is_length(e.kill) &&
           e.levels <= kMaxShadowLevels && e.directions >= 1 && e.directions <= kMaxSkyDirections &&
           e.count >= 1 && e.count <= kMaxMarkers && e.angle > 0.0F && e.angle <= 360.0F &&
           is_finite(e.low) && is_finite(e.high) &&
           std::all_of(e.at.begin(), e.at.end(), is_finite) &&
           std::all_of(e.size.begin(), e.size.begin() + axes, is_positive) &&
           std::all_of(e.size.begin() + axes, e.size.end(),
                       [](float value) { return value == 0.0F; });
}

/// Solid: planes, then meshes, at least one. A mesh as the shape of a Space, the picture of a Map:
/// one file. Other kinds: none.
bool has_valid_surfaces(const Bytecode& bytecode, const BytecodeEnvironment& e) {
    const bool has_file = e.kind == EnvironmentKind::Map ||
                          (e.kind == EnvironmentKind::Space && e.shape == SpaceShape::Mesh);
    const bool is_solid = e.kind == EnvironmentKind::Solid;
    if (is_solid ? e.surfaces.empty() : e.surfaces.size() != (has_file ? 1U : 0U)) {
        return false;
    }
    bool after_file = false;
    for (const EnvironmentSurface& surface : e.surfaces) {
        const auto& [a, b, c, d] = surface.plane;
        const bool is_plane = surface.path.empty();
        if (!is_printable(surface.path) || !is_site(bytecode, surface.site) ||
            (is_plane && (!is_solid || after_file || (a == 0.0F && b == 0.0F && c == 0.0F))) ||
            !std::all_of(surface.plane.begin(), surface.plane.end(),
                         [](float value) { return std::isfinite(value); })) {
            return false;
        }
        after_file = after_file || !is_plane;
    }
    return true;
}

} // namespace

std::optional<std::string> environments_problem(const Bytecode& bytecode) {
    if (bytecode.environments.size() > kMaxEnvironments) {
        return fmt::format("{} environments", bytecode.environments.size());
    }
    for (const BytecodeEnvironment& e : bytecode.environments) {
        if (e.name.empty() || !is_printable(e.name) || !is_site(bytecode, e.site) ||
            !is_enumerator(e.kind) || !is_enumerator(e.shape)) {
            return "an environment has no name, place or kind";
        }
        if (!has_valid_numbers(e)) {
            return fmt::format("a number of environment {} is out of its range", e.name);
        }
        if (!has_valid_surfaces(bytecode, e)) {
            return fmt::format("a surface of environment {} is malformed", e.name);
        }
    }
    return std::nullopt;
}

bool changes_only_parameters(const Bytecode& bytecode, const BytecodeProduction& production) {
    const std::size_t at = production.successor.codes.first;
    if (production.successor.codes.count != 1 || at >= bytecode.template_codes.size() ||
        production.predecessor.first >= bytecode.patterns.size() ||
        bytecode.template_codes[at] >= bytecode.code_count()) {
        return false;
    }
    const SymbolId symbol = bytecode.patterns[production.predecessor.first].symbol;
    return bytecode.symbol_of(bytecode.template_codes[at]) == symbol &&
           std::none_of(bytecode.folded.begin(), bytecode.folded.end(),
                        [&](const FoldedModule& module) { return module.symbol == symbol; });
}

} // namespace lsys
