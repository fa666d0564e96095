// SPDX-License-Identifier: MIT
// Writes a small forest in every format and variant. Usage: write_forest FOLDER
// Two species, one of two stages, on a hilly ground. facts.json in the folder has its counts and
// bounds, measured on the same forest as one mesh (baked.ply); counts.txt has a line
// `NAME VERTICES TRIANGLES PARTS` for each glTF file that needs no extension.
#include "compiler/instancing/instance.h"
#include "runtime/export/export_forest.h"
#include "runtime/terrain/terrain.h"
#include "tests/compiler/compile_text.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kTrees = 240;

bool complain(const std::string& what) {
    std::fprintf(stderr, "%s\n", what.c_str());
    return false;
}

bool add_stage(const std::string& grammar,
               std::uint32_t generations,
               ForestSpecies& species,
               std::vector<InstanceMeshes>& meshes) {
    CompileOptions compile;
    compile.generations = generations;
    test::Compiled compiled = test::compile_text(grammar, compile);
    if (!compiled.outcome.program) {
        return complain("no program");
    }
    std::optional<InstancedSystem> system =
        compile_instanced(std::move(*compiled.outcome.program), compiled.names, compiled.sources,
                          0.6F, compiled.diagnostics);
    if (!system) {
        return complain("no instanced system");
    }
    ForestStage& stage = species.stages.emplace_back();
    stage.generations = generations;
    CacheOptions options;
    options.generations = generations;
    options.depends_on_vertical = system->depends_on_vertical;
    CacheOutcome outcome = make_instance_cache(system->bytecode, options);
    if (!outcome.ok()) {
        return complain("no heroes");
    }
    stage.cache = std::move(outcome.cache);
    return !make_instance_meshes(stage.cache, {}, {}, meshes.emplace_back()) ||
           complain("no surfaces");
}

ByteSink into(std::ofstream& file) {
    return [&file](std::string_view bytes) {
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file.good();
    };
}

bool write_forest(const fs::path& path,
                  const ForestScene& scene,
                  ExportFormat format,
                  ForestForm form,
                  const ForestExportInfo& info) {
    std::ofstream file(path, std::ios::binary);
    return export_forest(scene, format, form, info, into(file)).ok() ||
           complain(path.string() + ": not written");
}

std::string facts_of(const ForestScene& scene, const Mesh& baked_mesh) {
    Bounds bounds;
    for (const glm::vec3& at : baked_mesh.positions) {
        bounds.add(at);
    }
    std::uint64_t branches = 0;
    for (const Tree& tree : scene.forest.trees) {
        const InstanceCache& cache = scene.forest.cache_of(tree);
        const std::vector<InstanceMeshes>& meshes = scene.meshes[tree.species];
        TreeExpander expander(cache, scene.forest.key);
        expander.expand(tree, [&](const BranchInstance& branch) {
            branches += meshes[scene.forest.stage_of(tree)].triangle_count_of(branch.instance) > 0;
        });
    }
    return fmt::format(R"({{"trees":{},"branches":{},"triangles":{},"vertices":{},)"
                       R"("ground_triangles":{},"low":[{},{},{}],"high":[{},{},{}]}})"
                       "\n",
                       scene.forest.trees.size(), branches, baked_mesh.indices.size() / 3,
                       baked_mesh.positions.size(), scene.ground->indices.size() / 3, bounds.low.x,
                       bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z);
}

} // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: write_forest FOLDER\n", stderr);
        return 2;
    }
    const fs::path folder = arguments[1];
    fs::remove_all(folder);
    fs::create_directories(folder);

    Forest forest;
    forest.key = 0xFFFFFFFFFFFFFFFF; // too large for readers that store JSON numbers as doubles
    std::vector<std::vector<InstanceMeshes>> meshes(2);
    forest.species.resize(2);
    forest.species[0].name = "bush \"one\"";
    forest.species[1].name = "7 pine";
    forest.species[1].years_of_stage = 10.0F;
    const std::string bush = "#set names letters; #object l LEAF; #w : A;"
                             "#p : A : ~ 0.5 : F[+Al][-A]/A; #q : A : ~ 0.5 : F[+A]//Al;";
    const std::string pine =
        "#set turtle houdini; #set names letters; #w : A;"
        "#p : A : ~ 0.6 : F![&B][//&B]/A; #q : A : ~ 0.4 : F[^B]/A; #r : B : * : F![+F]B;";
    if (!add_stage(bush, 5, forest.species[0], meshes[0]) ||
        !add_stage(pine, 3, forest.species[1], meshes[1]) ||
        !add_stage(pine, 5, forest.species[1], meshes[1])) {
        return 1;
    }
    Region region;
    region.width = 200.0;
    region.depth = 160.0;
    const Result<Terrain> terrain = Terrain::noise(region, {});
    if (!terrain) {
        return 1;
    }
    TerrainMeshOptions ground_options;
    ground_options.columns = 20;
    ground_options.rows = 16;
    const Result<Mesh> ground = make_terrain_mesh(terrain.value(), ground_options);
    if (!ground) {
        return 1;
    }
    for (std::uint32_t i = 0; i < kTrees; ++i) {
        Tree tree;
        tree.number = i;
        tree.position.x = static_cast<float>(region.x) + static_cast<float>(i * 37 % 200);
        tree.position.z = static_cast<float>(region.z) + static_cast<float>(i * 59 % 160);
        tree.position.y = terrain.value().height(tree.position.x, tree.position.z);
        tree.yaw = 0.37F * static_cast<float>(i);
        tree.scale = 0.8F + 0.4F * static_cast<float>(i % 11) / 10.0F;
        tree.species = static_cast<std::uint16_t>(i % 3 == 0 ? 1 : 0);
        tree.age = static_cast<std::uint16_t>(1 + i % 20);
        forest.trees.push_back(tree);
    }
    const ForestScene scene{forest, meshes, &ground.value()};
    ForestExportInfo info;
    info.name = "a <small> \"forest\"";
    info.generator = "write_forest";
    info.cell = 50.0F;
    info.picture_prefix = "forest";
    bool succeeded = true;
    for (const ExportFormat format : export_formats()) {
        const FormatTraits& traits = traits_of(format);
        const auto path = [&](const char* name) {
            return folder / fmt::format("{}.{}", name, traits.name);
        };
        if (traits.write_forest != nullptr) {
            succeeded = write_forest(path("forest"), scene, format, ForestForm::Instanced, info) &&
                        succeeded;
        }
        if (traits.expands_forest) {
            succeeded = write_forest(path("expanded"), scene, format, ForestForm::Expanded, info) &&
                        succeeded;
        }
    }
    for (const auto& [name, compression] : {std::pair{"quantize", ExportCompression::Quantize},
                                            std::pair{"meshopt", ExportCompression::Meshopt}}) {
        ForestExportInfo compressed_info = info;
        compressed_info.compression = compression;
        for (const auto& [prefix, form] : {std::pair{"forest", ForestForm::Instanced},
                                           std::pair{"expanded", ForestForm::Expanded}}) {
            succeeded = write_forest(folder / fmt::format("{}.{}.glb", prefix, name), scene,
                                     ExportFormat::Glb, form, compressed_info) &&
                        succeeded;
        }
    }
    const auto pictures = make_forest_picture_files(scene, ExportFormat::Usda, info);
    for (const PictureFile& picture : pictures.value()) {
        std::ofstream(folder / picture.name, std::ios::binary) << picture.bytes;
    }
    const Outcome<Mesh> bake = bake_forest(scene, ~std::uint64_t{0}, 0);
    const Mesh& baked_mesh = bake.value();
    for (const char* extension : {"ply", "glb", "gltf"}) {
        std::ofstream file(folder / (std::string("baked.") + extension), std::ios::binary);
        const auto format = format_of_path(std::string("baked.") + extension);
        succeeded = export_mesh(baked_mesh, {}, *format, {}, into(file)).ok() && succeeded;
    }
    const std::string facts = facts_of(scene, baked_mesh);
    std::ofstream(folder / "facts.json") << facts;
    std::ofstream(folder / "stats.json")
        << forest_stats_json(scene, {.different_trees = true, .threads = 0}) << '\n';
    std::ofstream counts(folder / "counts.txt");
    for (const char* name : {"expanded", "baked"}) {
        counts << name << ' ' << baked_mesh.positions.size() << ' ' << baked_mesh.indices.size() / 3
               << ' ' << baked_mesh.parts.size() << '\n';
    }
    return succeeded && counts.good() ? 0 : 1;
}
