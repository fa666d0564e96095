// The scene of a command line: a scene file or grammars, with the options that take the place of
// what it says.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/options.h"
#include "runtime/scene/scene.h"

#include <string>
#include <vector>

namespace lsys::lsc {

/// By the name: `.toml`.
[[nodiscard]] bool is_scene(const std::string& path);

struct CommandScene {
    Scene scene;
    SourceMap sources;
    std::string folder; // that paths of the scene are relative to
};

/// Reads the scene of `command`; says what is wrong.
[[nodiscard]] Status
load_command_scene(const ForestCommand& command, const Console& console, CommandScene& loaded);

} // namespace lsys::lsc
