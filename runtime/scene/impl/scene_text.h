// SPDX-License-Identifier: MIT
// Reads texts of scenes that the program is about to change, without messages.
#pragma once

#include "grammar/base/result.h"
#include "runtime/scene/impl/document.h"
#include "runtime/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// Reads the table of the whole text; spans of its values are offsets in `text`. Error: the text is
/// not TOML.
[[nodiscard]] Result<SceneValue> read_scene_table(std::string_view text);
/// Reads the scene in the text; nullopt if it has errors.
[[nodiscard]] std::optional<Scene> read_scene(std::string_view text);

} // namespace lsys
