// SPDX-License-Identifier: MIT
// The physics of a plant: every segment of a skeleton is a rigid body on a spring joint at its base
// (Crankshaw 2019, chapter 6, after Barron et al. 2001); weight and wind bend the plant. Metres,
// kilograms, seconds, radians. Made from the skeleton at rest; pose() returns bent skeletons.
//
// Guarantees: all values are finite, for any skeleton; without wind the energy never grows,
// for any springs, masses, lengths and time step; results are the same for any number of threads.
// The comment at the top of physics.cpp describes a step and proves the guarantees. With
// PhysicsOptions::ground no end of a segment or object and no corner of a polygon is below y = 0
// unless it is below y = 0 at rest.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace lsys {

struct Wind {
    glm::vec3 velocity{0.0F}; // m/s
    /// Amplitude of gusts as a fraction of `velocity`. Gusts are a smooth function of time. 0:
    /// steady wind.
    float gust = 0.0F;

    friend bool operator==(const Wind&, const Wind&) = default;
};

/// Except for `time_step`, values that are not finite count as 0; so do negative values, except
/// gravity and velocity.
struct PhysicsOptions {
    float gravity = 9.81F; // m/s^2, downwards; 0: none
    Wind wind;
    /// Time in s after which gusts repeat: their two periods, 3.1 s and 1.3 s, are changed to the
    /// nearest whole fractions of this time. 0: the two periods stay unchanged.
    float gust_period = 0.0F;
    float damping = 1.0F;           // N m s/rad, of every joint
    float time_step = 1.0F / 60.0F; // s, 1e-6 to 10; not finite: 1/60
    float air_density = 1.225F;     // kg/m^3; 0: neither wind nor drag
    float surface_mass = 0.2F;      // kg/m^2, of leaves, flowers, other objects and polygons
    LoadRule load = LoadRule::Carried;
    bool ground = true;        // the ground y = 0 supports parts that are above it at rest
    std::uint32_t threads = 0; // 0: as many as the machine has
};

class PlantPhysics {
public:
    /// The plant starts in the pose `rest`, in which its springs are relaxed, and stands still.
    PlantPhysics(const Skeleton& rest, const PhysicsOptions& options);
    ~PlantPhysics();
    PlantPhysics(const PlantPhysics&) = delete;
    PlantPhysics& operator=(const PlantPhysics&) = delete;

    /// Replaces the options except `threads`; the motion continues.
    void set(const PhysicsOptions& options);
    /// The options in use, after corrections.
    [[nodiscard]] const PhysicsOptions& options() const;

    /// Makes one time step.
    void step();
    /// Moves the plant to its state of rest in steady wind, where it stands still; time() does not
    /// change. Returns whether the plant came to rest within `max_rounds`: in the last round no
    /// segment turned by more than `tolerance` radians, or friction on the ground would hold the
    /// plant. A plant of 2,000 segments or more that falls first settles its main branches or, if
    /// it is a long curve, its large pieces; `max_rounds` does not count these stages.
    bool settle(double tolerance, std::uint32_t max_rounds);
    /// Returns the plant to its pose at rest, at time 0.
    void reset();

    [[nodiscard]] double time() const; // s, sum of all steps
    /// Kinetic and potential energy in J; 0 in the rest pose at standstill.
    [[nodiscard]] double energy() const;
    [[nodiscard]] const Skeleton& rest() const;
    /// Writes the bent plant to `out`: the skeleton at rest with changed bases, frames, positions
    /// and corners. Parts that have not moved keep exactly their values at rest.
    void pose(Skeleton& out) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Max rounds of settle() for a plant of this many segments: 3,000,000 / segments, but at most 10,000
/// and at least 30. Plants of 100,000 segments need about 20 rounds, 2 s of a core.
[[nodiscard]] std::uint32_t settle_rounds(std::size_t segments);

} // namespace lsys
