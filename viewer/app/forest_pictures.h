// SPDX-License-Identifier: MIT
// Writes pictures of a forest without a window.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/forest_document.h"
#include "viewer/app/options.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// Precondition: `renderer` shows the forest of `document`. With ViewOptions::grow, each picture
/// replaces the trees of `document` by the trees of its moment.
[[nodiscard]] ExitStatus take_forest_pictures(const ViewOptions& options,
                                              const Camera& camera,
                                              ForestDocument& document,
                                              Renderer& renderer,
                                              const Console& console);

} // namespace lsys::view
