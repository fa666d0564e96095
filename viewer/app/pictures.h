// SPDX-License-Identifier: MIT
// Writes pictures of a plant without a window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// `camera`: the parsed option ViewOptions::camera. Parts of the camera that the option does not
/// set are chosen so that the whole plant, as gravity and wind bend it, is in view.
[[nodiscard]] ExitStatus take_pictures(const ViewOptions& options,
                                       const Camera& camera,
                                       const PlantDocument& document,
                                       Renderer& renderer,
                                       const Console& console);

} // namespace lsys::view
