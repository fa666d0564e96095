// SPDX-License-Identifier: MIT
#include "runtime/pipeline/plant.h"

#include "runtime/derive/fold_reached.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/derive/stream.h"
#include "runtime/pipeline/growth_forecast.h"
#include "runtime/pipeline/impl/drawing_end.h"
#include "runtime/pipeline/impl/mesh_files.h"
#include "runtime/pipeline/sensed_plant.h"
#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/plant_size.h"
#include "runtime/turtle/turtle.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace lsys {

namespace {

/// Derives and stores the last word, then draws it.
DerivationEnd draw_stored(const DeriveOptions& options,
                          const Bytecode& bytecode,
                          const Project& project,
                          Turtle& turtle,
                          Plant& plant) {
    const Stopwatch deriving;
    Derivation derivation(bytecode, options);
    if (derivation.derive()) {
        return derivation.end();
    }
    plant.modules = derivation.word().module_count();
    plant.derive_seconds = deriving.seconds();
    project.begin(LongStep::Draw);
    const Stopwatch drawing;
    if (!turtle.reserve(derivation.word())) {
        static_cast<void>(turtle.feed(derivation.word()));
    }
    plant.draw_seconds = drawing.seconds();
    return {};
}

/// Draws modules as the derivation produces them, without storing the last word.
DerivationEnd draw_streamed(const DeriveOptions& options,
                            const Bytecode& bytecode,
                            Turtle& turtle,
                            Plant& plant) {
    const Stopwatch deriving;
    StreamOutcome outcome = derive_streamed(bytecode, options, [&](const StreamChunk& chunk) {
        return !turtle.feed(chunk.codes, chunk.parameters, chunk.origins);
    });
    plant.modules = outcome.modules;
    plant.derive_seconds = deriving.seconds();
    return turtle.end().stop ? DerivationEnd{} : std::move(outcome.end);
}

/// Applies the pipe model, widths in pixels, and `#set scale` or a height, where requested.
std::optional<Stop>
size_plant(const PlantOptions& options, const Grammar& grammar, Step& step, Skeleton& skeleton) {
    const Settings& settings = grammar.bytecode.settings;
    const StemMaterial material = material_of(settings);
    if (settings.pipe.is_set()) {
        const std::uint64_t max_bytes = step.project().limits.max_bytes;
        if (const std::optional<Stop> stop =
                apply_pipe(settings.pipe, material, max_bytes, skeleton)) {
            step.diagnose(stop == Stop::Limit ? plant_limit_diagnostic("the pipe model", max_bytes)
                                              : no_memory_diagnostic("the pipe model"),
                          nullptr);
            return stop;
        }
    }
    if (settings.width_unit == WidthUnit::Pixels && !settings.pipe.is_set()) {
        apply_pixels(material, skeleton);
    }
    const float height = options.height.value_or(settings.height);
    if (height == 0.0F && settings.scale != 1.0F) {
        scale_plant(static_cast<double>(settings.scale), material, skeleton);
    }
    if (height == 0.0F || scale_to_height(static_cast<double>(height), material, skeleton)) {
        return std::nullopt;
    }
    const char* const help = "a plant grows upwards, along +Y; one that lies flat has no height "
                             "that could be scaled";
    if (!options.height && grammar.height_span.file != kNoFile) {
        Diagnostic diagnostic =
            make_diagnostic(DiagnosticCode::BadSetting, grammar.height_span,
                            fmt::format("`height` is {} m, but the plant is flat", height));
        diagnostic.help.emplace_back(help);
        step.diagnose(std::move(diagnostic), grammar.sources);
        return Stop::Diagnosed;
    }
    step.messages.add_error(fmt::format("{}{}: the plant is flat",
                                        options.height ? "--height " : "`#set height` ", height));
    step.messages.add_help(help);
    return Stop::Failed;
}

/// The warning that a solid mesh has `pieces` separate parts.
Diagnostic separate_pieces(std::uint64_t pieces) {
    Diagnostic diagnostic =
        make_diagnostic(DiagnosticCode::SeparatePieces, {},
                        fmt::format("the solid consists of {} pieces that do not touch", pieces));
    diagnostic.help.emplace_back(
        "a printer needs parts that hang together: draw the gaps, or close them with a larger "
        "`--min-width`");
    return diagnostic;
}

} // namespace

Diagnostic
derivation_diagnostic(const DerivationEnd& end, const Limits& limits, const Grammar& grammar) {
    const bool has_sources = !grammar.is_module_file;
    return end.stop == Stop::Diagnosed
               ? runtime_diagnostic(end.error, grammar.bytecode, has_sources)
               : limit_diagnostic(end.limit, limits, grammar.bytecode, has_sources);
}

DeriveOptions
derive_options(const PlantOptions& options, const Bytecode& bytecode, const Project& project) {
    DeriveOptions derive;
    derive.generations = options.generations.value_or(bytecode.generations.value_or(0));
    derive.seed = options.seed.value_or(bytecode.settings.has_seed ? bytecode.settings.seed : 0);
    derive.threads = project.threads;
    derive.origins = options.origins;
    derive.limits = project.limits;
    derive.cancelled = project.host.cancelled;
    return derive;
}

void fold_modules(const DeriveOptions& options, Bytecode& bytecode) {
    if (std::optional<Bytecode> folded =
            fold_reached(bytecode, options.seed, options.generations)) {
        bytecode = std::move(*folded);
    }
}

namespace {

/// Returns whether the derivation is certain to exceed the limit on modules, and reports this.
bool exceeds_limit(const DeriveOptions& derive, const Grammar& grammar, Step& step) {
    const std::optional<LimitReport> limit =
        predict_limit(grammar.bytecode, derive.generations, derive.limits);
    if (limit) {
        step.diagnose(
            limit_diagnostic(*limit, derive.limits, grammar.bytecode, !grammar.is_module_file),
            grammar.sources);
    }
    return limit.has_value();
}

/// Makes `derive` report progress to the host. `expected` must outlive the derivation.
void report_progress(const Bytecode& bytecode,
                     const Project& project,
                     std::vector<double>& expected,
                     DeriveOptions& derive) {
    if (!project.host.progress) {
        return;
    }
    expected = predict_expected_modules(bytecode, derive.generations);
    derive.progress = [&expected, &project, generations = derive.generations](
                          std::uint32_t generation, std::uint64_t modules) {
        project.host.progress({generation, generations, modules, expected});
    };
}

} // namespace

Outcome<DerivedWord>
derive_word(const PlantOptions& options, const Grammar& grammar, const Project& project) {
    Step step(project);
    DeriveOptions derive = derive_options(options, grammar.bytecode, project);
    if (exceeds_limit(derive, grammar, step)) {
        return step.end(Stop::Limit);
    }
    PlantSenses senses;
    if (!step.take(read_senses(options.file, grammar, project), senses)) {
        return step.end();
    }
    project.begin(LongStep::Derive);
    DerivedWord derived;
    derived.generations = derive.generations;
    derived.seed = derive.seed;
    derived.folded = fold_reached(grammar.bytecode, derive.seed, derive.generations);
    const Bytecode& bytecode = derived.folded ? *derived.folded : grammar.bytecode;
    std::vector<double> expected;
    report_progress(bytecode, project, expected, derive);
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(bytecode);
    derive.senses = own_senses.get();
    Derivation derivation(bytecode, derive);
    if (const std::optional<Stop> stop = derivation.derive()) {
        if (stop != Stop::Cancelled) {
            step.diagnose(derivation_diagnostic(derivation.end(), derive.limits, grammar),
                          grammar.sources);
        }
        return step.end(*stop);
    }
    derived.word = derivation.take_word();
    return step.done(std::move(derived));
}

Outcome<Plant> grow_plant(const PlantOptions& options, Grammar& grammar, const Project& project) {
    Step step(project);
    Bytecode& bytecode = grammar.bytecode;
    DeriveOptions derive = derive_options(options, bytecode, project);
    Plant plant;
    plant.generations = derive.generations;
    plant.seed = derive.seed;
    if (options.stream) {
        if (const std::optional<std::string> reason = streaming_obstacle(bytecode)) {
            return step.fail(fmt::format("--stream: {}", *reason));
        }
    } else if (exceeds_limit(derive, grammar, step)) {
        return step.end(Stop::Limit);
    }
    fold_modules(derive, bytecode);
    std::vector<double> expected;
    report_progress(bytecode, project, expected, derive);
    TurtleOptions turtle_options;
    MeshFiles meshes;
    FileBudget budget{project.limits.max_bytes};
    if (!step.take(read_mesh_files(options.file, grammar, project, budget), meshes)) {
        return step.end();
    }
    plant.user_meshes = std::move(meshes.meshes);
    PlantSenses senses;
    if (!step.take(read_senses(options.file, grammar, project), senses)) {
        return step.end();
    }
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(bytecode);
    derive.senses = own_senses.get();
    project.begin(LongStep::Derive);
    turtle_options.mesh_lengths = std::move(meshes.lengths);
    turtle_options.looks = std::move(meshes.looks);
    turtle_options.max_bytes = project.limits.max_bytes;
    turtle_options.cancelled = project.host.cancelled;
    turtle_options.seed = derive.seed;
    turtle_options.generations = derive.generations;
    Turtle turtle(bytecode, turtle_options);
    const DerivationEnd derived = options.stream
                                      ? draw_streamed(derive, bytecode, turtle, plant)
                                      : draw_stored(derive, bytecode, project, turtle, plant);
    if (!derived.stop) {
        static_cast<void>(turtle.finish());
    }
    if (const std::optional<Stop> stop = report_drawing(derived, turtle.end(), grammar, step)) {
        return step.end(*stop);
    }
    plant.skeleton = turtle.take_skeleton();
    std::shared_ptr<SensedPlant> sensed;
    if (options.senses && own_senses != nullptr) {
        sensed =
            std::make_shared<SensedPlant>(sensed_plant_of(bytecode, senses.files, *own_senses));
    }
    const double own_height = sensed == nullptr ? 0.0 : height_of(plant.skeleton);
    if (const std::optional<Stop> stop = size_plant(options, grammar, step, plant.skeleton)) {
        return step.end(*stop);
    }
    if (own_height > 0.0) {
        sensed->scale = height_of(plant.skeleton) / own_height;
    }
    plant.sensed = std::move(sensed);
    return step.done(std::move(plant));
}

namespace {

MeshOptions limited_options(const MeshOptions& options, const Project& project) {
    MeshOptions limited = options;
    limited.threads = project.threads;
    limited.max_bytes = project.limits.max_bytes;
    return limited;
}

// Meshes are computed in binary32, where squares of lengths overflow at 1.8e19 m. The mesh of a
// larger plant would lack parts; which ones depends on MeshOptions::method.
constexpr float kMaxExtent = 1e15F; // m

/// An Error if a segment, object or corner is so large or so far away that meshes cannot show it.
Result<void> check_extent(const Skeleton& skeleton) {
    const auto is_near = [](float a, float b, float c) {
        return std::max({std::abs(a), std::abs(b), std::abs(c)}) <= kMaxExtent;
    };
    const auto is_point_near = [&](const glm::vec3& at) { return is_near(at.x, at.y, at.z); };
    const bool fits =
        std::all_of(skeleton.segments.begin(), skeleton.segments.end(),
                    [&](const Segment& segment) {
                        return is_point_near(segment.base) &&
                               is_near(segment.length, segment.base_radius, segment.tip_radius);
                    }) &&
        std::all_of(skeleton.objects.begin(), skeleton.objects.end(),
                    [&](const PlacedObject& object) {
                        return is_point_near(object.position) && is_near(object.size, 0.0F, 0.0F);
                    }) &&
        std::all_of(skeleton.corners.begin(), skeleton.corners.end(), is_point_near);
    return fits ? Result<void>()
                : Error{fmt::format("the plant is too large for a mesh: its coordinates, lengths "
                                    "and radii are at most {:g} m",
                                    kMaxExtent)};
}

template <typename Value>
Outcome<Value> finish_mesh(Step& step, std::optional<Stop> stop, Value value) {
    if (!stop) {
        return step.done(std::move(value));
    }
    if (stop != Stop::Failed) {
        return step.end_too_large(*stop, "the mesh");
    }
    step.diagnose(plant_limit_diagnostic("the mesh", "4,294,967,295 vertices",
                                         "ask for fewer sides with `--sides`, for a coarser "
                                         "`--level`, or for fewer generations with `-n`"),
                  nullptr);
    return step.end(Stop::Limit);
}

} // namespace

Outcome<Mesh> mesh_plant(const Plant& plant,
                         const Skeleton& skeleton,
                         const MeshOptions& options,
                         const Project& project) {
    Step step(project);
    project.begin(LongStep::Mesh);
    if (const Result<void> checked = check_extent(skeleton); !checked) {
        return step.fail(checked.error());
    }
    Mesh mesh;
    const std::optional<Stop> stop =
        make_mesh(skeleton, plant.user_meshes, limited_options(options, project), mesh);
    if (!stop && mesh.shells > 1 && !step.diagnose(separate_pieces(mesh.shells), nullptr)) {
        return step.end(Stop::Diagnosed);
    }
    return finish_mesh(step, stop, std::move(mesh));
}

Outcome<DetailLevels> plan_plant_levels(const Plant& plant,
                                        const Skeleton& skeleton,
                                        const MeshOptions& options,
                                        const DetailChain& chain,
                                        const Project& project) {
    Step step(project);
    if (const Result<void> checked = check_extent(skeleton); !checked) {
        return step.fail(checked.error());
    }
    DetailLevels levels;
    const std::optional<Stop> stop = plan_detail_levels(
        skeleton, plant.user_meshes, limited_options(options, project), chain, levels);
    return finish_mesh(step, stop, std::move(levels));
}

Outcome<Mesh> mesh_plant_level(const Plant& plant,
                               const Skeleton& skeleton,
                               const DetailLevels& levels,
                               std::size_t number,
                               const MeshOptions& options,
                               const Project& project) {
    Step step(project);
    Mesh mesh;
    const std::optional<Stop> stop = make_detail_mesh(skeleton, plant.user_meshes, levels, number,
                                                      limited_options(options, project), mesh);
    if (!stop && mesh.shells > 1 && !step.diagnose(separate_pieces(mesh.shells), nullptr)) {
        return step.end(Stop::Diagnosed);
    }
    return finish_mesh(step, stop, std::move(mesh));
}

} // namespace lsys
