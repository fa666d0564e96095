// Forests as USD text: a PointInstancer for each species and stage (OpenUSD,
// "UsdGeomPointInstancer"). Prototypes are the instances, each with vertices of its own, relative
// to its entry: older readers take orientations as half floats, whose rounding would displace
// vertices far from the origin. `orientationsf` has orientations as floats.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

namespace {

class UsdaForest {
public:
    UsdaForest(const ForestScene& scene,
               const ForestPlan& plan,
               const ForestExportInfo& info,
               PieceWriter& out)
        : scene_(scene), plan_(plan), info_(info), out_(out),
          materials_(find_forest_materials(scene, plan)),
          names_(usda_part_names(materials_.samples)) {}

    void write() {
        put_header();
        out_.put("def Xform \"Forest\" (\n    kind = \"assembly\"\n)\n{\n");
        if (scene_.ground != nullptr && triangle_count(*scene_.ground) > 0) {
            put_ground(*scene_.ground);
        }
        std::vector<std::string> names{"Ground", "Materials"};
        for (std::size_t k = 0; k < plan_.kinds().size(); ++k) {
            const ForestKind& kind = plan_.kinds()[k];
            names.push_back(
                unique_name(names, identifier(scene_.forest.species[kind.species].name)));
            if (count_used(kind) > 0) {
                put_instancer(kind, materials_.of_kinds[k], names.back());
            }
        }
        ExportInfo pictures;
        pictures.textures = info_.textures;
        pictures.picture_prefix = info_.picture_prefix;
        put_usda_materials(materials_.samples, names_, pictures, "/Forest", out_);
        out_.put("}\n");
    }

private:
    [[nodiscard]] std::uint32_t count_used(const ForestKind& kind) const {
        const auto uses = std::span(plan_.uses()).subspan(kind.first, kind.cache->instances.size());
        return static_cast<std::uint32_t>(
            std::count_if(uses.begin(), uses.end(), [](std::uint64_t n) { return n > 0; }));
    }

    void put_header() {
        out_.put(fmt::format("#usda 1.0\n"
                             "(\n"
                             "    defaultPrim = \"Forest\"\n"
                             "    doc = \"{0}\"\n"
                             "    metersPerUnit = 1\n"
                             "    upAxis = \"Y\"\n"
                             "    customLayerData = {{\n"
                             "        string generator = \"{0}\"\n"
                             "        string scene = \"{1}\"\n"
                             "        uint64 key = {2}\n"
                             "        uint64 trees = {3}\n"
                             "        uint64 branches = {4}\n"
                             "    }}\n"
                             ")\n\n",
                             json_text(one_line(info_.generator)), json_text(one_line(info_.name)),
                             scene_.forest.key, scene_.forest.trees.size(), plan_.branches()));
    }

    /// Material names of the parts. `materials`: index in names_ of each material of their mesh.
    [[nodiscard]] std::vector<std::string>
    names_of(std::span<const MeshPart> parts, const std::vector<std::uint32_t>& materials) const {
        std::vector<std::string> names;
        for (const MeshPart& part : parts) {
            names.push_back(names_[materials[part.material]]);
        }
        return names;
    }

    void put_ground(const Mesh& mesh) {
        TriangleReader indices(mesh.indices);
        const std::vector<std::string> names = names_of(mesh.parts, materials_.of_ground);
        put_usda_surface(
            out_, {mesh, "Ground", mesh.positions.size(), mesh.parts, names, "/Forest"},
            [](std::uint64_t i) { return i; }, [](const glm::vec3& v, bool) { return v; },
            [&](std::uint64_t i) { return indices[mesh.parts[0].first_index + i]; });
    }

    void put_instancer(const ForestKind& kind,
                       const std::vector<std::uint32_t>& materials,
                       const std::string& name) {
        out_.put(fmt::format("    def PointInstancer \"{}\"\n    {{\n", name));
        prototypes_.assign(kind.cache->instances.size(), 0);
        std::vector<std::uint32_t> used;
        for (std::uint32_t i = 0; i < kind.cache->instances.size(); ++i) {
            if (plan_.uses()[kind.first + i] > 0) {
                prototypes_[i] = static_cast<std::uint32_t>(used.size());
                used.push_back(i);
            }
        }
        out_.put("        rel prototypes = [");
        for (std::size_t p = 0; p < used.size(); ++p) {
            out_.put(
                fmt::format("{}</Forest/{}/Prototypes/I{}>", p == 0 ? "" : ", ", name, used[p]));
        }
        out_.put("]\n");
        put_branches(kind);
        out_.put("        def Scope \"Prototypes\"\n        {\n");
        const InstanceVertices own = number_vertices(kind, plan_);
        for (const std::uint32_t i : used) {
            const Instance& instance = kind.cache->instances[i];
            const glm::dquat back = glm::conjugate(instance.frame);
            const std::span<const std::uint32_t> vertices = own.of(i);
            const std::span<const MeshPart> parts = kind.meshes->parts_of(i);
            const std::vector<std::string> names = names_of(parts, materials);
            put_usda_surface(
                out_,
                {kind.meshes->mesh, fmt::format("I{}", i), vertices.size(), parts, names,
                 "/Forest"},
                [vertices](std::uint64_t k) { return vertices[k]; },
                [&](const glm::vec3& v, bool place) {
                    return glm::vec3(
                        back * (glm::dvec3(v) - (place ? instance.position : glm::dvec3(0.0))));
                },
                [&](std::uint64_t k) { return own.indices[parts[0].first_index + k]; });
        }
        out_.put("        }\n    }\n");
    }

    /// Writes each part of the transforms as an array of its own, by one pass over the trees.
    void put_branches(const ForestKind& kind) {
        put_array("int[] protoIndices", kind, [this](const BranchInstance& branch, char* at) {
            return put_number(at, std::uint64_t{prototypes_[branch.instance]});
        });
        put_array("point3f[] positions", kind, [](const BranchInstance& branch, char* at) {
            const glm::vec3& p = branch.position;
            return put_tuple<3>(at, {p.x, p.y, p.z});
        });
        for (const std::string_view array : {"quath[] orientations", "quatf[] orientationsf"}) {
            put_array(array, kind, [](const BranchInstance& branch, char* at) {
                const glm::quat q = glm::normalize(branch.rotation);
                return put_tuple<4>(at, {q.w, q.x, q.y, q.z});
            });
        }
        put_array("float3[] scales", kind, [](const BranchInstance& branch, char* at) {
            return put_tuple<3>(at, {branch.scale, branch.scale, branch.scale});
        });
    }

    template <typename Put>
    void put_array(std::string_view what, const ForestKind& kind, const Put& put) {
        out_.put(fmt::format("        {} = [", what));
        std::uint64_t count = 0;
        for (const ForestCell& cell : plan_.cells()) {
            plan_.for_each_branch(cell, [&](const ForestKind& of, std::uint32_t instance,
                                            const BranchInstance& branch) {
                if (&of != &kind || plan_.uses()[instance] == 0 || out_.stopped()) {
                    return;
                }
                char* at = out_.room(kUsdaItemBytes + kNumberBytes);
                at = put_text(at, count == 0                       ? ""
                                  : count % kUsdaItemsPerLine == 0 ? ",\n            "
                                                                   : ", ");
                out_.used(put(branch, at));
                ++count;
            });
        }
        out_.put("]\n");
    }

    const ForestScene& scene_;
    const ForestPlan& plan_;
    const ForestExportInfo& info_;
    PieceWriter& out_;
    ForestMaterials materials_;
    std::vector<std::string> names_;        // of materials
    std::vector<std::uint32_t> prototypes_; // of each instance, its number among those used
};

} // namespace

Outcome<void> write_forest_usda(const ForestExportJob& job, PieceWriter& out) {
    const ForestPlan& plan = job.plan;
    // Integers of USD are signed.
    constexpr std::uint64_t kMax = 0x7FFFFFFF;
    for (const ForestKind& kind : plan.kinds()) {
        if (kind.meshes->mesh.positions.size() > kMax) {
            return too_large_for_format(ExportSubject::Forest);
        }
    }
    if (plan.branches() > kMax) {
        return too_large_for_format(ExportSubject::Forest);
    }
    UsdaForest(job.scene, plan, job.info, out).write();
    return finish(out);
}

} // namespace lsys
