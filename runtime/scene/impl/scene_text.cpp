// SPDX-License-Identifier: MIT
#include "runtime/scene/impl/scene_text.h"

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <utility>

namespace lsys {

Result<SceneValue> read_scene_table(std::string_view text) {
    SourceMap sources;
    const FileId file = sources.add("scene", std::string(text));
    Diagnostics ignored;
    std::optional<SceneValue> root = read_toml(file, sources, ignored);
    if (!root) {
        return Error{"the file is no longer valid TOML"};
    }
    return std::move(*root);
}

std::optional<Scene> read_scene(std::string_view text) {
    SourceMap sources;
    const FileId file = sources.add("scene", std::string(text));
    Diagnostics ignored;
    return parse_scene(file, sources, ignored);
}

} // namespace lsys
