// SPDX-License-Identifier: MIT
#include "runtime/cli/tile_options.h"

#include "grammar/base/number_chars.h"
#include "runtime/program/arguments.h"
#include "runtime/program/option_parsers.h"
#include "runtime/program/policy_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <system_error>

namespace lsys::lsc {

namespace {

/// Parses `9.7,47.2,430`: degrees and metres, the height may be left out.
Result<GeoPlace> parse_geo_place(const std::string& text) {
    // In binary64: degrees in binary32 are off by up to a metre.
    const auto part = [&text](std::size_t from, double bound) -> Result<double> {
        const std::string word = text.substr(from, text.find(',', from) - from);
        double value = 0.0;
        const auto [end, error] = number_from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() ||
            !(value >= -bound && value <= bound)) {
            return Error{fmt::format("`{}` is not a number from {} to {}", word, -bound, bound)};
        }
        return value;
    };
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (first == std::string::npos ||
        (second != std::string::npos && text.find(',', second + 1) != std::string::npos)) {
        return Error{fmt::format("`{}` is not LONGITUDE,LATITUDE,HEIGHT", text)};
    }
    const Result<double> longitude = part(0, 180.0);
    const Result<double> latitude = part(first + 1, 90.0);
    const Result<double> height =
        second == std::string::npos ? Result<double>(0.0) : part(second + 1, 1e5);
    for (const Result<double>* each : {&longitude, &latitude, &height}) {
        if (!*each) {
            return each->error();
        }
    }
    return GeoPlace{longitude.value(), latitude.value(), height.value()};
}

/// Parses `I/N`: part I of N, counted from 1.
Result<TilePart> parse_part(const std::string& text) {
    constexpr std::uint64_t kMaxParts = 1'000'000;
    const std::size_t slash = text.find('/');
    const auto parse = integer(1, kMaxParts);
    const std::string number = text.substr(0, slash);
    const std::string of = slash == std::string::npos ? std::string() : text.substr(slash + 1);
    const Result<std::uint64_t> i = parse(number);
    const Result<std::uint64_t> n = parse(of);
    if (!i || !n || i.value() > n.value()) {
        return Error{
            fmt::format("`{}` is not I/N, with I from 1 to N and N up to {}", text, kMaxParts)};
    }
    return TilePart{i.value(), n.value()};
}

/// Parses `HOST:PORT`, with an IPv6 address in brackets, or `PORT` alone for the default address.
Result<ServerOptions> parse_listen(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    const bool has_host = colon != std::string::npos;
    const Result<std::uint64_t> port = integer(0, 65'535)(has_host ? text.substr(colon + 1) : text);
    std::string host = has_host ? text.substr(0, colon) : ServerOptions().address;
    if (host.starts_with('[') && host.ends_with(']')) {
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string::npos) {
        host.clear();
    }
    if (!port || host.empty()) {
        return Error{fmt::format("`{}` is not ADDRESS:PORT, such as 127.0.0.1:8080", text)};
    }
    ServerOptions options;
    options.address = host == "localhost" ? "127.0.0.1" : host;
    options.port = static_cast<std::uint16_t>(port.value());
    return options;
}

/// The options of the tiles, for `tiles` and `serve`.
void add_tile_options(CLI::App& app, TileScene& command) {
    TileOptions& options = command.tiles;
    app.add_option("--trees", command.trees,
                   "The trees of the scene as a file of `lsc place` (default: the scene is placed)")
        ->type_name("FILE");
    add_parsed(
        app, "--origin", options.origin, parse_geo_place,
        "Place of the scene's origin on the Earth, in degrees and metres above the ellipsoid "
        "of WGS 84; +X points east, -Z north (default: the tileset has coordinates of its "
        "own)")
        ->type_name("LONGITUDE,LATITUDE[,HEIGHT]");
    const auto tolerated_error = [](const std::string& text) {
        return parse_number(text, 0.0F, 1000.0F);
    };
    constexpr std::uint64_t kMinTriangles = 10'000;
    constexpr std::uint64_t kMaxTriangles = 1'000'000'000;
    add_parsed(app, "--triangles", options.triangles, integer(kMinTriangles, kMaxTriangles),
               "Maximum number of triangles of a tile, on average (default 500000)")
        ->type_name("N");
    app.add_flag("--implicit", options.implicit,
                 "Implicit tiling: small binary files list the tiles, instead of tilesets of JSON");
    add_parsed(app, "--error", options.max_error, tolerated_error,
               "Error of the trees of the nearest tiles in metres (default 0.05); 0: all triangles")
        ->type_name("METRES");
}

/// Adds the files of the scene, for `place`, `tiles` and `serve`.
void add_files(CLI::App& app, SceneCommand& command) {
    app.add_option("FILE", command.files, "A scene (.toml), or one grammar per species")
        ->required();
}
/// Adds the options of the scene and of its trees, for `place`, `tiles` and `serve`.
/// `trust`: Untrusted for a server.
void add_scene(CLI::App& app, SceneCommand& command, Trust trust) {
    add_choice<TileInstances>(
        app, "--instances", command.instance_kind,
        {{"trees", TileInstances::Trees}, {"branches", TileInstances::Branches}},
        "trees: each tree is one of the --heroes; branches: trees are assembled from branches of "
        "heroes, by --rho, so that nearly all differ; far tiles show the heroes (default trees)");
    add_scene_overrides(app, command.overrides, "--size");
    add_tree_height(app, command.overrides.height);
    add_grammar(app, command.overrides.grammar, command.run);
    add_seed(app, command.overrides.seed);
    add_run_limits(app, command.run);
    add_environments(app, command.run);
    add_file_policy(app, command.run, trust);
    if (trust == Trust::Trusted) {
        add_run_policy(app, command.run);
    } else {
        add_time_limit(app, command.run, "Maximum time until the server listens (default: none)");
    }
    add_message_options(app, command.messages);
    add_levels(app, command.messages);
}

} // namespace

void add_message_options(CLI::App& app, MessageOptions& options) {
    app.set_version_flag("--version", "lsc " LSC_VERSION, "Print the version and exit");
    add_messages(app, options);
}

void add_place(CLI::App& app, PlaceCommand& command) {
    add_files(app, command);
    app.add_option("-o,--output", command.output, "Output file; `-` is standard output")
        ->required()
        ->type_name("FILE");
    app.add_flag("--stats", command.stats, "Print the numbers of trees");
    add_scene(app, command, Trust::Trusted);
    app.footer("Writes the trees of a scene, sorted by tile, for --trees of `lsc tiles` and `lsc "
               "serve`: a forest\n"
               "that cannot be placed tile by tile is placed once, and any number of processes "
               "make its tiles.\n"
               "The file fits the scene and the options with which it was made; after a change "
               "place the trees again.\n"
               "Example: lsc place wood.toml -o wood.trees");
}

void add_tiles(CLI::App& app, TilesCommand& command) {
    add_files(app, command);
    app.add_option("-o,--output", command.output, "Folder of the tileset; it is made if missing")
        ->required()
        ->type_name("FOLDER");
    app.add_flag("-f,--force", command.force,
                 "Write into a folder that has files; files of the same names are replaced");
    app.add_flag(
        "--resume", command.resume,
        "Write only the files that the folder does not have yet; an error if its tiles are of "
        "another scene or of other options");
    add_parsed(app, "--part", command.part, parse_part,
               "Write only part I of N; N processes write a tileset, each another part")
        ->type_name("I/N");
    add_tile_options(app, command);
    app.add_flag("--stats", command.stats, "Print the levels of the tileset and their errors");
    add_mesh(app, command.tiles.mesh);
    add_scene(app, command, Trust::Trusted);
    app.footer("Writes 3D Tiles 1.1: tileset.json, which is written last, tilesets of four levels "
               "each, GLB tiles,\n"
               "and the meshes and pictures that the tiles share. Each tree is one of the --heroes "
               "of its species,\n"
               "or, with --instances branches, assembled from their branches.\n"
               "Geometric errors are in metres: viewers choose tiles by them.\n"
               "Examples: lsc tiles wood.toml -o wood\n"
               "          lsc tiles wood.toml --origin 9.7,47.2,430 -o wood\n"
               "          lsc tiles oak.lsys --count 100000 --size 3000 --stats -o oaks");
}

void add_serve(CLI::App& app, ServeCommand& command) {
    add_files(app, command);
    app.add_option_function<std::string>(
           "--listen",
           [&command](const std::string& text) {
               Result<ServerOptions> parsed = parse_listen(text);
               if (!parsed) {
                   throw CLI::ValidationError("--listen", parsed.error().message);
               }
               command.server.address = parsed.value().address;
               command.server.port = parsed.value().port;
           },
           "Address and port, or a port of this machine (default 127.0.0.1:8080); port 0: the "
           "system chooses one")
        ->type_name("ADDRESS:PORT");
    app.add_flag("--public", command.server.is_public,
                 "Allow an address that other machines can reach");
    add_parsed(app, "--cache", command.cache_bytes, parse_size,
               "Memory for tiles that have been made (default 256M)")
        ->type_name("SIZE");
    constexpr std::uint64_t kMaxConnections = 1'000'000;
    add_parsed(app, "--max-connections", command.server.max_connections,
               integer(1, kMaxConnections),
               "Connections at once; further ones are closed (default 1024)")
        ->type_name("N");
    add_tile_options(app, command);
    add_mesh(app, command.tiles.mesh);
    add_scene(app, command, Trust::Untrusted);
    app.footer(
        "Serves the files of `lsc tiles` without writing them: each tile is made when it is "
        "asked for.\n"
        "Trees are placed tile by tile if the placement is jittered, uniform-cells, "
        "poisson-cells or\n"
        "density-cells, without painted trees; other scenes need --trees. Ctrl-C or SIGTERM "
        "ends the server.\n"
        "The scene is not trusted: it reads only files of its own folder, unless --root or "
        "--trusted allow more.\n"
        "/tileset.json is the tileset, / a page that shows it, /health and /metrics are for "
        "monitoring.\n"
        "Examples: lsc serve wood.toml\n"
        "          lsc serve --root samples samples/scenes/endless-forest/endless-forest.toml\n"
        "          lsc serve oak.lsys --placement jittered --spacing 10 --size 300000 "
        "--listen 8000\n"
        "          lsc place wood.toml -o wood.trees; lsc serve wood.toml --trees wood.trees");
}

} // namespace lsys::lsc
