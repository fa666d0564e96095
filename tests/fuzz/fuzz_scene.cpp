// SPDX-License-Identifier: MIT
// Reads any bytes as a scene. A scene that is accepted stays one when a viewer writes its painting
// into it: the painting is read back equal, and nothing else changes.
#include "grammar/rendering/render_diagnostic.h"
#include "runtime/scene/scene.h"

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::optional<lsys::Scene> parse(const std::string& text) {
    lsys::SourceMap sources;
    lsys::Diagnostics diagnostics;
    const lsys::FileId file = sources.add("fuzz.toml", text);
    std::optional<lsys::Scene> scene = lsys::parse_scene(file, sources, diagnostics);
    // Rendering asserts that every place in a message is within its file.
    diagnostics.sort_by_place();
    std::string messages;
    lsys::render_all(diagnostics, sources, {lsys::MessageFormat::Human, false, 50}, messages);
    if (scene.has_value() == diagnostics.has_errors()) {
        std::abort();
    }
    return scene;
}

/// The painting of the scene with one more tree and one more erased tree.
lsys::Painting painted_on(const lsys::Scene& scene) {
    lsys::Painting painting = scene.painting;
    painting.trees.push_back({0, 1.5F, -2.25F, 0.5F, 1.125F});
    if (painting.erased.empty() || painting.erased.back() < 7) {
        painting.erased.push_back(7);
    }
    return painting;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    const std::optional<lsys::Scene> scene = parse(text);
    if (!scene) {
        return 0;
    }
    std::vector<std::string> species;
    for (const lsys::SceneSpecies& one : scene->species) {
        species.push_back(one.name);
    }
    const lsys::Painting painting = painted_on(*scene);
    const lsys::Result<std::string> written = lsys::with_painting(text, painting, species);
    if (!written) {
        return 0;
    }
    const std::optional<lsys::Scene> again = parse(written.value());
    if (!again || again->painting != painting || again->species.size() != species.size() ||
        again->light != scene->light || again->goal != scene->goal) {
        std::abort();
    }
    return 0;
}
