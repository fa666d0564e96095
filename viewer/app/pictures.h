// SPDX-License-Identifier: MIT
// Writes pictures of a plant without a window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// `camera`: ViewOptions::camera, parsed. Parts that the option leaves out are set so that the
/// whole plant is in view, bent if it bends.
[[nodiscard]] ExitStatus take_pictures(const ViewOptions& options,
                                       const Camera& camera,
                                       const PlantDocument& document,
                                       Renderer& renderer,
                                       const Console& console);

} // namespace lsys::view
