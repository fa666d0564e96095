// SPDX-License-Identifier: MIT
// USD as text (OpenUSD, "UsdGeomMesh", "UsdPreviewSurface specification",
// https://openusd.org/release/): one mesh, its parts as subsets bound to materials; moving plants
// with a skin; a choice of several meshes as a variant set. v of texture coordinates goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"
#include "runtime/export/impl/usda_skin.h"
#include "runtime/export/impl/usda_variants.h"
#include "runtime/export/impl/usdz.h"

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Indices of the corners of all parts, read in rising order.
struct PartCursor {
    const Mesh& mesh;
    TriangleReader indices{mesh.indices};
    std::size_t part = 0;
    std::uint64_t first = 0; // number of corners of earlier parts

    std::uint32_t index(std::uint64_t corner) {
        while (corner - first >= mesh.parts[part].index_count / 3 * 3) {
            first += mesh.parts[part].index_count / 3 * 3;
            ++part;
        }
        return indices[mesh.parts[part].first_index + (corner - first)];
    }
};

/// `motion` may be null.
void put_header(const ExportInfo& info, const UsdaMotion* motion, PieceWriter& out) {
    // USDA has the escapes of JSON for all characters that one_line() leaves.
    out.put(fmt::format("#usda 1.0\n"
                        "(\n"
                        "    defaultPrim = \"Plant\"\n"
                        "    doc = \"{}: {}\"\n"
                        "    metersPerUnit = {}\n"
                        "    upAxis = \"{}\"\n",
                        json_text(one_line(info.generator)), json_text(origin_line(info)),
                        metres_per_unit(info.unit), usda_axis(info.up)));
    if (motion != nullptr) {
        put_usda_times(motion->poses, out);
    }
    out.put(fmt::format("    customLayerData = {{\n"
                        "        string generator = \"{}\"\n"
                        "        string grammar = \"{}\"\n"
                        "        uint64 seed = {}\n"
                        "        uint n = {}\n"
                        "    }}\n"
                        ")\n\n",
                        json_text(one_line(info.generator)), json_text(one_line(info.grammar)),
                        info.seed, info.generations));
}

constexpr std::string_view kRoot = "/Plant";

/// `name`: of the prim; `names`: of the materials of the parts. `put_skin` may be empty.
void put_mesh(const Mesh& mesh,
              const std::string& name,
              const std::vector<std::string>& names,
              const std::function<void()>& put_skin,
              PieceWriter& out) {
    PartCursor cursor{mesh};
    put_usda_surface(
        out, {mesh, name, mesh.positions.size(), mesh.parts, names, kRoot, put_skin},
        [](std::uint64_t i) { return i; }, [](const glm::vec3& v, bool) { return v; },
        [&cursor](std::uint64_t i) { return cursor.index(i); });
}

/// Writes a plant with variants. The prim of the first mesh lies outside of the variant set, for
/// readers without variants; the variants of the other meshes make this prim inactive. The prim
/// itself must not set `active`, because its value would override the values that the variants set.
void put_choice(const ExportJob& job, const UsdaVariants& variants, PieceWriter& out) {
    put_header(job.info, nullptr, out);
    out.put(fmt::format("def Xform \"Plant\" (\n"
                        "    kind = \"component\"\n"
                        "    variants = {{\n"
                        "        string {0} = \"{1}\"\n"
                        "    }}\n"
                        "    prepend variantSets = \"{0}\"\n",
                        variants.set, variants.names.front()));
    if (!variants.coverages.empty()) {
        out.put(fmt::format("    customData = {{\n        double[] screenCoverage = [{}]\n    }}\n",
                            fmt::join(variants.coverages, ", ")));
    }
    out.put(")\n{\n");
    out.put(usda_turn(job.info.up));
    const std::vector<std::string> names = usda_part_names(variants.samples);
    const auto put_variant_mesh = [&](std::size_t i, const std::string& name) {
        std::vector<std::string> of_parts;
        for (const std::uint32_t number : variants.materials[i]) {
            of_parts.push_back(names[number]);
        }
        put_mesh(*variants.meshes[i], name, of_parts, {}, out);
    };
    put_variant_mesh(0, "Mesh");
    out.put(fmt::format("\n    variantSet \"{}\" = {{\n    \"{}\" {{\n    }}\n", variants.set,
                        variants.names.front()));
    for (std::size_t i = 1; i < variants.meshes.size(); ++i) {
        out.put(fmt::format("    \"{}\" {{\n"
                            "    over \"Mesh\" (\n"
                            "        active = false\n"
                            "    )\n"
                            "    {{\n"
                            "    }}\n",
                            variants.names[i]));
        put_variant_mesh(i, "Mesh_" + variants.names[i]);
        out.put("    }\n");
    }
    out.put("    }\n");
    put_usda_materials(variants.samples, names, job.info, kRoot, out);
    out.put("}\n");
}

void put_layer(const ExportJob& job, const UsdaMotion* motion, PieceWriter& out) {
    if (const std::optional<UsdaVariants> variants = find_usda_variants(job.mesh, job.info)) {
        put_choice(job, *variants, out);
        return;
    }
    const Mesh& mesh = job.mesh;
    const std::vector<std::string> names = usda_part_names(mesh);
    put_header(job.info, motion, out);
    out.put(fmt::format("def {} \"Plant\" (\n    kind = \"component\"\n)\n{{\n",
                        motion != nullptr ? "SkelRoot" : "Xform"));
    out.put(usda_turn(job.info.up));
    std::function<void()> put_skin;
    if (motion != nullptr) {
        put_skin = [&] { put_usda_joints(mesh, *motion, kRoot, out); };
    }
    put_mesh(mesh, "Mesh", names, put_skin, out);
    if (motion != nullptr) {
        put_usda_skeleton(*motion, kRoot, out);
    }
    put_usda_materials(mesh, names, job.info, kRoot, out);
    out.put("}\n");
}

/// Makes the skin of an animated plant, and calls `write` with its motion, or with null if the
/// plant stands still.
template <typename Write>
Outcome<void> with_motion(const ExportJob& job, const Write& write) {
    const PlantAnimation* const poses = job.info.animation;
    if (poses == nullptr) {
        return write(nullptr);
    }
    if (job.info.max_joints != 0) {
        const UsdaMotion motion{{}, *poses, make_bones(job.skeleton, *poses, job.info.max_joints)};
        return write(&motion);
    }
    std::optional<Skin> skin = make_skin(job.mesh, job.skeleton, *poses);
    if (!skin) {
        return too_many_joints();
    }
    const UsdaMotion motion{std::move(*skin), *poses, {}};
    return write(&motion);
}

} // namespace

Outcome<void> write_usda(const ExportJob& job, PieceWriter& out) {
    return with_motion(job, [&](const UsdaMotion* motion) {
        put_layer(job, motion, out);
        return finish(out);
    });
}

Outcome<void> write_usdz(const ExportJob& job, PieceWriter& out) {
    ExportInfo info = job.info;
    info.picture_prefix = "plant";
    const ExportJob inside{job.mesh, job.skeleton, info};
    const std::optional<UsdaVariants> variants = find_usda_variants(job.mesh, info);
    const Mesh& materials = variants ? variants->samples : job.mesh;
    return with_motion(inside, [&](const UsdaMotion* motion) {
        return write_usdz_archive(
            {info.subject, "plant.usda",
             [&](PieceWriter& layer) { put_layer(inside, motion, layer); },
             find_pictures(materials, ExportPictures::FilesWithNormalMaps, info).list,
             info.threads},
            out);
    });
}

} // namespace lsys
