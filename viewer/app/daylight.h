// SPDX-License-Identifier: MIT
// Daylight: the light of a clear day for any place of the sun.
#pragma once

#include "runtime/scene/scene.h"
#include "viewer/gl/renderer.h"

namespace lsys::view {

/// `scene` with the values that are set in `changes`.
[[nodiscard]] SceneLight replaced(const SceneLight& scene, const SceneLight& changes);

/// The place of the sun whose direction is `light.to_sun`.
[[nodiscard]] SunPlace sun_of(const Light& light);

/// `light` with the sun and the turbidity of `scene`; unchanged if it sets neither. The luminance of
/// sky and horizon changes as in Preetham, Shirley & Smits 1999 (SIGGRAPH, appendix A.2), the colour
/// of the sun by Rayleigh scattering and haze (appendix A.1); the exposure follows. The result
/// equals `light` for the sun of `light` and kDefaultTurbidity. Below the horizon the sun gives no
/// light, and the sky fades to dusk.
[[nodiscard]] Light daylight_of(const SceneLight& scene, const Light& light);
inline constexpr double kDefaultTurbidity = 3.0;

} // namespace lsys::view
