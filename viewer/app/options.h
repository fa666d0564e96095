// SPDX-License-Identifier: MIT
// The command line of lsview.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/scene_overrides.h"
#include "runtime/pipeline/trace.h"
#include "runtime/program/message_options.h"
#include "runtime/program/run_options.h"
#include "runtime/program/usage.h"
#include "viewer/app/sense_view.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/branch_colours.h"
#include "viewer/scene/camera.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace CLI {
class App;
}

namespace lsys::view {

/// A pixel of a picture, from its upper left corner.
struct PicturePixel {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

/// Temporal antialiasing with Quality::High; Auto: in a window with a graphics card.
enum class Temporal : std::uint8_t { Auto, Off, On };

struct ViewOptions {
    MessageOptions messages;
    GrammarOptions grammar;
    std::optional<std::uint64_t> seed;
    std::optional<float> plant_height; // m
    std::vector<std::string> files;    // a grammar, a scene, or the grammars of a forest
    std::string file;                  // front of `files`
    bool is_forest = false;            // a scene, several grammars, or an option of forests
    // For forests only. overrides.grammar and overrides.seed are unset: `grammar` and `seed` above
    // have their values.
    SceneOverrides overrides;
    SceneOverrides edits; // edits of the user in the window, applied after `overrides`
    MeshOptions mesh;
    RunOptions run;

    std::string camera; // to_text() of a Camera, or parts of it; empty: first_view()
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::optional<float> gravity; // m/s^2
    std::optional<Wind> wind;
    float time = 0.0F;               // s since the wind began
    std::optional<float> visibility; // in a forest, km
    bool shadows = true;
    bool ground = true;
    PlantStyle style = PlantStyle::Surface;
    LineKind lines = LineKind::None;
    SenseLook senses;
    BranchColours colours = BranchColours::Natural;        // forests only
    SceneLight light;                                      // values that replace the scene's
    std::uint32_t samples = 4;                             // per pixel
    std::uint64_t max_triangles = 1'500'000;               // max triangles of branches in a forest
    std::uint64_t stream_bytes = std::uint64_t{128} << 20; // for trees of a streamed forest
    Culling culling = Culling::Auto;                       // forests only
    Quality quality = Quality::Auto;
    Temporal temporal = Temporal::Auto;
    std::string fly_to; // camera at the end of a series; empty: the camera stays
    // Folder of shaders that replace the built-in shaders; empty: none.
    std::string shaders;

    std::string screenshot;   // picture file; `-`: standard output; empty: opens a window instead
    std::uint32_t frames = 0; // pictures of a numbered series; 0: a single picture
    float frames_per_second = 24.0F;
    bool transparent = false;         // draw a plant without sky and ground
    bool figure = false;              // a person of 1.8 m as a scale
    bool turntable = false;           // the series orbits once
    bool grow = false;                // the series shows growth; in a window, growth starts to play
    std::optional<PicturePixel> pick; // report what this pixel shows
    std::optional<TraceScope> why;    // with `pick`: scope of the trace of a plant's module
    std::string stats;                // JSON file; `-`: standard output
    bool beside_window = false;       // another thread of this process has a window
    bool all_or_none = false;         // pictures of a series appear when all are complete
    std::atomic<std::uint32_t>* pictures_done = nullptr; // counts written pictures; may be null
};

/// Sets the file to open. Drops the options of grammars and views, which apply only to the files
/// that the command line names.
void use_other_file(ViewOptions& options, const std::string& file);

using ParsedOptions = std::variant<ViewOptions, PrintText, UsageError>;
[[nodiscard]] ParsedOptions parse_options(std::span<const std::string> arguments);

/// Calls `visit` with a CLI::App that declares all options.
void visit_options(const std::function<void(const CLI::App& app)>& visit);

} // namespace lsys::view
