// SPDX-License-Identifier: MIT
#include "runtime/export/impl/material_samples.h"

#include "runtime/export/impl/text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace lsys {

namespace {

bool same(const Material& a, const Material& b) {
    return a.name == b.name && a.kind == b.kind && a.colour == b.colour &&
           a.two_sided == b.two_sided && a.cut_out == b.cut_out && a.textured == b.textured &&
           a.picture == b.picture && a.normal_map == b.normal_map && a.roughness == b.roughness &&
           a.translucency == b.translucency;
}

} // namespace

std::uint32_t add_material(Mesh& samples, const Material& material) {
    const auto found =
        std::find_if(samples.materials.begin(), samples.materials.end(),
                     [&material](const Material& other) { return same(material, other); });
    if (found != samples.materials.end()) {
        return static_cast<std::uint32_t>(found - samples.materials.begin());
    }
    const auto number = static_cast<std::uint32_t>(samples.materials.size());
    samples.materials.push_back(material);
    samples.parts.push_back({number, 0, 3});
    return number;
}

void finish_samples(Mesh& samples, bool textured, bool tangents) {
    std::vector<std::string> names;
    for (Material& material : samples.materials) {
        material.name = unique_name(names, material.name);
        names.push_back(material.name);
    }
    samples.positions.resize(1);
    samples.texture_coordinates.resize(textured ? 1 : 0);
    samples.tangents.resize(tangents ? 1 : 0);
}

} // namespace lsys
