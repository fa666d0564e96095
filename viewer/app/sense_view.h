// SPDX-License-Identifier: MIT
// What a plant senses, for pictures: the choice of the senses to show, their drawing, and the
// obstacle under the mouse.
#pragma once

#include "runtime/pipeline/sensed_plant.h"
#include "runtime/turtle/skeleton.h"
#include "viewer/scene/height_field.h"
#include "viewer/scene/sense_drawing.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::view {

/// The senses that a picture shows.
struct SenseLook {
    bool obstacles = true;   // meshes and planes of kind Solid
    bool light = false;      // kinds Shadow and Sky: voxels or places, coloured by their light
    bool markers = false;    // kind Space: markers that are not removed yet
    bool directions = false; // an arrow per module: the direction that the environment returned

    friend bool operator==(const SenseLook&, const SenseLook&) = default;
};
/// Reads the option of senses: `all`, `none`, or a list of `obstacles`, `light`, `markers` and
/// `directions` with commas.
[[nodiscard]] Result<SenseLook> parse_senses(std::string_view text);
/// Writes `look` so that parse_senses() reads it back.
[[nodiscard]] std::string to_text(const SenseLook& look);

/// Displacement of the environment `name`, m; 0 if `moves` lacks it.
[[nodiscard]] std::array<float, 3> move_of(const std::vector<EnvironmentMove>& moves,
                                           std::string_view name);
/// Sets the displacement of the environment `name` in `moves`; a displacement of 0 is removed.
void set_move(std::string_view name,
              const std::array<float, 3>& by,
              std::vector<EnvironmentMove>& moves);

/// Draws what `plant` has sensed. `moves`: displacements of obstacles since the plant has grown.
/// `bounds`: of the plant as drawn; planes reach three times as far, and arrows have 4 to 30 % of
/// its diagonal.
[[nodiscard]] SenseDrawing make_sense_drawing(const SensedPlant& plant,
                                              const SenseLook& look,
                                              const std::vector<EnvironmentMove>& moves,
                                              const Bounds& bounds);

/// An obstacle that a ray meets.
struct ObstacleHit {
    std::string name;      // of its environment
    double distance = 0.0; // in lengths of the direction of the ray
};
/// The first obstacle, as make_sense_drawing() draws it, that a ray meets.
[[nodiscard]] std::optional<ObstacleHit> first_obstacle(const SensedPlant& plant,
                                                        const std::vector<EnvironmentMove>& moves,
                                                        const Bounds& bounds,
                                                        const Ray& ray);

} // namespace lsys::view
