// Writes pictures of a plant without a window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// `camera`: that of ViewOptions::camera. Where this option leaves parts out, the plant is in view as
/// a whole, bent if it bends.
[[nodiscard]] ExitStatus take_pictures(const ViewOptions& options,
                                       const Camera& camera,
                                       const PlantDocument& document,
                                       Renderer& renderer,
                                       const Console& console);

} // namespace lsys::view
