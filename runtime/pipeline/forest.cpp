// SPDX-License-Identifier: MIT
#include "runtime/pipeline/forest.h"

#include "compiler/instancing/instance.h"
#include "grammar/base/hash.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/dialect.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/base/size_text.h"
#include "runtime/forest/surroundings.h"
#include "runtime/meshing/texture.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/impl/drawing_end.h"
#include "runtime/pipeline/impl/mesh_files.h"
#include "runtime/pipeline/impl/moved_environments.h"
#include "runtime/pipeline/impl/surrounded_heroes.h"
#include "runtime/pipeline/impl/variety_note.h"
#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/setting_options.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/plant_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

namespace lsys {

namespace {

constexpr double kDefaultSize = 100.0; // m
constexpr std::uint64_t kDefaultCount = 1000;

/// Joins `folder` and a path relative to it. Removes `..`, unless a symbolic link makes the shorter
/// path another file. An untrusted path stays as it is: a shorter one in a message would tell that
/// the file exists.
std::string path_in(const std::string& folder, const std::string& path, const Project& project) {
    const std::filesystem::path whole = path_of(folder) / path_of(path);
    if (project.files.is_untrusted) {
        return path_text(whole);
    }
    const std::filesystem::path normal = whole.lexically_normal();
    std::error_code missing;
    return std::filesystem::equivalent(whole, normal, missing) ? path_text(normal)
                                                               : path_text(whole);
}

/// The reason why a file does not exist for the host.
std::string reason_of_absence(const std::string& path, const Project& project) {
    if (project.files.is_untrusted) {
        const Result<std::string> read = project.host.read_referenced_file(path, {0});
        if (!read) {
            return read.error().message;
        }
    }
    return "no such file or directory";
}

/// Axioms whose NoVariety note has been given: path of the file and offset of the axiom.
using NotedAxioms = std::set<std::pair<std::string, std::uint32_t>>;

/// Removes NoVariety notes from `diagnostics`: all notes if the species has one hero or `is_wanted`
/// is false, else the notes at places in `noted`. Adds the places of the remaining notes to
/// `noted`. Returns whether `diagnostics` had NoVariety notes.
bool drop_variety_notes(const SceneSpecies& species,
                        bool is_wanted,
                        const std::string& path,
                        NotedAxioms& noted,
                        Diagnostics& diagnostics) {
    Diagnostics left;
    bool has_variety_note = false;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        const bool is_variety_note = diagnostic.code == DiagnosticCode::NoVariety;
        has_variety_note = has_variety_note || is_variety_note;
        if (!is_variety_note || (species.cache.heroes != 1 && is_wanted &&
                                 noted.emplace(path, diagnostic.span.begin).second)) {
            left.add(diagnostic);
        }
    }
    diagnostics = std::move(left);
    return has_variety_note;
}

/// Makes a scene with one species per grammar.
Scene scene_of(const std::vector<std::string>& grammars) {
    Scene scene;
    scene.terrain.region = {0.0, 0.0, kDefaultSize, kDefaultSize};
    scene.placement.region = scene.terrain.region;
    scene.placement.count = kDefaultCount;
    for (const std::string& path : grammars) {
        SceneSpecies& species = scene.species.emplace_back();
        species.name = path_text(path_of(path).stem());
        species.grammar.path = path;
        scene.placement.species.emplace_back();
    }
    return scene;
}

/// Ends the step with an error at `place` in the scene, or without a place if `place` has no file.
Step::Ended fail_at(SourceSpan place, const Error& error, const LoadedScene& loaded, Step& step) {
    if (place.file == kNoFile || step.project().is_cancelled()) {
        return step.fail(error);
    }
    const bool is_limit = error.kind == ErrorKind::Limit;
    Diagnostic diagnostic =
        make_diagnostic(is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::BadSceneValue,
                        place, error.message);
    if (is_limit) {
        diagnostic.help.emplace_back("raise the limit with `--max-memory`");
    }
    step.diagnose(std::move(diagnostic), loaded.sources);
    return step.end(is_limit ? Stop::Limit : Stop::Failed);
}

/// Reads a file of a scene. Only a file that the user names on a command line may be a pipe.
Result<std::string> read_scene_file(const SceneFile& file,
                                    const std::string& path,
                                    const ReadLimit& limit,
                                    const Step& step) {
    return file.span.file == kNoFile ? step.read(path, limit) : step.read_referenced(path, limit);
}

Result<GreyMap> read_map(const SceneFile& file,
                         const std::string& folder,
                         std::uint32_t columns,
                         std::uint32_t rows,
                         const Step& step,
                         FileBudget& budget) {
    const std::string path = path_in(folder, file.path, step.project());
    const Result<std::string> bytes =
        read_scene_file(file, path, {~std::uint64_t{0}, budget.left}, step);
    if (!bytes) {
        return bytes.error();
    }
    const std::uint64_t left = budget.left - bytes.value().size();
    Result<GreyMap> map = columns != 0 ? read_grey_raw(bytes.value(), columns, rows, left)
                                       : read_grey_png(bytes.value(), left);
    if (!map) {
        return Error{fmt::format("cannot use `{}`: {}", path, map.error().message),
                     map.error().kind};
    }
    budget.take(map.value().values.size() * sizeof(std::uint16_t));
    return map;
}

Result<Terrain> make_terrain(const SceneTerrain& terrain,
                             const std::string& folder,
                             const Step& step,
                             FileBudget& budget) {
    switch (terrain.kind) {
    case TerrainKind::Flat:
        return Terrain::flat(terrain.region, terrain.base);
    case TerrainKind::Noise:
        return Terrain::noise(terrain.region, terrain.noise);
    case TerrainKind::HeightMap:
        break;
    }
    Result<GreyMap> map =
        read_map(terrain.map, folder, terrain.map_columns, terrain.map_rows, step, budget);
    if (!map) {
        return map.error();
    }
    return Terrain::height_map(terrain.region, std::move(map.value()), terrain.height_map);
}

/// Reads a picture of the ground; its path is relative to `folder`.
Result<std::shared_ptr<const Texture>> read_ground_picture(const SceneFile& file,
                                                           const std::string& folder,
                                                           const Step& step,
                                                           FileBudget& budget) {
    constexpr std::uint64_t kMaxPictureBytes = std::uint64_t{1} << 30;
    const std::string path = path_in(folder, file.path, step.project());
    const Result<std::string> bytes =
        read_scene_file(file, path, {kMaxPictureBytes, budget.left}, step);
    if (!bytes) {
        return bytes.error();
    }
    Result<Texture> picture = read_picture(bytes.value(), budget.left - bytes.value().size());
    if (!picture) {
        return Error{fmt::format("cannot use `{}`: {}", path, picture.error().message),
                     picture.error().kind};
    }
    return std::make_shared<const Texture>(std::move(picture.value()));
}

/// Reads the pictures of the ground, or reuses the pictures of `previous`.
Outcome<GroundPictures> make_ground_pictures(const LoadedScene& loaded,
                                             const PreviousForest& previous,
                                             const Project& project,
                                             FileBudget& budget) {
    Step step(project);
    const SceneTerrain& terrain = loaded.scene.terrain;
    GroundPictures ground{
        nullptr, nullptr, terrain.tile_x, terrain.tile_z, terrain.tile_width, terrain.tile_depth};
    const bool is_reused = previous.scene != nullptr &&
                           previous.scene->terrain.colour.path == terrain.colour.path &&
                           previous.scene->terrain.normals.path == terrain.normals.path;
    if (is_reused) {
        ground.colour = previous.grown->ground.colour;
        ground.normals = previous.grown->ground.normals;
    }
    struct Wanted {
        const SceneFile& file;
        std::shared_ptr<const Texture>& picture;
    };
    for (const Wanted& wanted :
         {Wanted{terrain.colour, ground.colour}, Wanted{terrain.normals, ground.normals}}) {
        if (wanted.file.path.empty()) {
            continue;
        }
        if (!is_reused) {
            auto read = read_ground_picture(wanted.file, loaded.folder, step, budget);
            if (!read) {
                return fail_at(
                    wanted.file.span,
                    Error{fmt::format("ground: {}", read.error().message), read.error().kind},
                    loaded, step);
            }
            wanted.picture = std::move(read.value());
        }
        budget.take(wanted.picture->texels.size());
    }
    return step.done(std::move(ground));
}

/// One stage of a species: its heroes with one number of generations, and the mesh files of its
/// grammar.
struct GrownStage {
    std::vector<ForestStage> stages; // one stage, or one for each case of Surroundings
    std::vector<SensedStage> sensed; // by stage; empty unless SceneSpecies::keeps_senses
    std::vector<UserMesh> user_meshes;
    Settings settings;      // settings of the grammar
    SourceSpan height_span; // place of `#set height` in the grammar
    std::shared_ptr<const SourceMap> sources;
    AxiomPlace axiom;
    bool can_reuse_branches = false; // some branch can be replaced by a recorded one
    /// The scene wants the species to sense neighbours, but no environment of its grammar reads
    /// shade.
    bool cannot_sense_neighbours = false;
    std::vector<BranchOrigin> origins; // by instance; empty if grow_stage() got no `origins_of`
    std::vector<std::string> programs; // names of environments of kind Program
};

/// The origins of the instances, by instance; empty if the cache has no origins.
std::vector<BranchOrigin> branch_origins(const InstanceCache& cache, const Bytecode& bytecode) {
    std::vector<BranchOrigin> origins;
    OriginPrinter printer(bytecode);
    for (const Origin& origin : cache.origins) {
        BranchOrigin& branch_origin = origins.emplace_back();
        if (origin.place == kNone) {
            branch_origin.text = "from the axiom";
        } else {
            printer.append(origin, branch_origin.text);
            branch_origin.place = position_of(origin, bytecode);
        }
    }
    return origins;
}

/// `origins_of`: index in GrownStage::stages of the stage whose origins are wanted.
Outcome<GrownStage> grow_stage(const SceneSpecies& species,
                               const std::string& path,
                               std::optional<std::uint32_t> generations,
                               bool is_first,
                               NotedAxioms& noted,
                               const Project& project,
                               FileBudget& budget,
                               std::optional<std::size_t> origins_of) {
    Step step(project);
    GrammarOptions options;
    options.dialect = species.dialect.text;
    options.bug_compatible = species.bug_compatible;
    options.system = species.system.text;
    options.generations = generations;
    for (const SceneDefinition& definition : species.definitions) {
        options.definitions.push_back({definition.name, definition.value});
    }
    const auto is_season = [](const Definition& each) { return each.name == "season"; };
    if (species.season &&
        std::none_of(options.definitions.begin(), options.definitions.end(), is_season)) {
        options.optional_definitions.push_back({"season", *species.season});
    }
    for (const auto& [key, values] : species.settings) {
        options.settings.push_back({key, values});
    }
    Grammar grammar;
    Project reading = project;
    if (species.grammar.span.file != kNoFile) { // only a file of a command line may be a pipe
        reading.host.read_file = project.host.read_referenced_file;
    }
    if (!step.take(load_grammar(path, options, reading), grammar)) {
        return step.end();
    }
    project.begin(LongStep::GrowHeroes);
    if (!grammar.program) {
        return step.fail(fmt::format("`{}` is compiled; a forest needs the grammar itself", path));
    }
    GrownStage grown;
    const std::uint32_t last_generation =
        generations.value_or(grammar.bytecode.generations.value_or(0));
    grown.axiom.span = grammar.program->axiom_span();
    grown.axiom.sources = grammar.sources;
    Diagnostics diagnostics;
    std::optional<InstancedSystem> system = compile_instanced(
        std::move(*grammar.program), grammar.names, *grammar.sources, species.rho, diagnostics);
    grown.axiom.is_noted = drop_variety_notes(species, is_first, path, noted, diagnostics);
    if (!step.diagnose(std::move(diagnostics), grammar.sources) || !system) {
        return step.end(Stop::Diagnosed);
    }
    grammar.program.reset();
    grammar.bytecode = std::move(system->bytecode);
    std::vector<EnvironmentMove> moves;
    for (const auto& [name, by] : species.moves) {
        moves.push_back({name, by});
    }
    move_environments(moves, grammar.bytecode);
    MeshFiles meshes;
    if (!step.take(read_mesh_files(path, grammar, project, budget), meshes)) {
        return step.end();
    }
    grown.user_meshes = std::move(meshes.meshes);
    grown.programs = program_names(grammar.bytecode);
    Project own_project = project; // with the commands for this species
    std::erase_if(own_project.environments, [&](const EnvironmentCommand& command) {
        return std::find(grown.programs.begin(), grown.programs.end(), command.name) ==
               grown.programs.end();
    });
    PlantSenses senses;
    if (!step.take(read_senses(path, grammar, own_project), senses)) {
        return step.end();
    }
    if (species.senses_surroundings && !senses_shade(grammar.bytecode)) {
        grown.cannot_sense_neighbours = true;
        return step.done(std::move(grown));
    }
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(grammar.bytecode);
    CacheOptions cache = species.cache;
    cache.senses = own_senses.get();
    cache.mesh_lengths = std::move(meshes.lengths);
    cache.looks = std::move(meshes.looks);
    cache.generations = last_generation;
    cache.depends_on_vertical = system->depends_on_vertical;
    cache.threads = project.threads;
    cache.limits = project.limits;
    cache.max_bytes = project.limits.max_bytes;
    cache.cancelled = project.host.cancelled;
    cache.origins = origins_of.has_value();
    std::vector<InstanceCache> caches;
    std::vector<SensedStage>* const sensed_stages = species.keeps_senses ? &grown.sensed : nullptr;
    CacheOutcome outcome =
        species.senses_surroundings
            ? grow_surrounded_heroes(grammar.bytecode, senses, cache, caches, sensed_stages)
            : make_sensing_cache(grammar.bytecode, senses, own_senses.get(), cache, sensed_stages);
    if (const std::optional<Stop> stop =
            report_drawing(outcome.derivation_end, outcome.drawing_end, grammar, step)) {
        return step.end(*stop);
    }
    if (!species.senses_surroundings) {
        caches.push_back(std::move(outcome.cache));
    }
    for (InstanceCache& each : caches) {
        grown.stages.push_back({last_generation, std::move(each), 0.0});
    }
    if (origins_of) {
        grown.origins = branch_origins(grown.stages.at(*origins_of).cache, grammar.bytecode);
    }
    const Settings& settings = grammar.bytecode.settings;
    grown.settings = settings;
    grown.height_span = grammar.height_span;
    grown.sources = grammar.sources;
    if (settings.pipe.is_set()) {
        // With a pipe model no branch is replaced by an instance, so every hero has all its tips.
        for (ForestStage& stage : grown.stages) {
            if (const std::optional<Stop> stop =
                    apply_pipe(settings.pipe, material_of(settings), project.limits.max_bytes,
                               stage.cache.skeleton)) {
                return step.end_too_large(*stop, "the pipe model");
            }
        }
    }
    if (settings.width_unit == WidthUnit::Pixels && !settings.pipe.is_set()) {
        for (ForestStage& stage : grown.stages) {
            apply_pixels(material_of(settings), stage.cache.skeleton);
        }
    }
    grown.can_reuse_branches = system->kind_count != 0 && species.rho > 0.0F;
    return step.done(std::move(grown));
}

/// Whether some branch of a hero was replaced by a recorded one.
bool has_hits(const ForestSpecies& species) {
    return std::any_of(species.stages.begin(), species.stages.end(), [](const ForestStage& stage) {
        return std::any_of(stage.cache.slots.begin(), stage.cache.slots.end(),
                           [](const InstanceSlot& slot) { return slot.hits != 0; });
    });
}

/// If the grammar has `#set height`, scales the heroes so that tree 0 of the last stage has this
/// height at scale 1, and sets `scale` to the factor; else scales them by `#set scale`. Returns
/// false if the plants are flat although the grammar or `wants_height` requires a height.
bool size_heroes(const Settings& settings,
                 bool wants_height,
                 ForestSpecies& species,
                 double& scale) {
    if (settings.height == 0.0F && settings.scale != 1.0F) {
        scale = static_cast<double>(settings.scale);
        for (ForestStage& stage : species.stages) {
            scale_cache(scale, material_of(settings), stage.cache);
        }
    }
    if (settings.height == 0.0F && !wants_height) {
        return true;
    }
    const InstanceCache& last = species.last_stage().cache;
    const HeightTable table = make_height_table(last);
    constexpr std::uint32_t kFirstTree = 0;
    const std::optional<double> height = TreeMeasure(last, table, 0).height_of(kFirstTree);
    if (height == 0.0) {
        return false;
    }
    if (height && settings.height != 0.0F) {
        species.height = settings.height;
        scale = static_cast<double>(settings.height) / *height;
        for (ForestStage& stage : species.stages) {
            scale_cache(scale, material_of(settings), stage.cache);
        }
    }
    return true;
}

/// Completes `sensed`, the stages of a species; null if it has no stages.
std::shared_ptr<const SensedHeroes>
finished(double scale, const ForestSpecies& species, SensedHeroes sensed) {
    if (sensed.stages.empty()) {
        return nullptr;
    }
    std::vector<const InstanceCache*> caches;
    for (const ForestStage& stage : species.stages) {
        caches.push_back(&stage.cache);
    }
    finish_sensed_heroes(scale, caches, sensed);
    return std::make_shared<const SensedHeroes>(std::move(sensed));
}

/// Ends the step with an error: `species` cannot sense its surroundings.
Step::Ended end_without_senses(const SceneSpecies& species,
                               const std::string& path,
                               const LoadedScene& loaded,
                               Step& step) {
    std::string message =
        fmt::format("`{}` senses neither shadow nor sky, so its plants cannot depend on the trees "
                    "around them",
                    path);
    if (species.surroundings_span.file == kNoFile) {
        return step.fail(std::move(message));
    }
    Diagnostic diagnostic = make_diagnostic(DiagnosticCode::BadSceneValue,
                                            species.surroundings_span, std::move(message));
    diagnostic.help.emplace_back("declare the light in the grammar, `#sense light shadow;`, and "
                                 "ask for it with a module: `?light(q, x, y, z)`");
    diagnostic.help.emplace_back("or write `surroundings = \"ignored\"`");
    step.diagnose(std::move(diagnostic), loaded.sources);
    return step.end(Stop::Diagnosed);
}

/// Whether all values on which heroes depend are equal, file names included.
bool has_same_heroes(const SceneSpecies& a, const SceneSpecies& b) {
    const auto same_definition = [](const SceneDefinition& one, const SceneDefinition& other) {
        return one.name == other.name && one.value == other.value;
    };
    return a.grammar.path == b.grammar.path && a.dialect.text == b.dialect.text &&
           a.system.text == b.system.text && a.bug_compatible == b.bug_compatible &&
           a.stages == b.stages && a.rho == b.rho && a.cache.heroes == b.cache.heroes &&
           a.cache.seed == b.cache.seed && a.cache.cap == b.cache.cap &&
           a.cache.tolerance == b.cache.tolerance && a.settings == b.settings &&
           a.senses_surroundings == b.senses_surroundings && a.season == b.season &&
           a.moves == b.moves && a.keeps_senses == b.keeps_senses &&
           std::equal(a.definitions.begin(), a.definitions.end(), b.definitions.begin(),
                      b.definitions.end(), same_definition);
}

/// The index of the species of the previous forest with the same heroes as `species`, or nothing.
std::optional<std::size_t> find_reusable(const SceneSpecies& species,
                                         const PreviousForest& previous) {
    if (previous.scene == nullptr) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < previous.scene->species.size(); ++i) {
        if (has_same_heroes(species, previous.scene->species[i])) {
            return i;
        }
    }
    return std::nullopt;
}

/// The error for an option that the placement does not read, and for a placement without a density;
/// empty: no error.
std::string placement_mistake(const SceneOverrides& overrides, const Scene& scene) {
    const PlacementMethod method = scene.placement.method;
    const bool reads_map =
        method == PlacementMethod::DensityMap || method == PlacementMethod::DensityCells;
    if (overrides.count && !reads_count(method)) {
        return "--count: of the placements, only uniform and domination have a number of trees; "
               "others have a --spacing or a --density";
    }
    if (overrides.spacing && !reads_spacing(method)) {
        return "--spacing: of the placements, only poisson-disk, jittered and poisson-cells have a "
               "distance between trees";
    }
    if (overrides.density && !reads_density(method)) {
        return "--density: of the placements, only density-map, density-cells and uniform-cells "
               "have a density";
    }
    if (!overrides.density_map.empty() && !reads_map) {
        return "--density-map: of the placements, only density-map and density-cells read a map";
    }
    if (reads_density(method) && scene.placement.density == 0.0) {
        return fmt::format("the placement has no density; `--density D` gives it, in trees per "
                           "square metre{}",
                           reads_map ? " where the map is white" : "");
    }
    return {};
}

} // namespace

bool is_scene(const std::string& path) {
    return path_of(path).extension() == ".toml";
}

Outcome<LoadedScene> load_scene(const std::vector<std::string>& files,
                                const SceneOverrides& overrides,
                                const Project& project) {
    Step step(project);
    LoadedScene loaded;
    const auto sources = std::make_shared<SourceMap>();
    loaded.sources = sources;
    if (std::none_of(files.begin(), files.end(), is_scene)) {
        loaded.scene = scene_of(files);
    } else if (files.size() > 1) {
        return step.fail("a scene names its grammars, so it stands alone");
    } else {
        const std::string& path = files.front();
        Result<std::string> text = step.read(path, {kMaxSourceBytes});
        if (!text) {
            return step.fail(text.error());
        }
        const FileId file = sources->add(shown_path(path), std::move(text.value()));
        Diagnostics diagnostics;
        std::optional<Scene> read = parse_scene(file, *sources, diagnostics);
        if (!step.diagnose(std::move(diagnostics), sources) || !read) {
            return step.end(Stop::Diagnosed);
        }
        loaded.scene = std::move(*read);
        loaded.folder = path_text(path_of(path).parent_path());
    }
    if (!values_of("seed", overrides.grammar.settings).empty()) {
        return step.fail("--set seed: plants of a forest have seeds of their own, from --seed");
    }
    if (const Result<void> applied = apply(overrides, loaded.scene); !applied) {
        return step.fail(applied.error());
    }
    if (std::string mistake = placement_mistake(overrides, loaded.scene); !mistake.empty()) {
        return step.fail(std::move(mistake));
    }
    return step.done(std::move(loaded));
}

Outcome<GrownForest>
grow_species(const LoadedScene& loaded, const Project& project, const PreviousForest& previous) {
    Step step(project);
    project.begin(LongStep::GrowHeroes);
    const Scene& scene = loaded.scene;
    GrownForest grown;
    FileBudget budget{project.limits.max_bytes};
    Result<Terrain> terrain = make_terrain(scene.terrain, loaded.folder, step, budget);
    if (!terrain) {
        return fail_at(
            scene.terrain.map.span,
            Error{fmt::format("terrain: {}", terrain.error().message), terrain.error().kind},
            loaded, step);
    }
    grown.terrain.emplace(std::move(terrain.value()));
    if (!scene.density_map.path.empty()) {
        Result<GreyMap> map = read_map(scene.density_map, loaded.folder, 0, 0, step, budget);
        if (!map) {
            return fail_at(scene.density_map.span, map.error(), loaded, step);
        }
        grown.density_map = std::move(map.value());
    }
    if (!step.take(make_ground_pictures(loaded, previous, project, budget), grown.ground)) {
        return step.end();
    }
    const Stopwatch growing;
    grown.forest.key = scene.placement.key;
    NotedAxioms noted;
    std::set<const Texture*> known_pictures; // already counted in the budget
    std::vector<std::string> programs;       // names of environments of kind Program
    for (const SceneSpecies& species : scene.species) {
        const std::string path = path_in(loaded.folder, species.grammar.path, project);
        if (!project.host.file_exists(path)) {
            return fail_at(
                species.grammar.span,
                Error{fmt::format("cannot read `{}`: {}", path, reason_of_absence(path, project))},
                loaded, step);
        }
        if (!species.dialect.text.empty() && !find_dialect(species.dialect.text)) {
            return fail_at(species.dialect.span,
                           Error{fmt::format("there is no dialect `{}`", species.dialect.text)},
                           loaded, step);
        }
        ForestSpecies& forest_species = grown.forest.species.emplace_back();
        forest_species.name = species.name;
        forest_species.senses_surroundings = species.senses_surroundings;
        forest_species.years_of_stage = years_of_stage(scene, grown.forest.species.size() - 1);
        std::vector<UserMesh>& meshes = grown.user_meshes.emplace_back();
        Messages& messages = grown.messages.emplace_back();
        const std::optional<std::size_t> reused =
            grown.reused_species.emplace_back(find_reusable(species, previous));
        if (reused) {
            messages = previous.grown->messages[*reused];
            step.messages.append(messages);
            grown.axioms.push_back(previous.grown->axioms[*reused]);
            grown.sensed.push_back(previous.grown->sensed[*reused]);
            forest_species.stages = previous.grown->forest.species[*reused].stages;
            forest_species.height = previous.grown->forest.species[*reused].height;
            meshes = previous.grown->user_meshes[*reused];
            for (const UserMesh& mesh : meshes) {
                const bool is_new =
                    mesh.picture != nullptr && known_pictures.insert(mesh.picture.get()).second;
                budget.take(mesh.byte_count() + (is_new ? mesh.picture->texels.size() : 0));
                if (mesh.normal_map != nullptr &&
                    known_pictures.insert(mesh.normal_map.get()).second) {
                    budget.take(mesh.normal_map->texels.size());
                }
            }
            continue;
        }
        GrownStage last;
        SensedHeroes sensed;
        const std::size_t stages = std::max<std::size_t>(species.stages.size(), 1);
        for (std::size_t i = 0; i < stages; ++i) {
            const std::optional<std::uint32_t> generations =
                species.stages.empty() ? std::nullopt : std::optional(species.stages[i]);
            for (const UserMesh& mesh : meshes) { // meshes of the previous stage
                budget.give_back(mesh.byte_count());
            }
            meshes.clear();
            Outcome<GrownStage> stage =
                grow_stage(species, path, generations, i == 0, noted, project, budget, {});
            messages.append(stage.messages());
            step.messages.append(stage.messages());
            if (!stage) {
                return step.end(stage.stop());
            }
            last = std::move(stage.value());
            programs.insert(programs.end(), last.programs.begin(), last.programs.end());
            if (last.cannot_sense_neighbours) {
                return end_without_senses(species, path, loaded, step);
            }
            std::move(last.stages.begin(), last.stages.end(),
                      std::back_inserter(forest_species.stages));
            std::move(last.sensed.begin(), last.sensed.end(), std::back_inserter(sensed.stages));
            meshes = std::move(last.user_meshes);
        }
        AxiomPlace& axiom = grown.axioms.emplace_back(last.axiom);
        if (last.can_reuse_branches && !has_hits(forest_species)) {
            axiom.is_noted = true;
            Messages note;
            note.add_info(
                fmt::format("{}: no branch was ever taken, because no two have equal keys, so "
                            "instancing adds nothing; --instance-tolerance lets them differ",
                            species.name));
            messages.append(note);
            step.messages.append(std::move(note));
        }
        const std::size_t index = grown.forest.species.size() - 1;
        const bool wants_height = scene.placement.species[index].max_height > 0.0F;
        double scale = 1.0;
        if (!size_heroes(last.settings, wants_height, forest_species, scale)) {
            const std::string message = fmt::format(
                "{}: its plants are flat, so they cannot be given a height", forest_species.name);
            if (species.height_span.file != kNoFile) {
                return fail_at(species.height_span, Error{message}, loaded, step);
            }
            if (wants_height) { // the option --height, since the scene has no height
                return step.fail("--height: " + message);
            }
            step.diagnose(make_diagnostic(DiagnosticCode::BadSetting, last.height_span, message),
                          last.sources);
            return step.end(Stop::Diagnosed);
        }
        grown.sensed.push_back(finished(scale, forest_species, std::move(sensed)));
    }
    // The environments of reused species are not known; their commands were checked before.
    const std::vector<std::optional<std::size_t>>& reused = grown.reused_species;
    if (std::all_of(reused.begin(), reused.end(), [](const auto& each) { return !each; })) {
        if (const Result<void> known = check_commands(project.environments, programs); !known) {
            return step.fail(known.error());
        }
    }
    measure_plants(grown.forest);
    grown.cache_seconds = growing.seconds();
    return step.done(std::move(grown));
}

double tallest_height(const GrownForest& grown, const Project& project) {
    return tallest_tree(grown.forest, project.threads);
}

Outcome<std::vector<BranchOrigin>> origins_of_branches(const SceneSpecies& species,
                                                       const std::string& folder,
                                                       std::size_t stage,
                                                       const Project& project) {
    Step step(project);
    const std::size_t cases = species.senses_surroundings ? kSurroundings : 1;
    const std::optional<std::uint32_t> generations =
        species.stages.empty() ? std::nullopt : std::optional(species.stages.at(stage / cases));
    FileBudget budget{project.limits.max_bytes};
    NotedAxioms noted;
    Outcome<GrownStage> grown =
        grow_stage(species, path_in(folder, species.grammar.path, project), generations, false,
                   noted, project, budget, stage % cases);
    if (!grown) { // warnings of a success were shown when the forest was grown
        step.messages.append(grown.messages());
        return step.end(grown.stop());
    }
    return step.done(std::move(grown.value().origins));
}

Step::Ended end_mesh_of_heroes(Stop stop, Step& step) {
    if (stop == Stop::Failed) {
        return step.fail(
            "the heroes have more than 4,294,967,295 vertices; ask for fewer --heroes, "
            "--sides or generations");
    }
    return step.end_too_large(stop, "the mesh of the heroes");
}

Outcome<std::vector<std::vector<InstanceMeshes>>>
mesh_forest(const GrownForest& grown, const MeshOptions& options, const Project& project) {
    Step step(project);
    MeshOptions limited = options;
    limited.threads = project.threads;
    limited.max_bytes = project.limits.max_bytes;
    std::vector<std::vector<InstanceMeshes>> meshes;
    for (std::size_t s = 0; s < grown.forest.species.size(); ++s) {
        std::vector<InstanceMeshes>& species_meshes = meshes.emplace_back();
        for (const ForestStage& stage : grown.forest.species[s].stages) {
            if (const std::optional<Stop> stop = make_instance_meshes(
                    stage.cache, grown.user_meshes[s], limited, species_meshes.emplace_back())) {
                return end_mesh_of_heroes(*stop, step);
            }
        }
    }
    return step.done(std::move(meshes));
}

PlacementOptions
placement_options(const Scene& scene, const Project& project, const GrownForest& grown) {
    PlacementOptions options = scene.placement;
    options.threads = project.threads;
    if (grown.density_map) {
        options.density_map = &*grown.density_map;
        options.map_region = scene.terrain.region;
    }
    return options;
}

std::vector<double> unit_heights(const Scene& scene, const GrownForest& grown) {
    std::vector<double> heights;
    for (std::size_t s = 0; s < grown.forest.species.size(); ++s) {
        const bool draws_height = scene.placement.species[s].max_height > 0.0F;
        heights.push_back(draws_height ? 1.0 : static_cast<double>(grown.forest.species[s].height));
    }
    return heights;
}

double max_scale(const PlacementOptions& options, const TreeSizer& sizer, std::uint16_t species) {
    const PlacementSpecies& placed = options.species[species];
    const float largest = placed.max_height > 0.0F ? placed.max_height : placed.max_scale;
    return static_cast<double>(largest) * sizer.max_factor(species);
}

double halo_of(const PlacementOptions& options, const Forest& kinds, const TreeSizer& sizer) {
    if (!has_sensed_surroundings(kinds)) {
        return 0.0;
    }
    std::vector<double> scales;
    for (std::size_t s = 0; s < kinds.species.size(); ++s) {
        scales.push_back(max_scale(options, sizer, static_cast<std::uint16_t>(s)));
    }
    constexpr double kRounding = 1.0 + 1e-6; // max rounding error of scales in binary32
    return kRounding * reach_of_surroundings(kinds, scales);
}

// Structured bindings list all members, so that a new member which the hash lacks does not compile.
std::uint64_t placement_digest(const Scene& scene,
                               const Project& project,
                               const GrownForest& grown,
                               const TreeSizer& sizer) {
    const PlacementOptions options = placement_options(scene, project, grown);
    const auto& [key, method, region, species, count, spacing, density, map, map_region, years,
                 stages_passed, threads] = options;
    static_cast<void>(threads);
    std::uint64_t state = combine_numbers(0, kTreePlacementVersion, key, method, region.x, region.z,
                                          region.width, region.depth, species.size(), count,
                                          spacing, density, years, stages_passed);
    for (const PlacementSpecies& each : species) {
        const auto& [share, min_scale, max_scale, min_height, max_height, lowest, highest, steepest,
                     growth, stages, start, years_of_stage] = each;
        state = combine_numbers(state, share, min_scale, max_scale, min_height, max_height, lowest,
                                highest, steepest, stages, start, years_of_stage);
        const auto& [rate, max_radius, tolerance, vigour_spread, lifespan, maturity, seeds,
                     seed_distance] = growth;
        state = combine_numbers(state, rate, max_radius, tolerance, vigour_spread, lifespan,
                                maturity, seeds, seed_distance);
    }
    if (map != nullptr) {
        const Region extent = map_region.value_or(region);
        state = combine_map(combine_numbers(state, extent.x, extent.z, extent.width, extent.depth),
                            *map);
    }
    const auto& [painted, erased] = scene.painting;
    state = combine_numbers(state, painted.size(), erased.size());
    for (const PaintedTree& tree : painted) {
        const auto& [kind, x, z, yaw, scale] = tree;
        state = combine_numbers(state, kind, x, z, yaw, scale);
    }
    for (const std::uint32_t number : erased) {
        state = combine(state, number);
    }
    for (const ForestSpecies& each : grown.forest.species) {
        for (const ForestStage& stage : each.stages) {
            state = combine_numbers(state, each.senses_surroundings, stage.crown_radius,
                                    stage.plant_height);
        }
    }
    return finish(combine_numbers(state, grown.terrain->digest(), sizer.digest()));
}

Outcome<void> size_forest(const Scene& scene, const Project& project, GrownForest& grown) {
    Step step(project);
    const std::vector<double> heights = unit_heights(scene, grown);
    if (std::all_of(heights.begin(), heights.end(), [](double each) { return each == 0.0; })) {
        return step.done();
    }
    if (const auto flat = size_trees(heights, project.threads, grown.forest)) {
        return step.fail(fmt::format("{}: a tree lies flat, so it cannot be given a height",
                                     grown.forest.species[*flat].name));
    }
    return step.done();
}

Outcome<void> sense_forest(const Scene& scene, const Project& project, GrownForest& grown) {
    Step step(project);
    Forest& forest = grown.forest;
    if (!has_sensed_surroundings(forest)) {
        return step.done();
    }
    LargeVector<Tree> around; // trees of the tile and of a border around it
    if (scene.is_tile) {
        PlacementOptions options = placement_options(scene, project, grown);
        const TreeSizer sizer(unit_heights(scene, grown), forest);
        options.region = widened(options.region, halo_of(options, forest, sizer));
        Result<Placement> placed = place_trees(options, *grown.terrain);
        if (!placed) {
            return step.fail(fmt::format("placement: {}", placed.error().message));
        }
        around = std::move(placed.value().trees);
        static_cast<void>(sizer.size(around));
        apply_painting(scene.painting, options.region, *grown.terrain, around);
    }
    const bool has_room = catch_out_of_memory(
        [&] {
            sense_surroundings(forest, scene.is_tile ? around : forest.trees, forest.trees,
                               project.threads);
            return true;
        },
        [] { return false; });
    if (!has_room) {
        return step.end_too_large(Stop::OutOfMemory, "the surroundings of the trees");
    }
    return step.done();
}

Outcome<void> place_forest(const Scene& scene, const Project& project, GrownForest& grown) {
    Step step(project);
    project.begin(LongStep::Place);
    const Stopwatch placing;
    const PlacementOptions options = placement_options(scene, project, grown);
    if (const Result<double> count = expected_places(options);
        count && count.value() * static_cast<double>(sizeof(Tree)) >
                     static_cast<double>(project.limits.max_bytes)) {
        return step.fail(Error{fmt::format("the list of about {:.0f} trees does not fit into {}",
                                           count.value(), byte_size_text(project.limits.max_bytes)),
                               ErrorKind::Limit});
    }
    Result<Placement> placed = place_trees(options, *grown.terrain);
    if (!placed) {
        return step.fail(fmt::format("placement: {}", placed.error().message));
    }
    grown.forest.trees = std::move(placed.value().trees);
    if (!step.take(size_forest(scene, project, grown))) {
        return step.end();
    }
    apply_painting(scene.painting, options.region, *grown.terrain, grown.forest.trees);
    if (!step.take(sense_forest(scene, project, grown))) {
        return step.end();
    }
    grown.placed = placed.value().report;
    grown.place_seconds = placing.seconds();
    if (std::string note = placement_note(grown.placed); !note.empty()) {
        step.messages.add_info(std::move(note));
    }
    note_variety(scene, grown, step);
    return step.done();
}

} // namespace lsys
