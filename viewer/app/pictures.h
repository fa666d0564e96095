// SPDX-License-Identifier: MIT
// Writes pictures of a plant without a window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// `camera`: ViewOptions::camera, parsed. Parts missing in the option are set so that the whole
/// plant is in view, as bent by gravity and wind.
[[nodiscard]] ExitStatus take_pictures(const ViewOptions& options,
                                       const Camera& camera,
                                       const PlantDocument& document,
                                       Renderer& renderer,
                                       const Console& console);

} // namespace lsys::view
