// SPDX-License-Identifier: MIT
#include "viewer/app/options.h"

#include "runtime/pipeline/forest.h"
#include "runtime/platform/file.h"
#include "runtime/program/arguments.h"
#include "runtime/program/find_option.h"
#include "runtime/program/option_parsers.h"
#include "runtime/program/policy_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

constexpr std::uint64_t kMaxPixels = 16'384; // per side of a picture
constexpr std::uint64_t kMaxFrames = 1'000'000;

struct Size {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

Result<Size> parse_picture_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    const Result<std::uint64_t> width =
        parse_integer(std::string_view(text).substr(0, cross), 1, kMaxPixels);
    const Result<std::uint64_t> height =
        cross == std::string::npos
            ? Result<std::uint64_t>(Error{})
            : parse_integer(std::string_view(text).substr(cross + 1), 1, kMaxPixels);
    if (!width || !height) {
        return Error{
            fmt::format("`{}` is not the size of a picture; write WIDTHxHEIGHT, each 1 to {}", text,
                        kMaxPixels)};
    }
    return Size{static_cast<std::uint32_t>(width.value()),
                static_cast<std::uint32_t>(height.value())};
}

Result<PicturePixel> parse_pixel(const std::string& text) {
    const std::size_t comma = text.find(',');
    const Result<std::uint64_t> x =
        parse_integer(std::string_view(text).substr(0, comma), 0, kMaxPixels - 1);
    const Result<std::uint64_t> y =
        comma == std::string::npos
            ? Result<std::uint64_t>(Error{})
            : parse_integer(std::string_view(text).substr(comma + 1), 0, kMaxPixels - 1);
    if (!x || !y) {
        return Error{fmt::format("`{}` is not a pixel of a picture; write X,Y from its upper left "
                                 "corner, as 640,360",
                                 text)};
    }
    return PicturePixel{static_cast<std::uint32_t>(x.value()),
                        static_cast<std::uint32_t>(y.value())};
}

void add_picture(CLI::App& app, ViewOptions& options) {
    app.add_option("--screenshot", options.screenshot,
                   "Write a PNG instead of opening a window; no display is needed")
        ->type_name("FILE")
        ->check([](const std::string& file) {
            return std::string(file.empty() ? "the name of the file is empty" : "");
        })
        ->group("Picture");
    app.add_option_function<std::string>(
           "--size",
           [&options](const std::string& text) {
               const Result<Size> size = parse_picture_size(text);
               if (!size) {
                   throw CLI::ValidationError("--size", size.error().message);
               }
               options.width = size.value().width;
               options.height = size.value().height;
           },
           "Size of the window or picture in pixels (default 1280x720)")
        ->type_name("WxH")
        ->group("Picture");
    app.add_option("--camera", options.camera,
                   "Viewpoint: `eye X,Y,Z target X,Y,Z fov DEGREES`, or parts of it (default: a "
                   "plant or small forest as a whole, a large forest from its edge)")
        ->type_name("LINE")
        ->group("Picture");
    app.add_option("--fly-to", options.fly_to,
                   "The camera of a series of pictures moves from that of --camera to this one, in "
                   "equal steps along a line")
        ->type_name("LINE")
        ->group("Picture");
    constexpr float kMinAir = 0.01F; // km
    constexpr float kMaxAir = 1e6F;  // km
    add_parsed(
        app, "--air", options.visibility,
        [](const std::string& text) { return parse_number(text, kMinAir, kMaxAir); },
        "Visibility in a forest, km: haze leaves 2 % of the contrast there (default: 12 times the "
        "diagonal of the ground, at least 10; 100 in a streamed forest)")
        ->type_name("KM")
        ->group("Picture");
    add_parsed(
        app, "--sun", options.light.sun, parse_sun,
        "Place of the sun in degrees: AZIMUTH clockwise from north (-Z), ELEVATION above the "
        "horizon; or the day of the year, the hour of solar time and the latitude")
        ->type_name("AZIMUTH,ELEVATION|DAY,HOUR,LATITUDE")
        ->group("Picture");
    add_parsed(
        app, "--turbidity", options.light.turbidity,
        [](const std::string& text) {
            return parse_number(text, static_cast<float>(SceneLight::kMinTurbidity),
                                static_cast<float>(SceneLight::kMaxTurbidity));
        },
        "Haze of the sky: 2 very clear, 6 hazy (default 3)")
        ->type_name("T")
        ->group("Picture");
    constexpr float kMaxTime = 86'400.0F; // s
    add_parsed(
        app, "--time", options.time,
        [](const std::string& text) { return parse_number(text, 0.0F, kMaxTime); },
        "Seconds since the wind began (default 0)")
        ->type_name("SECONDS")
        ->group("Picture");
    add_parsed(app, "--frames", options.frames, integer(1, kMaxFrames),
               "Write a numbered series of pictures: a.png becomes a.0001.png and so on")
        ->type_name("N")
        ->group("Picture");
    constexpr float kSlowest = 0.1F;    // pictures per second
    constexpr float kFastest = 1000.0F; // pictures per second
    add_parsed(
        app, "--fps", options.frames_per_second,
        [](const std::string& text) { return parse_number(text, kSlowest, kFastest); },
        "Pictures per second of a series (default 24)")
        ->type_name("F")
        ->group("Picture");
    app.add_flag("--transparent", options.transparent,
                 "Draw a plant without sky and ground; the PNG is transparent around it")
        ->group("Picture");
    app.add_flag("--figure", options.figure,
                 "Show a person of 1.8 m beside a plant, or where the camera of a forest looks")
        ->group("Picture");
    app.add_flag("--turntable", options.turntable, "The series goes once around the plant")
        ->group("Picture");
    app.add_flag("--grow", options.grow,
                 "Show growth: a plant from its axiom to its last generation, also between "
                 "generations; a forest placed by domination year by year; a forest of trees with "
                 "stages stage by stage. In a window growth starts to play at once")
        ->group("Picture");
    add_parsed(app, "--pick", options.pick, parse_pixel,
               "Describe what the pixel of the picture shows: the module of a plant or the "
               "branch of a forest, with the production that wrote it, its place and generation")
        ->type_name("X,Y")
        ->group("Picture");
    add_choice<std::optional<TraceScope>>(
        app, "--why", options.why,
        {{"written", TraceScope::Written}, {"next", TraceScope::Next}, {"back", TraceScope::Back}},
        "Explain the module that --pick finds, as `lsc trace` does: the step that wrote it, the "
        "step "
        "that rewrites it, or the way back to the axiom")
        ->group("Picture");
    app.add_option("--stats", options.stats,
                   "Write counts and times of the pictures as JSON; `-` is standard output")
        ->type_name("FILE")
        ->group("Picture");
    app.add_flag_callback(
           "--no-shadows", [&options] { options.shadows = false; }, "Draw no shadows")
        ->group("Picture");
    app.add_flag_callback(
           "--no-ground", [&options] { options.ground = false; }, "Draw no ground under a plant")
        ->group("Picture");
    add_choice<PlantStyle>(app, "--style", options.style,
                           {{"surface", PlantStyle::Surface},
                            {"wireframe", PlantStyle::Wireframe},
                            {"none", PlantStyle::None}},
                           "Surfaces (default), edges of their triangles, or neither")
        ->group("Picture");
    app.add_flag_callback(
           "--wireframe", [&options] { options.style = PlantStyle::Wireframe; },
           "The same as --style wireframe")
        ->group("Picture");
    add_choice<LineKind>(
        app, "--lines", options.lines,
        {{"none", LineKind::None},
         {"skeleton", LineKind::Skeleton},
         {"path", LineKind::TurtlePath}},
        "Lines over the picture: segments by branching order, or the turtle's path by time "
        "(default none)")
        ->group("Picture");
    add_parsed(app, "--senses", options.senses, parse_senses,
               "What plants sense: all, none, or a list of obstacles, light, markers and "
               "directions, separated by commas (default obstacles)")
        ->type_name("LIST")
        ->group("Picture");
    add_choice<BranchColours>(app, "--colours", options.colours,
                              {{"natural", BranchColours::Natural},
                               {"id", BranchColours::Id},
                               {"age", BranchColours::Age},
                               {"hero", BranchColours::Hero}},
                              "Colours of the branches of a forest: those of their materials "
                              "(default), or one for each id, age or hero of instancing")
        ->group("Picture");
    add_parsed(
        app, "--samples", options.samples,
        [](const std::string& text) -> Result<std::uint64_t> {
            const Result<std::uint64_t> samples = parse_integer(text, 1, 4);
            return samples && (samples.value() == 1 || samples.value() == 4)
                       ? samples
                       : Result<std::uint64_t>(Error{fmt::format("`{}` is neither 1 nor 4", text)});
        },
        "Samples per pixel, 1 or 4 (default 4)")
        ->type_name("N")
        ->group("Picture");
    constexpr std::uint64_t kMaxTriangles = 1'000'000'000;
    add_parsed(app, "--triangles", options.max_triangles, integer(0, kMaxTriangles),
               "Max triangles of branches in a picture of a forest; with more, trees are drawn "
               "coarser (default 1500000)")
        ->type_name("N")
        ->group("Picture");
    constexpr std::uint64_t kMaxStreamMebibytes = 65'536;
    app.add_option_function<std::string>(
           "--stream-memory",
           [&options](const std::string& text) {
               const Result<std::uint64_t> mebibytes = parse_integer(text, 16, kMaxStreamMebibytes);
               if (!mebibytes) {
                   throw CLI::ValidationError("--stream-memory", mebibytes.error().message);
               }
               options.stream_bytes = mebibytes.value() << 20U;
           },
           "Budget of memory for the trees of a forest that is too large to be held as a whole, "
           "MiB (default 128)")
        ->type_name("MIB")
        ->group("Picture");
    add_choice<Culling>(
        app, "--culling", options.culling,
        {{"auto", Culling::Auto}, {"cpu", Culling::Cpu}, {"gpu", Culling::Gpu}},
        "Where the trees of a picture of a forest are chosen: on the processor, or by compute "
        "shaders; the pictures are the same (default auto: gpu with a graphics card, cpu with a "
        "software renderer)")
        ->group("Picture");
    add_choice<Quality>(
        app, "--quality", options.quality,
        {{"auto", Quality::Auto},
         {"low", Quality::Low},
         {"medium", Quality::Medium},
         {"high", Quality::High}},
        "Looks and cost of pictures (default auto: medium with a graphics card, low with a "
        "software renderer)")
        ->group("Picture");
    add_parsed(
        app, "--temporal-antialiasing", options.temporal,
        [](const std::string& text) -> Result<std::uint64_t> {
            constexpr std::array<const char*, 3> kWords = {"auto", "off", "on"}; // by Temporal
            for (std::uint64_t i = 0; i < kWords.size(); ++i) {
                if (text == kWords[i]) {
                    return i;
                }
            }
            return Error{fmt::format("`{}` is none of auto|off|on", text)};
        },
        "With --quality high, mix each picture with those before it, which smooths edges in motion "
        "(default auto: in a window with a graphics card)")
        ->type_name("auto|off|on")
        ->group("Picture");
    app.add_option("--shaders", options.shaders,
                   "Read shaders from this folder instead of the built-in ones")
        ->type_name("FOLDER")
        ->check([](const std::string& folder) {
            return platform::facts_of(folder).type == platform::FileType::Directory
                       ? std::string()
                       : fmt::format("there is no folder `{}`", folder);
        })
        ->group("Picture");
}

void add_bending(CLI::App& app, ViewOptions& options) {
    constexpr float kMaxGravity = 1000.0F; // m/s2
    add_parsed(
        app, "--gravity", options.gravity,
        [](const std::string& text) { return parse_number(text, 0.0F, kMaxGravity); },
        "Bend the plant under its weight, in m/s2 (9.81 on Earth)")
        ->type_name("G")
        ->group("Bending");
    add_parsed(app, "--wind", options.wind, parse_wind,
               "Bend the plant, or move the forest, in wind, in m/s; GUST is the fraction of the "
               "speed that varies")
        ->type_name("X,Y,Z[,GUST]")
        ->group("Bending");
}

constexpr const char* kTitle =
    "Shows plants and forests of L-systems, live in a window or as pictures.";

void add_all(CLI::App& app, ViewOptions& options) {
    app.add_option(
        "FILE", options.files,
        "A grammar or a .lsb file; a scene (.toml), or the grammars of a forest. Without "
        "one, a window opens with samples and recent files");
    add_picture(app, options);
    add_grammar(app, options.grammar, options.run);
    add_base_option(app, options.run);
    add_seed(app, options.seed);
    add_height(app, options.plant_height);
    add_bending(app, options);
    add_scene_overrides(app, options.overrides, "--forest-size");
    add_mesh(app, options.mesh);
    add_run_limits(app, options.run);
    add_environments(app, options.run);
    add_file_policy(app, options.run, Trust::Trusted);
    add_run_policy(app, options.run);
    find_option(app, "--max-time")
        ->description("Maximum duration of the command with --screenshot; in a window, of each "
                      "loading of a file (default: none)");
    find_option(app, "--max-output")
        ->description("Maximum size of all pictures and of standard output together, with "
                      "--screenshot (default: none)");
    add_messages(app, options.messages);
    app.set_version_flag("--version", "lsview " LSC_VERSION, "Print the version and exit");
    app.footer(
        "Without --screenshot a window opens; F1 shows its keys. Files that change are shown at "
        "once.\nIn the window of a scene trees can be painted and saved into it.\n"
        "Exit status: 0 fine, 1 errors in a grammar, 2 a file, the display or the command "
        "line, 3 a limit.\n"
        "Examples: lsview tree.lsys --screenshot tree.png --size 1920x1080\n"
        "          lsview wood.toml\n"
        "          lsview wood.toml --screenshot wood.png\n"
        "          lsview tree.lsys --screenshot tree.png --grow --frames 240\n"
        "          lsview oak.lsys birch.lsys --count 10000 --forest-size 700 --screenshot "
        "wood.png");
}

} // namespace

void visit_options(const std::function<void(const CLI::App& app)>& visit) {
    ViewOptions options;
    CLI::App app(kTitle, "lsview");
    add_all(app, options);
    visit(app);
}

ParsedOptions parse_options(std::span<const std::string> arguments) {
    ViewOptions options;
    CLI::App app(kTitle, "lsview");
    app.allow_windows_style_options(false); // `/a` is a path
    add_all(app, options);
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        return PrintText{help_text(app, "")};
    } catch (const CLI::CallForVersion&) {
        return PrintText{"lsview " LSC_VERSION "\n", is_given(app, "--verbose")};
    } catch (const CLI::ParseError& error) {
        return to_usage_error(error, app, "lsview");
    }
    if (const auto mistake = apply_base(options.run, options.files)) {
        return *mistake;
    }
    std::vector<std::string> named = options.files;
    named.insert(named.end(), {options.grammar.view, options.overrides.density_map,
                               options.overrides.ground_picture, options.overrides.ground_normals});
    if (const auto mistake = apply_policy(app, std::move(named), options.run)) {
        return *mistake;
    }
    if (is_given(app, "--max-output") && options.screenshot.empty()) {
        return UsageError{"--max-output belongs to pictures", "add `--screenshot FILE`"};
    }
    if (options.files.empty()) {
        const bool is_about_a_file =
            options.grammar != GrammarOptions{} || options.seed || options.plant_height ||
            options.overrides != SceneOverrides{} || !options.camera.empty();
        if (is_about_a_file || !options.screenshot.empty()) {
            return UsageError{is_about_a_file ? "options of a plant or forest need a FILE"
                                              : "--screenshot needs a FILE",
                              "name a grammar or a scene"};
        }
        return options;
    }
    options.file = options.files.front();
    const std::optional<float> season = std::exchange(options.overrides.season, std::nullopt);
    options.is_forest =
        options.files.size() > 1 || is_scene(options.file) || options.overrides != SceneOverrides{};
    if (options.is_forest) {
        options.overrides.season = season;
    } else if (season) {
        options.grammar.definitions.push_back({"season", *season}); // the grammar's constant
    }
    if (options.is_forest && options.gravity) {
        return UsageError{"--gravity bends a plant, not a forest", "leave it out"};
    }
    if (options.is_forest && options.mesh.method == MeshMethod::Solid) {
        return UsageError{"--method solid is for a single plant, not a forest", "leave it out"};
    }
    if (options.transparent && (options.is_forest || options.screenshot.empty())) {
        return options.is_forest
                   ? UsageError{"--transparent is for a picture of a plant, not of a forest",
                                "leave it out"}
                   : UsageError{"--transparent belongs to pictures", "add `--screenshot FILE`"};
    }
    if (!options.is_forest && options.visibility) {
        return UsageError{"--air sets the haze of a forest, and this is a plant", "leave it out"};
    }
    if (options.is_forest && options.plant_height) {
        options.overrides.height = {*options.plant_height, *options.plant_height};
        options.plant_height.reset();
    }
    if ((options.frames != 0 || !options.stats.empty()) && options.screenshot.empty()) {
        return UsageError{"--frames and --stats belong to pictures", "add `--screenshot FILE`"};
    }
    if (!options.is_forest && options.colours != BranchColours::Natural) {
        return UsageError{"--colours is for the branches of a forest, and this is a plant",
                          "add `--count 1` for a forest of one plant"};
    }
    if (options.pick && options.screenshot.empty()) {
        return UsageError{"--pick describes a pixel of a picture",
                          "add `--screenshot FILE`, or click in the window"};
    }
    if (options.why && options.is_forest) {
        return UsageError{
            "--why explains a module of a plant, and a branch of a forest is shared by "
            "many places",
            "show its grammar alone"};
    }
    if (options.why && !options.pick) {
        return UsageError{"--why explains the module that a pixel shows", "add `--pick X,Y`"};
    }
    if (options.pick && (options.pick->x >= options.width || options.pick->y >= options.height)) {
        return UsageError{fmt::format("--pick {},{} lies outside of the picture of {} x {} pixels",
                                      options.pick->x, options.pick->y, options.width,
                                      options.height),
                          "pixels count from 0, from the upper left corner"};
    }
    if (options.pick && (options.screenshot == "-" || options.stats == "-")) {
        return UsageError{"--pick writes to standard output, as `-` of --screenshot and --stats "
                          "does",
                          "name a file instead of `-`"};
    }
    if (options.turntable && options.frames == 0) {
        return UsageError{"--turntable needs a series of pictures", "add `--frames N`"};
    }
    if (!options.fly_to.empty() && options.frames < 2) {
        return UsageError{"--fly-to needs a series of at least two pictures", "add `--frames N`"};
    }
    if (!options.fly_to.empty() && options.turntable) {
        return UsageError{"--fly-to and --turntable both move the camera", "leave one of them out"};
    }
    if (options.grow && !options.screenshot.empty() && options.frames == 0) {
        return UsageError{"--grow needs a series of pictures", "add `--frames N`"};
    }
    if (options.grow && !options.is_forest && (options.gravity || options.wind)) {
        return UsageError{"--grow shows a plant at rest, without --gravity and --wind",
                          "leave them out, or --grow"};
    }
    if (options.frames != 0 && options.screenshot == "-") {
        return UsageError{"a series of pictures cannot be written to standard output",
                          "write `--screenshot FILE`"};
    }
    if (is_standard_input(options.file) && options.screenshot.empty()) {
        return UsageError{"a window reloads its file, so it cannot show "
                          "standard input",
                          "add `--screenshot FILE`, or write the grammar to a file"};
    }
    std::filesystem::path picture = options.screenshot;
    if (picture.has_extension() && CLI::detail::to_lower(picture.extension().string()) != ".png") {
        return UsageError{fmt::format("`{}`: pictures are written as png", options.screenshot),
                          fmt::format("name it `{}`", picture.replace_extension(".png").string())};
    }
    return options;
}

void use_other_file(ViewOptions& options, const std::string& file) {
    options.file = file;
    options.files = {file};
    if (options.run.files.is_untrusted) {
        options.run.files.named = {file};
    }
    options.is_forest = is_scene(file);
    options.overrides = {};
    options.grammar = {};
    options.seed.reset();
    options.plant_height.reset();
    options.camera.clear();
    options.fly_to.clear();
    options.visibility.reset();
    options.light = {};
    options.edits = {};
    options.transparent = false;
    options.figure = false;
}

} // namespace lsys::view
