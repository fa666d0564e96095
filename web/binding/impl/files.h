// SPDX-License-Identifier: MIT
// Operations that write files in memory, with the options of `lsc export` and `lsc forest`.
#pragma once

#include "grammar/base/outcome.h"
#include "web/binding/answer.h"
#include "web/binding/session.h"

namespace lsys::web {

/// Writes the plant as the file with the name `path`, a member of the request, and the files beside
/// it, with the options of `lsc export` in the member `options`.
[[nodiscard]] Outcome<void> write_plant(Session& session, const Json& request, Answer& answer);
/// Grows the forest of the grammars, or of the scene, in the member `names`, with the options of
/// scenes in the member `scene`, and writes it like write_plant().
[[nodiscard]] Outcome<void> write_forest(Session& session, const Json& request, Answer& answer);

} // namespace lsys::web
