// USD as text (OpenUSD, "UsdGeomMesh", "UsdPreviewSurface specification",
// https://openusd.org/release/): one mesh, its parts as subsets bound to materials. v of texture
// coordinates goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"

#include <fmt/format.h>

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

void put_header(const ExportInfo& info, PieceWriter& out) {
    // For the characters that one_line() leaves, USDA has the escapes of JSON.
    out.put(fmt::format("#usda 1.0\n"
                        "(\n"
                        "    defaultPrim = \"Plant\"\n"
                        "    doc = \"{}: {}\"\n"
                        "    metersPerUnit = {}\n"
                        "    upAxis = \"Y\"\n"
                        "    customLayerData = {{\n"
                        "        string generator = \"{}\"\n"
                        "        string grammar = \"{}\"\n"
                        "        uint64 seed = {}\n"
                        "        uint n = {}\n"
                        "    }}\n"
                        ")\n\n",
                        json_text(one_line(info.generator)), json_text(origin_line(info)),
                        metres_per_unit(info.unit), json_text(one_line(info.generator)),
                        json_text(one_line(info.grammar)), info.seed, info.generations));
}

} // namespace

Outcome<void> write_usda(const ExportJob& job, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    const std::vector<std::string> names = usda_part_names(mesh);
    put_header(job.info, out);
    out.put("def Xform \"Plant\" (\n    kind = \"component\"\n)\n{\n");
    PartCursor cursor{mesh};
    put_usda_surface(
        out, {mesh, "Mesh", mesh.positions.size(), mesh.parts, names, "/Plant"},
        [](std::uint64_t i) { return i; }, [](const glm::vec3& v, bool) { return v; },
        [&cursor](std::uint64_t i) { return cursor.index(i); });
    put_usda_materials(mesh, names, job.info, "/Plant", out);
    out.put("}\n");
    return finish(out);
}

} // namespace lsys
