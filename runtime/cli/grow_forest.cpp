#include "runtime/cli/grow_forest.h"

#include "compiler/instance.h"
#include "grammar/dialect.h"
#include "runtime/cli/files.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/plant.h"
#include "runtime/cli/stopwatch.h"
#include "runtime/cli/tell.h"
#include "runtime/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <ostream>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

namespace lsys::lsc {

namespace {

std::string path_in(const std::string& folder, const std::string& path) {
    return (std::filesystem::path(folder) / path).string();
}

/// An error about a file or another name, where the scene has it.
Status
fail_at(SourceSpan place, const Error& error, const SourceMap& sources, const Console& console) {
    if (place.file == kNoFile) {
        return fail(error, console);
    }
    const bool is_limit = error.kind == ErrorKind::Limit;
    Diagnostics diagnostics;
    Diagnostic& diagnostic =
        diagnostics.add(is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::BadSceneValue,
                        place, error.message);
    if (is_limit) {
        diagnostic.help.emplace_back("raise the limit with `--max-memory`");
    }
    static_cast<void>(console.show(diagnostics, sources));
    return is_limit ? Status::Limit : Status::Failure;
}

Result<GreyMap> read_map(const std::string& path,
                         std::uint32_t columns,
                         std::uint32_t rows,
                         const Console& console,
                         FileBudget& budget) {
    const Result<std::string> bytes = read_file(path, {~std::uint64_t{0}, budget.left}, console);
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
                             const Console& console,
                             FileBudget& budget) {
    switch (terrain.kind) {
    case TerrainKind::Flat:
        return Terrain::flat(terrain.region, terrain.base);
    case TerrainKind::Noise:
        return Terrain::noise(terrain.region, terrain.noise);
    case TerrainKind::HeightMap:
        break;
    }
    Result<GreyMap> map = read_map(path_in(folder, terrain.map.path), terrain.map_columns,
                                   terrain.map_rows, console, budget);
    if (!map) {
        return map.error();
    }
    return Terrain::height_map(terrain.region, std::move(map.value()), terrain.height_map);
}

/// The heroes of one species with one number of generations.
Status grow_stage(const SceneSpecies& species,
                  const std::string& path,
                  std::optional<std::uint32_t> generations,
                  const ForestLimits& limits,
                  const Console& console,
                  FileBudget& budget,
                  ForestStage& stage,
                  std::vector<UserMesh>& user_meshes,
                  std::vector<std::string>& files) {
    GrammarOptions options;
    options.dialect = species.dialect.text;
    options.bug_compatible = species.bug_compatible;
    options.system = species.system.text;
    options.generations = generations;
    options.max_modules = limits.max_modules;
    options.max_bytes = limits.max_bytes;
    for (const SceneDefinition& definition : species.definitions) {
        options.definitions.push_back({definition.name, definition.value});
    }
    Grammar grammar;
    const Status loaded = load_grammar(path, options, console, grammar);
    files.insert(files.end(), grammar.included.begin(), grammar.included.end());
    if (loaded != Status::Fine) {
        return loaded;
    }
    if (!grammar.program) {
        return fail(Error{fmt::format("`{}` is compiled; a forest needs the grammar itself", path)},
                    console);
    }
    Diagnostics diagnostics;
    stage.generations = generations.value_or(grammar.bytecode->generations.value_or(0));
    std::optional<InstancedSystem> system = compile_instanced(
        std::move(*grammar.program), grammar.names, grammar.sources, species.rho, diagnostics);
    const Status shown = console.show(diagnostics, grammar.sources);
    if (!system) {
        return shown;
    }
    grammar.program.reset();
    grammar.bytecode = std::move(system->bytecode);
    CacheOptions cache = species.cache;
    cache.generations = stage.generations;
    cache.knows_up = system->knows_up;
    cache.threads = limits.threads;
    cache.limits = {limits.max_modules, limits.max_bytes};
    cache.max_bytes = limits.max_bytes;
    cache.cancelled = console.io().interrupted;
    for (const UserMesh& mesh : user_meshes) { // those of the stage before
        budget.give_back(mesh.byte_count());
    }
    user_meshes.clear();
    const std::string folder = std::filesystem::path(path).parent_path().string();
    for (const BytecodeSymbol& symbol : grammar.bytecode->symbols) {
        if (symbol.turtle == TurtleOperation::MeshFile) {
            files.push_back(path_in(folder, symbol.mesh_file));
        }
    }
    const Status read =
        read_user_meshes(path, *grammar.bytecode, console, budget, user_meshes, cache.mesh_lengths);
    for (const UserMesh& mesh : user_meshes) {
        files.insert(files.end(), mesh.files.begin(), mesh.files.end());
    }
    if (read != Status::Fine) {
        return read;
    }
    const CacheOutcome outcome = make_instance_cache(*grammar.bytecode, cache, stage.cache);
    const bool interpreted = outcome.drawn != TurtleStatus::NotInterpreted;
    const Status derived = tell(interpreted ? outcome.derived : DeriveStatus::Error, outcome.error,
                                outcome.limit, cache.limits, grammar, console);
    if (derived != Status::Fine) {
        return derived;
    }
    const Status drawn =
        tell_drawn(outcome.drawn, outcome.faults, limits.max_bytes, grammar, console);
    const bool any_hit = std::any_of(stage.cache.slots.begin(), stage.cache.slots.end(),
                                     [](const InstanceSlot& slot) { return slot.hits != 0; });
    if (drawn == Status::Fine && system->kind_count != 0 && species.rho > 0.0F && !any_hit) {
        console.info(fmt::format("{}: no branch was ever taken, because no two have equal keys, so "
                                 "instancing adds nothing; --instance-tolerance lets them differ",
                                 species.name));
    }
    return drawn;
}

/// They are grown into the same heroes, from the same files.
bool is_grown_alike(const SceneSpecies& a, const SceneSpecies& b) {
    const auto same_definition = [](const SceneDefinition& one, const SceneDefinition& other) {
        return one.name == other.name && one.value == other.value;
    };
    return a.grammar.path == b.grammar.path && a.dialect.text == b.dialect.text &&
           a.system.text == b.system.text && a.bug_compatible == b.bug_compatible &&
           a.stages == b.stages && a.rho == b.rho && a.cache.heroes == b.cache.heroes &&
           a.cache.seed == b.cache.seed && a.cache.cap == b.cache.cap &&
           a.cache.tolerance == b.cache.tolerance &&
           std::equal(a.definitions.begin(), a.definitions.end(), b.definitions.begin(),
                      b.definitions.end(), same_definition);
}

/// Where `known` has what `species` asks for; none: nowhere.
std::optional<std::size_t> find_known(const SceneSpecies& species, const KnownForest& known) {
    if (known.scene == nullptr) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < known.scene->species.size(); ++i) {
        if (is_grown_alike(species, known.scene->species[i])) {
            return i;
        }
    }
    return std::nullopt;
}

} // namespace

Status
load_scene(const std::string& path, const Console& console, SourceMap& sources, Scene& scene) {
    Result<std::string> text = read_file(path, {kMaxSourceBytes}, console);
    if (!text) {
        return fail(text.error(), console);
    }
    const FileId file = sources.add(shown_path(path), std::move(text.value()));
    Diagnostics diagnostics;
    std::optional<Scene> read = parse_scene(file, sources, diagnostics);
    const Status shown = console.show(diagnostics, sources);
    if (!read) {
        return worse(shown, Status::AuthorErrors);
    }
    scene = std::move(*read);
    return shown;
}

Status grow_species(const Scene& scene,
                    const SourceMap& sources,
                    const std::string& folder,
                    const ForestLimits& limits,
                    const Console& console,
                    GrownForest& grown,
                    const KnownForest& known) {
    // All that may have to be looked at again, whether or not it can be read now.
    for (const SceneFile* const map : {&scene.terrain.map, &scene.density_map}) {
        if (!map->path.empty()) {
            grown.files.push_back(path_in(folder, map->path));
        }
    }
    for (const SceneSpecies& species : scene.species) {
        grown.files.push_back(path_in(folder, species.grammar.path));
    }
    if (known.grown != nullptr) {
        // Of what is not read again.
        grown.files.insert(grown.files.end(), known.grown->files.begin(), known.grown->files.end());
    }
    FileBudget budget{limits.max_bytes};
    Result<Terrain> terrain = make_terrain(scene.terrain, folder, console, budget);
    if (!terrain) {
        return fail_at(
            scene.terrain.map.span,
            Error{fmt::format("terrain: {}", terrain.error().message), terrain.error().kind},
            sources, console);
    }
    grown.terrain.emplace(std::move(terrain.value()));
    if (!scene.density_map.path.empty()) {
        Result<GreyMap> map =
            read_map(path_in(folder, scene.density_map.path), 0, 0, console, budget);
        if (!map) {
            return fail_at(scene.density_map.span, map.error(), sources, console);
        }
        grown.density_map = std::move(map.value());
    }
    const Clock::time_point start = Clock::now();
    grown.forest.key = scene.placement.key;
    std::set<const Texture*> known_pictures; // that are counted
    for (const SceneSpecies& species : scene.species) {
        std::error_code ignored;
        if (!std::filesystem::exists(path_in(folder, species.grammar.path), ignored)) {
            return fail_at(
                species.grammar.span,
                Error{fmt::format("there is no file `{}`", path_in(folder, species.grammar.path))},
                sources, console);
        }
        if (!species.dialect.text.empty() && !find_dialect(species.dialect.text)) {
            return fail_at(species.dialect.span,
                           Error{fmt::format("there is no dialect `{}`", species.dialect.text)},
                           sources, console);
        }
        ForestSpecies& made = grown.forest.species.emplace_back();
        made.name = species.name;
        made.years_of_stage = species.years_of_stage;
        std::vector<UserMesh>& meshes = grown.user_meshes.emplace_back();
        const std::optional<std::size_t> at = grown.known.emplace_back(find_known(species, known));
        std::string& said = grown.said.emplace_back();
        if (at) {
            said = known.grown->said[*at];
            console.io().err << said << std::flush;
            made.stages = known.grown->forest.species[*at].stages;
            meshes = known.grown->user_meshes[*at];
            for (const UserMesh& mesh : meshes) {
                const bool is_new =
                    mesh.picture != nullptr && known_pictures.insert(mesh.picture.get()).second;
                budget.take(mesh.byte_count() + (is_new ? mesh.picture->texels.size() : 0));
            }
            continue;
        }
        const std::size_t stages = std::max<std::size_t>(species.stages.size(), 1);
        for (std::size_t i = 0; i < stages; ++i) {
            const std::optional<std::uint32_t> generations =
                species.stages.empty() ? std::nullopt : std::optional(species.stages[i]);
            std::ostringstream text;
            const Io& io = console.io();
            const Console heard(
                {io.in, io.out, text, io.err_is_terminal, io.interrupted, io.program},
                console.options());
            const Status status =
                grow_stage(species, path_in(folder, species.grammar.path), generations, limits,
                           heard, budget, made.stages.emplace_back(), meshes, grown.files);
            said += text.str();
            io.err << text.str() << std::flush;
            if (status != Status::Fine) {
                return status;
            }
        }
    }
    std::sort(grown.files.begin(), grown.files.end());
    grown.files.erase(std::unique(grown.files.begin(), grown.files.end()), grown.files.end());
    grown.cache_seconds = seconds_since(start);
    return Status::Fine;
}

Status place_forest(const Scene& scene,
                    const ForestLimits& limits,
                    const Console& console,
                    GrownForest& grown) {
    const Clock::time_point start = Clock::now();
    PlacementOptions options = scene.placement;
    options.threads = limits.threads;
    if (grown.density_map) {
        options.density_map = &*grown.density_map;
        options.map_region = scene.terrain.region;
    }
    Result<Placement> placed = place_trees(options, *grown.terrain);
    if (!placed) {
        return fail(Error{fmt::format("placement: {}", placed.error().message)}, console);
    }
    grown.forest.trees = std::move(placed.value().trees);
    apply_painting(scene.painting, options.region, *grown.terrain, grown.forest.trees);
    grown.placed = placed.value().report;
    grown.place_seconds = seconds_since(start);
    if (const std::string note = placement_note(grown.placed); !note.empty()) {
        console.info(note);
    }
    return Status::Fine;
}

} // namespace lsys::lsc
