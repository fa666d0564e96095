// SPDX-License-Identifier: MIT
// The direct versions of environments in tests/reference/environments, asked with the types of the
// runtime.
#pragma once

#include "runtime/environment/environment.h"
#include "tests/reference/environments/crowd.h"
#include "tests/reference/environments/map.h"
#include "tests/reference/environments/shadow.h"
#include "tests/reference/environments/sky.h"
#include "tests/reference/environments/solid.h"
#include "tests/reference/environments/space.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lsys::slow {

/// A number in binary64.
inline double wide(float number) {
    return static_cast<double>(number);
}

inline Vector3 wide(const std::array<float, 3>& numbers) {
    return {wide(numbers[0]), wide(numbers[1]), wide(numbers[2])};
}

inline std::vector<reference::Place> places_of(const std::vector<SensePlace>& places) {
    std::vector<reference::Place> result;
    for (const SensePlace& place : places) {
        result.push_back({place.position, place.heading, place.up});
    }
    return result;
}

/// The numbers of all answers, one after the other, as Environment::answer() returns them.
inline std::vector<float> numbers_of(const reference::Answers& answers) {
    std::vector<float> numbers;
    for (const std::vector<double>& answer : answers) {
        for (const double number : answer) {
            numbers.push_back(reference::rounded_answer(number));
        }
    }
    return numbers;
}

inline std::vector<float> shadow(const BytecodeEnvironment& declared,
                                 const std::vector<SensePlace>& places) {
    return numbers_of(
        reference::shadow_answers({wide(declared.cell), static_cast<int>(declared.levels),
                                   wide(declared.strength), wide(declared.ratio)},
                                  places_of(places)));
}

inline std::vector<float> sky(const BytecodeEnvironment& declared,
                              const std::vector<SensedOrgan>& organs,
                              const std::vector<SensePlace>& places) {
    std::vector<reference::Organ> leaves;
    for (const SensedOrgan& organ : organs) {
        leaves.push_back({organ.middle, organ.area});
    }
    return numbers_of(reference::sky_answers(
        {wide(declared.cell), wide(declared.extinction), static_cast<int>(declared.directions)},
        leaves, places_of(places)));
}

inline std::vector<float> map(const BytecodeEnvironment& declared,
                              const EnvironmentPicture& picture,
                              const std::vector<SensePlace>& places) {
    reference::GreyMap map;
    map.picture = {picture.columns, picture.rows, picture.values};
    map.size = {wide(declared.size[0]), wide(declared.size[1])};
    map.at = {wide(declared.at[0]), wide(declared.at[1])};
    map.low = wide(declared.low);
    map.high = wide(declared.high);
    return numbers_of(reference::map_answers(map, places_of(places)));
}

inline std::vector<float> crowd(float radius, const std::vector<SensePlace>& places) {
    return numbers_of(reference::crowd_answers(wide(radius), places_of(places)));
}

inline reference::Surface surface_of(const EnvironmentMesh& mesh) {
    reference::Surface surface;
    for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
        surface.push_back(
            {mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]});
    }
    return surface;
}

/// The answer of kind Solid at a place; its distance has no sign.
inline std::vector<float> nearest(const std::vector<EnvironmentMesh>& meshes,
                                  const Vector3& place) {
    std::vector<reference::Surface> surfaces;
    for (const EnvironmentMesh& mesh : meshes) {
        surfaces.push_back(surface_of(mesh));
    }
    return numbers_of({reference::nearest_of_meshes(surfaces, place)});
}

/// The markers of a box, ball, dome or cone.
inline reference::Markers
markers(const BytecodeEnvironment& declared, std::uint64_t seed, std::uint32_t number) {
    reference::Space space;
    space.shape = declared.shape == SpaceShape::Ball   ? reference::Shape::Ball
                  : declared.shape == SpaceShape::Dome ? reference::Shape::Dome
                  : declared.shape == SpaceShape::Cone ? reference::Shape::Cone
                                                       : reference::Shape::Box;
    space.size = wide(declared.size);
    space.at = wide(declared.at);
    space.count = declared.count;
    space.radius = wide(declared.radius);
    space.angle = wide(declared.angle);
    space.kill = wide(declared.kill);
    return {space, seed, number};
}

} // namespace lsys::slow
