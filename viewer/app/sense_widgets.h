// SPDX-License-Identifier: MIT
// Controls of the panels of plants and forests for what plants sense.
#pragma once

#include "runtime/pipeline/sensed_plant.h"
#include "viewer/app/sense_view.h"

#include <string>
#include <vector>

namespace lsys::view {

/// Draws a toggle for each sense. `has_keys`: the view has keys for the toggles, and tooltips name
/// the keys.
void draw_sense_look(bool has_keys, SenseLook& look);
/// Draws fields for the displacement of an environment; nothing if its kind has no place.
void draw_environment_move(const std::string& name,
                           EnvironmentKind kind,
                           std::vector<EnvironmentMove>& moves);

} // namespace lsys::view
