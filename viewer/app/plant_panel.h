// The panel at the left: the plant's numbers, and sliders for all that can be changed.
#pragma once

#include "viewer/app/controls.h"
#include "viewer/app/plant_view.h"

namespace lsys::view {

void draw_plant_panel(PlantView& view);

} // namespace lsys::view
