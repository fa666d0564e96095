// What the command line of lsview asks for.
#pragma once

#include "runtime/cli/command_line.h"
#include "runtime/cli/options.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/physics.h"
#include "viewer/gl/renderer.h"
#include "viewer/scene/camera.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace lsys::view {

struct ViewOptions {
    MessageOptions messages;
    GrammarOptions grammar;
    std::optional<std::uint64_t> seed;
    std::string file;          // the first one
    bool is_forest = false;    // a scene, or grammars with options of forests
    lsc::ForestCommand forest; // its files and what takes the place of what a scene says
    MeshOptions mesh;
    std::uint32_t threads = 0;
    std::uint64_t max_bytes = 0;

    std::string camera; // to_text() of a Camera or parts of one; empty: all is in view
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    std::optional<float> gravity; // m/s^2
    std::optional<Wind> wind;
    float time = 0.0F; // s, of wind
    bool shadows = true;
    bool ground = true;
    PlantStyle style = PlantStyle::Surface;
    LineKind lines = LineKind::None;
    std::uint32_t samples = 4;
    std::uint64_t most_triangles = 1'500'000; // of the branches of a forest in a picture
    std::string shaders;                      // a folder instead of the built-in ones

    std::string screenshot;   // a picture instead of a window; `-`: standard output
    std::uint32_t frames = 0; // a numbered series; 0: one picture
    float frames_per_second = 24.0F;
    bool turntable = false; // the series goes once around
    std::string stats;      // a JSON file; `-`: standard output
};

using ParsedOptions = std::variant<ViewOptions, PrintText, UsageError>;
[[nodiscard]] ParsedOptions parse_options(std::span<const std::string> arguments);

} // namespace lsys::view
