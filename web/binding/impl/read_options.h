// SPDX-License-Identifier: MIT
// Reads the options of requests.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/output/file_option_parsers.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/plant.h"
#include "web/binding/answer.h"

#include <string>
#include <vector>

namespace lsys::web {

/// Member `name` of `request`: the path of the grammar or scene among the files.
[[nodiscard]] std::string name_of(const Json& request);
/// Members `definitions`, `settings`, `dialect` and `system`, all optional.
[[nodiscard]] GrammarOptions grammar_options_of(const Json& request);
/// Members `generations`, `seed` and `height`, all optional.
[[nodiscard]] PlantOptions plant_options_of(const Json& request);
/// Member `mesh`, optional: `method`, `deviation`, `sides`, `smoothJoints`.
[[nodiscard]] MeshOptions mesh_options_of(const Json& request);
/// Member `name`, an optional list of pairs of strings.
[[nodiscard]] std::vector<NamedOption> named_options_of(const Json& request, const char* name);

} // namespace lsys::web
