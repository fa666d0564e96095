// PlantMotion: a plant that bends and sways, on a thread of its own: it steps the physics with the
// clock and meshes the plant anew, as fast as what it makes is taken.
#pragma once

#include "runtime/physics/physics.h"
#include "viewer/app/plant_document.h"

#include <functional>
#include <memory>

namespace lsys::view {

/// A moment of the motion.
struct BentPlant {
    Skeleton skeleton;
    Mesh mesh;
    double time = 0.0;    // s, of the physics
    double seconds = 0.0; // that it took to make
};

struct Bending {
    PhysicsOptions forces;
    float stiffness = 1.0F; // factor of all springs
};

class PlantMotion {
public:
    /// `done` is called on the thread of the motion when there is something to take().
    PlantMotion(std::shared_ptr<const PlantDocument> document,
                const Bending& bending,
                const MeshOptions& mesh,
                std::function<void()> done);
    PlantMotion(const PlantMotion&) = delete;
    PlantMotion& operator=(const PlantMotion&) = delete;
    ~PlantMotion();

    /// Other forces; other springs begin at rest again.
    void set(const Bending& bending);
    /// Exchanges `plant` for the newest moment, if there is one that was not taken yet.
    [[nodiscard]] bool take(BentPlant& plant);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
