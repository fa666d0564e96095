// SPDX-License-Identifier: MIT
// Forests as USD text: a PointInstancer for each species and stage (OpenUSD,
// "UsdGeomPointInstancer"). Each instance is a prototype with vertices of its own, relative to the
// frame in which the instance begins: orientations are half floats, and their rounding would
// displace vertices far from the origin.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/half_digits.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"
#include "runtime/export/impl/usdz.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

class UsdaForest {
public:
    UsdaForest(const ForestScene& scene, const ForestPlan& plan, const ForestExportInfo& info)
        : scene_(scene), plan_(plan), info_(info), materials_(find_forest_materials(scene, plan)),
          names_(usda_part_names(materials_.samples)) {}

    [[nodiscard]] const Mesh& material_samples() const { return materials_.samples; }
    /// Writes the layer. May be called several times.
    void write(PieceWriter& out) {
        out_ = &out;
        put_header();
        out_->put("def Xform \"Forest\" (\n    kind = \"assembly\"\n)\n{\n");
        out_->put(usda_place(info_.up, info_.unit, info_.pivot));
        if (scene_.ground != nullptr && triangle_count(*scene_.ground) > 0) {
            put_ground(*scene_.ground);
        }
        std::vector<std::string> names{"Ground", "Materials"};
        for (std::size_t k = 0; k < plan_.stages().size(); ++k) {
            const ExportedStage& stage = plan_.stages()[k];
            names.push_back(
                unique_name(names, identifier(scene_.forest.species[stage.species].name)));
            if (count_used(stage) > 0) {
                put_instancer(stage, materials_.of_stages[k], names.back());
            }
        }
        ExportInfo pictures;
        pictures.textures = info_.textures;
        pictures.picture_prefix = info_.picture_prefix;
        put_usda_materials(materials_.samples, names_, pictures, "/Forest", *out_);
        out_->put("}\n");
    }

private:
    [[nodiscard]] std::uint32_t count_used(const ExportedStage& stage) const {
        const auto uses =
            std::span(plan_.instance_counts()).subspan(stage.first, stage.cache->instances.size());
        return static_cast<std::uint32_t>(
            std::count_if(uses.begin(), uses.end(), [](std::uint64_t n) { return n > 0; }));
    }

    void put_header() {
        out_->put(fmt::format("#usda 1.0\n"
                              "(\n"
                              "    defaultPrim = \"Forest\"\n"
                              "    doc = \"{0}\"\n"
                              "    metersPerUnit = {6}\n"
                              "    upAxis = \"{5}\"\n"
                              "    customLayerData = {{\n"
                              "        string generator = \"{0}\"\n"
                              "        string scene = \"{1}\"\n"
                              "        uint64 key = {2}\n"
                              "        uint64 trees = {3}\n"
                              "        uint64 branches = {4}\n"
                              "    }}\n"
                              ")\n\n",
                              json_text(one_line(info_.generator)), json_text(one_line(info_.name)),
                              scene_.forest.key, scene_.forest.trees.size(), plan_.branch_count(),
                              usda_axis(info_.up), metres_per_unit(info_.unit)));
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
            *out_, {mesh, "Ground", mesh.positions.size(), mesh.parts, names, "/Forest", {}},
            [](std::uint64_t i) { return i; }, [](const glm::vec3& v, bool) { return v; },
            [&](std::uint64_t i) { return indices[mesh.parts[0].first_index + i]; });
    }

    void put_instancer(const ExportedStage& stage,
                       const std::vector<std::uint32_t>& materials,
                       const std::string& name) {
        out_->put(fmt::format("    def PointInstancer \"{}\"\n    {{\n", name));
        prototypes_.assign(stage.cache->instances.size(), 0);
        std::vector<std::uint32_t> used;
        for (std::uint32_t i = 0; i < stage.cache->instances.size(); ++i) {
            if (plan_.instance_counts()[stage.first + i] > 0) {
                prototypes_[i] = static_cast<std::uint32_t>(used.size());
                used.push_back(i);
            }
        }
        out_->put("        rel prototypes = [");
        for (std::size_t p = 0; p < used.size(); ++p) {
            out_->put(
                fmt::format("{}</Forest/{}/Prototypes/I{}>", p == 0 ? "" : ", ", name, used[p]));
        }
        out_->put("]\n");
        const InstanceVertices instance_vertices = number_vertices(stage, plan_);
        std::vector<float> sizes; // m, largest extent of each prototype
        for (const std::uint32_t i : used) {
            Bounds bounds;
            for (const std::uint32_t vertex : instance_vertices.of(i)) {
                bounds.add(stage.meshes->mesh.positions[vertex]);
            }
            const glm::vec3 extent = bounds.high - bounds.low;
            sizes.push_back(std::max({extent.x, extent.y, extent.z}));
        }
        const float largest = sizes.empty() ? 0.0F : *std::max_element(sizes.begin(), sizes.end());
        put_branches(stage, place_digits(largest));
        out_->put("        def Scope \"Prototypes\"\n        {\n");
        for (const std::uint32_t i : used) {
            const Instance& instance = stage.cache->instances[i];
            const glm::dquat back = glm::conjugate(instance.frame);
            const std::span<const std::uint32_t> vertices = instance_vertices.of(i);
            const std::span<const MeshPart> parts = stage.meshes->parts_of(i);
            const std::vector<std::string> names = names_of(parts, materials);
            const std::string prim = fmt::format("I{}", i);
            const UsdaDigits digits{.points = place_digits(sizes[prototypes_[i]])};
            put_usda_surface(
                *out_,
                {stage.meshes->mesh, prim, vertices.size(), parts, names, "/Forest", {}, digits},
                [vertices](std::uint64_t k) { return vertices[k]; },
                [&](const glm::vec3& v, bool place) {
                    return glm::vec3(
                        back * (glm::dvec3(v) - (place ? instance.position : glm::dvec3(0.0))));
                },
                [&](std::uint64_t k) {
                    return instance_vertices.indices[parts[0].first_index + k];
                });
        }
        out_->put("        }\n    }\n");
    }

    /// Writes the prototypes and transforms of all instances, each array by a pass over the trees.
    /// Scales are left out if all are 1, because the time to read text grows with its size.
    /// `place_digits`: decimals of positions.
    void put_branches(const ExportedStage& stage, int place_digits) {
        bool scaled = false;
        put_array("int[] protoIndices", stage, [&](const BranchInstance& branch, char* at) {
            scaled = scaled || branch.scale != 1.0F;
            return put_number(at, std::uint64_t{prototypes_[branch.instance]});
        });
        put_array("point3f[] positions", stage, [&](const BranchInstance& branch, char* at) {
            const glm::vec3& p = branch.position;
            return put_tuple<3>(at, {p.x, p.y, p.z}, place_digits);
        });
        put_array("quath[] orientations", stage, [this](const BranchInstance& branch, char* at) {
            const glm::quat q = glm::normalize(branch.rotation);
            for (const auto& [before, part] :
                 {std::pair{"(", q.w}, {", ", q.x}, {", ", q.y}, {", ", q.z}}) {
                at = halves_.put(put_text(at, before), part);
            }
            return put_text(at, ")");
        });
        if (!scaled) {
            return;
        }
        put_array("float3[] scales", stage, [](const BranchInstance& branch, char* at) {
            // Six significant digits: a relative error of at most 5 millionths.
            const char* const end = fmt::format_to(at + 1, FMT_COMPILE("{:.6g}"), branch.scale);
            const std::string_view digits(at + 1, static_cast<std::size_t>(end - at - 1));
            *at = '(';
            at += 1 + digits.size();
            at = put_text(put_text(at, ", "), digits);
            at = put_text(put_text(at, ", "), digits);
            return put_text(at, ")");
        });
    }

    template <typename Put>
    void put_array(std::string_view what, const ExportedStage& stage, const Put& put) {
        out_->put(fmt::format("        {} = [", what));
        std::uint64_t count = 0;
        for (const ForestCell& cell : plan_.cells()) {
            plan_.for_each_branch(cell, [&](const ExportedStage& of, std::uint32_t instance,
                                            const BranchInstance& branch) {
                if (&of != &stage || plan_.instance_counts()[instance] == 0 || out_->stopped()) {
                    return;
                }
                char* at = out_->room(kUsdaItemBytes + kNumberBytes);
                at = put_text(at, count == 0                       ? ""
                                  : count % kUsdaItemsPerLine == 0 ? ",\n            "
                                                                   : ", ");
                out_->advance_to(put(branch, at));
                ++count;
            });
        }
        out_->put("]\n");
    }

    const ForestScene& scene_;
    const ForestPlan& plan_;
    const ForestExportInfo& info_;
    PieceWriter* out_ = nullptr; // set by write()
    ForestMaterials materials_;
    std::vector<std::string> names_;        // of materials
    std::vector<std::uint32_t> prototypes_; // of each instance: its number among the used instances
    HalfDigits halves_;
};

/// Whether USD can count the vertices and branches: its integers are signed.
bool is_countable(const ForestPlan& plan) {
    constexpr std::uint64_t kMax = 0x7FFFFFFF;
    return plan.branch_count() <= kMax &&
           std::all_of(plan.stages().begin(), plan.stages().end(), [](const ExportedStage& stage) {
               return stage.meshes->mesh.positions.size() <= kMax;
           });
}

} // namespace

Outcome<void> write_forest_usda(const ForestExportJob& job, PieceWriter& out) {
    if (!is_countable(job.plan)) {
        return too_large_for_format(ExportSubject::Forest);
    }
    UsdaForest(job.scene, job.plan, job.info).write(out);
    return finish(out);
}

Outcome<void> write_forest_usdz(const ForestExportJob& job, PieceWriter& out) {
    if (!is_countable(job.plan)) {
        return too_large_for_format(ExportSubject::Forest);
    }
    ForestExportInfo info = job.info;
    info.picture_prefix = "forest";
    ExportInfo pictures;
    pictures.textures = info.textures;
    pictures.picture_prefix = info.picture_prefix;
    UsdaForest forest(job.scene, job.plan, info);
    return write_usdz_archive(
        {ExportSubject::Forest, "forest.usda",
         [&forest](PieceWriter& layer) { forest.write(layer); },
         find_pictures(forest.material_samples(), ExportPictures::FilesWithNormalMaps, pictures)
             .list,
         info.threads},
        out);
}

} // namespace lsys
