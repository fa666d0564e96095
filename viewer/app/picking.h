// Picking: description of the part of a plant or forest that a pixel shows, as lines of text.
// Renderer::pick() finds the part; the production that wrote it is found by deriving again, on a
// thread of its own in a window.
#pragma once

#include "runtime/pipeline/growth_moment.h"
#include "viewer/app/forest_document.h"
#include "viewer/app/latest_request_worker.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/renderer.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// A triangle of a plant as it is shown.
struct PickedTriangle {
    std::uint64_t triangle = 0; // in Mesh::indices
    glm::vec3 place{};          // m
    const Skeleton* pose = nullptr;
    MeshOptions mesh;                   // options with which the pose was meshed
    std::optional<GrowthMoment> moment; // moment of a growing plant; empty: all generations
};

/// Describes the module, its production with place and generation, and the segment, object or
/// polygon. `options`: the options with which the document was made.
[[nodiscard]] Outcome<std::vector<std::string>> describe(const PickedTriangle& picked,
                                                         const PlantDocument& document,
                                                         const ViewOptions& options,
                                                         const Project& project);

/// Describes the branch with id, age and hero, its production with place and generation, its count
/// in the forest, and its tree; for an impostor only the tree. `alike`: numbers of the living trees
/// of the same form, by Renderer::trees_of(). `file`: the scene, or a grammar.
[[nodiscard]] Outcome<std::vector<std::string>> describe(const Picked& picked,
                                                         const std::vector<std::uint32_t>& alike,
                                                         const ForestDocument& document,
                                                         const std::string& file,
                                                         const Project& project);

/// Work for another thread: a call of describe() with its arguments bound.
struct PickRequest {
    std::function<Outcome<std::vector<std::string>>(const Project&)> describe;
    RunOptions run;
    SteadyClock::time_point since;
    bool again = false;
};

struct PickOutcome {
    std::vector<std::string> lines;
};

[[nodiscard]] PickOutcome run_pick(const PickRequest& request, const std::atomic<bool>& cancelled);

using PickWorker = LatestRequestWorker<PickRequest, PickOutcome>;

} // namespace lsys::view
