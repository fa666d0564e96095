// SPDX-License-Identifier: MIT
// Controls of the panels of plants and forests for what plants sense.
#pragma once

#include "runtime/pipeline/sensed_plant.h"
#include "viewer/app/sense_view.h"

#include <string>
#include <vector>

namespace lsys::view {

/// Toggles. `has_keys`: the view has keys for them, which tooltips name.
void draw_sense_look(bool has_keys, SenseLook& look);
/// Fields for the displacement of an environment, if its kind has a place.
void draw_environment_move(const std::string& name,
                           EnvironmentKind kind,
                           std::vector<EnvironmentMove>& moves);

} // namespace lsys::view
