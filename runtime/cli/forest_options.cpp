#include "runtime/cli/option_parsers.h"
#include "runtime/scene/scene.h"

#include <charconv>
#include <limits>
#include <string_view>

namespace lsys::lsc {

namespace {

/// `column,row,size`.
Result<ForestTile> parse_tile(const std::string& text) {
    const Error wrong{
        fmt::format("`{}` is not column,row,size: two whole numbers and metres", text)};
    ForestTile tile;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::int64_t* part : {&tile.column, &tile.row}) {
        const auto [next, failure] = std::from_chars(at, end, *part);
        if (failure != std::errc() || next == end || *next != ',') {
            return wrong;
        }
        at = next + 1;
    }
    const Result<float> size =
        parse_number(std::string_view(at, static_cast<std::size_t>(end - at)), 0.0F, 1e6F);
    constexpr std::int64_t kMost = 1'000'000;
    if (!size || size.value() == 0.0F || tile.column < -kMost || tile.column > kMost ||
        tile.row < -kMost || tile.row > kMost) {
        return wrong;
    }
    tile.size = static_cast<double>(size.value());
    return tile;
}

auto metres(float least) {
    return [least](const std::string& text) { return parse_number(text, least, 1e6F); };
}

void add_placement(CLI::App& app, ForestCommand& command, const char* size) {
    const char* const group = "Placement";
    add_choice<std::optional<PlacementMethod>>(
        app, "--placement", command.method,
        {{"uniform", PlacementMethod::Uniform},
         {"poisson-disk", PlacementMethod::PoissonDisk},
         {"density-map", PlacementMethod::DensityMap},
         {"domination", PlacementMethod::Domination},
         {"jittered", PlacementMethod::Jittered},
         {"uniform-cells", PlacementMethod::UniformCells},
         {"poisson-cells", PlacementMethod::PoissonCells},
         {"density-cells", PlacementMethod::DensityCells}},
        "How trees are placed (default uniform); the last four make tiles that fit")
        ->group(group);
    add_parsed(app, "--count", command.count, whole(0, kMaxTrees),
               "Trees of uniform placement, or plants of the first year of domination "
               "(default 1000)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, size, command.size, metres(1e-3F),
               "Side of the ground, a square from the origin on (default 100)")
        ->type_name("METRES")
        ->group(group);
    add_parsed(app, "--spacing", command.spacing, metres(1e-3F),
               "Distance of trees: of the grid for jittered, the least for poisson-disk and "
               "poisson-cells")
        ->type_name("METRES")
        ->group(group);
    add_parsed(
        app, "--density", command.density,
        [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); },
        "Trees a square metre; where the density map is white")
        ->type_name("D")
        ->group(group);
    app.add_option("--density-map", command.density_map, "A grey PNG that spans the ground")
        ->type_name("FILE")
        ->group(group);
    add_parsed(app, "--years", command.years, whole(0, kMaxYears),
               "Years that a forest of domination grows")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--tile", command.tile, parse_tile,
               "One tile of an unbounded forest, a square of SIZE metres; neighbours fit, "
               "wherever they are made")
        ->type_name("COLUMN,ROW,SIZE")
        ->group(group);
}

void add_cache(CLI::App& app, ForestCommand& command) {
    const char* const group = "Instances";
    add_parsed(app, "--heroes", command.heroes, whole(1, kMaxHeroes),
               "Plants of each species that are derived whole (default 10)")
        ->type_name("H")
        ->group(group);
    add_parsed(app, "--rho", command.rho, fraction,
               "Probability that a branch is taken from recorded ones (default 0.6)")
        ->type_name("P")
        ->group(group);
    add_parsed(app, "--cache-cap", command.cache_cap,
               whole(0, std::numeric_limits<std::uint32_t>::max()),
               "The most branches kept for one key; 0: all (default 0)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--instance-tolerance", command.tolerance, fraction,
               "Part by which values of one key may differ (default 0: not at all)")
        ->type_name("T")
        ->group(group);
}

} // namespace

void add_forest_scene(CLI::App& app, ForestCommand& command, const char* size) {
    add_parsed(app, "--key", command.key,
               whole(0, static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())),
               "What the forest is made from: the same key, the same forest (default 0)")
        ->type_name("K");
    add_placement(app, command, size);
    add_cache(app, command);
}

void add_forest(CLI::App& app, ForestCommand& command) {
    app.add_option("FILE", command.files, "A scene (.toml), or grammars, one for each species")
        ->required();
    app.add_option("-o,--output", command.output,
                   "The file, whose name tells the format: glb, gltf or usda with instances, json "
                   "statistics; with --bake also obj, ply, off or stl")
        ->type_name("FILE");
    app.add_flag("--check", command.check, "Read the scene and its grammars, write nothing");
    app.add_flag("--stats", command.stats,
                 "Print trees, branches, how many trees differ, and what the caches hold");
    app.add_flag("--expand", command.expand,
                 "glTF without EXT_mesh_gpu_instancing: a node for each branch");
    app.add_flag("--bake", command.bake, "One mesh of all triangles");
    add_parsed(app, "--cell", command.cell, metres(0.0F),
               "Side of the squares of ground whose trees are instanced together; 0: all are "
               "(default 100)")
        ->type_name("METRES");
    add_forest_scene(app, command, "--size");
    constexpr std::uint64_t kMostFrames = 10'000;
    add_parsed(app, "--frames", command.frames, whole(0, kMostFrames),
               "Write the forest of domination so many times while it grows, as a numbered series")
        ->type_name("N")
        ->group("Placement");
    add_parsed(app, "--sides", command.mesh.sides, whole(kMinSides, kMaxSides),
               "Sides of every cross-section, instead of the grammar's")
        ->type_name("N")
        ->group("Mesh");
    constexpr std::uint64_t kMaxLevel = 8;
    add_parsed(app, "--level", command.mesh.level, whole(0, kMaxLevel),
               "Level of detail, 0 the finest (default 0)")
        ->type_name("K")
        ->group("Mesh");
    add_parsed(app, "--droop", command.mesh.droop, fraction,
               "Bending of leaves by gravity, 0 to 1 (default 0)")
        ->type_name("D")
        ->group("Mesh");
    add_grammar(app, command.grammar);
    add_seed(app, command.seed);
    add_run_limits(app, command.max_bytes, command.threads);
    add_messages(app, command.messages);
    add_deny(app, command.messages);
    app.footer("Options take the place of what the scene says; -n, -D and the options of instances "
               "are for every\nspecies. samples/scenes shows scenes.\n"
               "Examples: lsc forest wood.toml -o wood.glb\n"
               "          lsc forest oak.lsys birch.lsys --count 10000 --size 500 -o wood.glb\n"
               "          lsc forest wood.toml --stats\n"
               "          lsc forest pine.lsys --placement jittered --spacing 4 --tile 0,1,100 -o "
               "tile.glb");
}

} // namespace lsys::lsc
