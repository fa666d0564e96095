// USD as text (OpenUSD, "UsdGeomMesh", "UsdPreviewSurface specification",
// https://openusd.org/release/): one mesh, its parts as subsets bound to materials; moving plants
// with a skin. v of texture coordinates goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"
#include "runtime/export/impl/usda_skin.h"
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
    std::uint64_t first = 0; // corners of the parts before

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
    // For the characters that one_line() leaves, USDA has the escapes of JSON.
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

void put_layer(const ExportJob& job, const UsdaMotion* motion, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    constexpr std::string_view kRoot = "/Plant";
    const std::vector<std::string> names = usda_part_names(mesh);
    put_header(job.info, motion, out);
    out.put(fmt::format("def {} \"Plant\" (\n    kind = \"component\"\n)\n{{\n",
                        motion != nullptr ? "SkelRoot" : "Xform"));
    out.put(usda_turn(job.info.up));
    PartCursor cursor{mesh};
    std::function<void()> put_skin;
    if (motion != nullptr) {
        put_skin = [&] { put_usda_joints(mesh, *motion, kRoot, out); };
    }
    put_usda_surface(
        out, {mesh, "Mesh", mesh.positions.size(), mesh.parts, names, kRoot, put_skin},
        [](std::uint64_t i) { return i; }, [](const glm::vec3& v, bool) { return v; },
        [&cursor](std::uint64_t i) { return cursor.index(i); });
    if (motion != nullptr) {
        put_usda_skeleton(*motion, kRoot, out);
    }
    put_usda_materials(mesh, names, job.info, kRoot, out);
    out.put("}\n");
}

/// Makes the skin of a plant that moves, and calls `write` with its motion or null.
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
    return with_motion(inside, [&](const UsdaMotion* motion) {
        return write_usdz_archive(
            {info.subject, "plant.usda",
             [&](PieceWriter& layer) { put_layer(inside, motion, layer); },
             find_pictures(job.mesh, ExportPictures::FilesWithRelief, info).list, info.threads},
            out);
    });
}

} // namespace lsys
