// SPDX-License-Identifier: MIT
// Panel of a plant: statistics and settings.
#pragma once

#include "viewer/app/controls.h"
#include "viewer/app/plant_view.h"

namespace lsys::view {

void draw_plant_panel(PlantView& view);

} // namespace lsys::view
