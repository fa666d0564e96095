// SPDX-License-Identifier: MIT
#include "runtime/export/impl/usda_variants.h"

#include "grammar/base/characters.h"
#include "grammar/base/contract.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/material_samples.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

namespace lsys {

namespace {

void collect_materials(UsdaVariants& variants) {
    bool textured = true;
    bool tangents = true;
    for (const Mesh* const mesh : variants.meshes) {
        std::vector<std::uint32_t>& numbers = variants.materials.emplace_back();
        for (const MeshPart& part : mesh->parts) {
            numbers.push_back(add_material(variants.samples, mesh->materials[part.material]));
        }
        textured = textured && is_complete(*mesh, mesh->texture_coordinates);
        tangents = tangents && is_complete(*mesh, mesh->tangents);
    }
    finish_samples(variants.samples, textured, tangents);
}

} // namespace

std::string usda_variant_name(const std::string& text) {
    std::string name = text;
    for (char& c : name) {
        c = is_letter(c) || is_digit(c) ? c : '_';
    }
    return name.empty() ? "_" : name;
}

std::optional<UsdaVariants> find_usda_variants(const Mesh& mesh, const ExportInfo& info) {
    UsdaVariants variants;
    variants.meshes.push_back(&mesh);
    if (info.coarser != nullptr && !info.coarser->empty()) {
        variants.set = "LOD";
        variants.names.emplace_back("LOD0");
        for (const CoarserMesh& coarser : *info.coarser) {
            variants.meshes.push_back(&coarser.mesh);
            variants.names.push_back(fmt::format("LOD{}", variants.names.size()));
            variants.coverages.push_back(coarser.coverage);
        }
        variants.coverages.push_back(0.0); // the last level is always shown
    } else if (info.variants != nullptr) {
        LSYS_CHECK(info.variants->names.size() == info.variants->others.size() + 1,
                   info.variants->names.size());
        variants.set = identifier(info.variants->set);
        for (const Mesh& other : info.variants->others) {
            variants.meshes.push_back(&other);
        }
        for (const std::string& name : info.variants->names) {
            variants.names.push_back(unique_name(variants.names, usda_variant_name(name)));
        }
    } else {
        return std::nullopt;
    }
    collect_materials(variants);
    return variants;
}

} // namespace lsys
