// SPDX-License-Identifier: MIT
// Picking: describes the part of a plant or forest that a pixel shows, as lines of text, and traces
// the module that drew it. Renderer::pick() finds the part. The production that wrote the module
// and the trace are found by deriving again; a window does this on other threads.
#pragma once

#include "runtime/pipeline/file_position.h"
#include "runtime/pipeline/growth_moment.h"
#include "runtime/pipeline/trace.h"
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

/// A triangle of a plant in the state in which the plant is shown.
struct PickedTriangle {
    std::uint64_t triangle = 0;         // number; corners: Mesh::indices from 3 * triangle on
    glm::vec3 place{};                  // m
    const Skeleton* pose = nullptr;     // the skeleton as shown; never null in describe()
    MeshOptions mesh;                   // options with which the pose was meshed
    std::optional<GrowthMoment> moment; // moment of a growing plant; empty: all generations
};

/// A module in a word of a plant.
struct PickedModule {
    std::uint64_t position = 0;   // in the word, from 0
    std::uint32_t generation = 0; // of the word
};

struct Description {
    std::vector<std::string> lines;
    std::optional<PickedModule> module;  // module of a plant that drew the picked part
    std::string hint;                    // why there is no trace; may be empty
    std::optional<FilePosition> place{}; // of the production that wrote the module or branch
};

/// Describes the module that drew a triangle, the production that wrote it, with place and
/// generation, and the segment, object or polygon. `options`: the options with which `document` was
/// made.
[[nodiscard]] Outcome<Description> describe(const PickedTriangle& picked,
                                            const PlantDocument& document,
                                            const ViewOptions& options,
                                            const Project& project);

/// The text of `lsc trace` about a module that describe() has found with the same `document` and
/// `options`. `colour`: whether the text has SGR codes.
[[nodiscard]] Outcome<std::string> trace_picked(const PickedModule& module,
                                                TraceScope scope,
                                                bool colour,
                                                const PlantDocument& document,
                                                const ViewOptions& options,
                                                const Project& project);

/// Describes a branch with its id, age and hero, the production that wrote it, with place and
/// generation, the number of its copies in the forest, and its tree; for an impostor only the tree.
/// `trees_of_form`: numbers of all trees of the same form, from Renderer::trees_of().
/// `file`: the scene, or a grammar.
[[nodiscard]] Outcome<Description> describe(const Picked& picked,
                                            const std::vector<std::uint32_t>& trees_of_form,
                                            const ForestDocument& document,
                                            const std::string& file,
                                            const Project& project);

/// trace_picked() with all arguments bound except module and scope.
using TraceFunction =
    std::function<Outcome<std::string>(const PickedModule&, TraceScope, const Project&)>;

/// The input of a picking thread: a call of describe() with its arguments bound.
struct PickRequest {
    std::function<Outcome<Description>(const Project&)> describe;
    TraceFunction trace; // traces the module described; empty in forests
    RunOptions run;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// Returns the description; if it fails, the messages as a description.
[[nodiscard]] Description run_pick(const PickRequest& request, const std::atomic<bool>& cancelled);

using PickWorker = LatestRequestWorker<PickRequest, Description>;

/// The input of a tracing thread.
struct TraceRequest {
    TraceFunction trace;
    PickedModule module;
    TraceScope scope = TraceScope::Written;
    RunOptions run;
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// Returns the text of the trace, followed by messages; after an error only messages.
[[nodiscard]] std::string run_trace(const TraceRequest& request,
                                    const std::atomic<bool>& cancelled);

using TraceWorker = LatestRequestWorker<TraceRequest, std::string>;

} // namespace lsys::view
