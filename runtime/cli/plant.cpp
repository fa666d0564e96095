#include "runtime/cli/plant.h"

#include "runtime/cli/files.h"
#include "runtime/cli/foresight.h"
#include "runtime/cli/mesh_pictures.h"
#include "runtime/cli/progress.h"
#include "runtime/cli/stopwatch.h"
#include "runtime/cli/tell.h"
#include "runtime/derive.h"
#include "runtime/fold_reached.h"
#include "runtime/runtime_diagnostic.h"
#include "runtime/stream.h"
#include "runtime/turtle.h"
#include "runtime/turtle_diagnostic.h"
#include "runtime/user_mesh.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <utility>

namespace lsys::lsc {

namespace {

/// The derivation, then the drawing of its last word.
Status draw_stored(const DeriveOptions& options,
                   const Grammar& grammar,
                   const Console& console,
                   Turtle& turtle,
                   TurtleStatus& drawn,
                   Plant& plant) {
    const Clock::time_point start = Clock::now();
    Derivation derivation(*grammar.bytecode, options);
    DeriveStatus status = derivation.start();
    if (status == DeriveStatus::Ok) {
        status = derivation.run_to(options.generations);
    }
    if (status == DeriveStatus::Ok) {
        status = derivation.check_brackets();
    }
    const Status told =
        tell(status, derivation.error(), derivation.limit(), options.limits, grammar, console);
    if (told != Status::Fine) {
        return told;
    }
    plant.modules = derivation.word().module_count();
    plant.derive_seconds = seconds_since(start);
    const Clock::time_point drawing = Clock::now();
    drawn = turtle.reserve(derivation.word());
    if (drawn == TurtleStatus::Ok) {
        drawn = turtle.feed(derivation.word());
    }
    plant.draw_seconds = seconds_since(drawing);
    return Status::Fine;
}

/// Draws while it derives, and stores no word.
Status draw_streamed(const DeriveOptions& options,
                     const Grammar& grammar,
                     const Console& console,
                     Turtle& turtle,
                     TurtleStatus& drawn,
                     Plant& plant) {
    const Clock::time_point start = Clock::now();
    const StreamOutcome outcome =
        derive_streamed(*grammar.bytecode, options, [&](const StreamChunk& chunk) {
            drawn = turtle.feed(chunk.codes, chunk.parameters, chunk.origins);
            return drawn == TurtleStatus::Ok;
        });
    plant.modules = outcome.modules;
    plant.derive_seconds = seconds_since(start);
    if (drawn != TurtleStatus::Ok) {
        return Status::Fine; // the turtle's end is told
    }
    return tell(outcome.status, outcome.error, outcome.limit, options.limits, grammar, console);
}

} // namespace

Status tell_drawn(TurtleStatus status,
                  const std::array<TurtleFault, kTurtleFaultKinds>& faults,
                  std::uint64_t max_bytes,
                  const Grammar& grammar,
                  const Console& console) {
    Diagnostics diagnostics;
    for (Diagnostic& diagnostic : turtle_diagnostics(faults, *grammar.bytecode)) {
        diagnostics.add(std::move(diagnostic));
    }
    if (status == TurtleStatus::Limit) {
        diagnostics.add(plant_limit_diagnostic("the skeleton", max_bytes));
    } else if (status == TurtleStatus::OutOfMemory) {
        diagnostics.add(no_memory_diagnostic("the skeleton"));
    }
    const Status shown = console.show(diagnostics, grammar.sources);
    switch (status) {
    case TurtleStatus::Ok:
    case TurtleStatus::Fault:
        return shown;
    case TurtleStatus::Limit:
    case TurtleStatus::OutOfMemory:
        return Status::Limit;
    case TurtleStatus::Cancelled:
        return Status::Interrupted;
    case TurtleStatus::NotInterpreted:
        return Status::AuthorErrors;
    }
    return Status::Failure;
}

Status read_user_meshes(const std::string& grammar_file,
                        const Bytecode& bytecode,
                        const Console& console,
                        FileBudget& budget,
                        std::vector<UserMesh>& meshes,
                        std::vector<float>& lengths) {
    Status shown = Status::Fine;
    const std::filesystem::path folder = std::filesystem::path(grammar_file).parent_path();
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        if (symbol.turtle != TurtleOperation::MeshFile) {
            continue;
        }
        const std::string path = (folder / symbol.mesh_file).string();
        const Result<std::string> text =
            read_bytes(path, {~std::uint64_t{0}, budget.left}, console);
        if (!text) {
            return fail(Error{fmt::format("cannot read `{}`: {}", path, text.error().message),
                              text.error().kind},
                        console);
        }
        Result<UserMesh> mesh = read_obj(text.value(), budget.left - text.value().size());
        if (!mesh) {
            return fail(Error{fmt::format("cannot use `{}`: {}", path, mesh.error().message),
                              mesh.error().kind},
                        console);
        }
        shown = worse(shown, read_mesh_picture(path, text.value(), console, budget, mesh.value()));
        if (shown == Status::Limit) {
            return shown;
        }
        budget.take(mesh.value().byte_count());
        lengths.resize(bytecode.symbols.size(), 1.0F);
        lengths[i] = mesh.value().length();
        meshes.push_back(std::move(mesh.value()));
    }
    return shown;
}

void fold_modules(const DeriveOptions& options, Grammar& grammar) {
    if (std::optional<Bytecode> folded =
            fold_reached(*grammar.bytecode, options.seed, options.generations)) {
        grammar.bytecode = std::move(*folded);
    }
}

Status
grow_plant(const PlantRequest& request, Grammar& grammar, const Console& console, Plant& plant) {
    const Bytecode& bytecode = *grammar.bytecode;
    DeriveOptions options;
    options.generations = request.generations.value_or(bytecode.generations.value_or(0));
    options.seed = request.seed.value_or(bytecode.settings.has_seed ? bytecode.settings.seed : 0);
    options.threads = request.threads;
    options.origins = request.origins;
    options.limits = {request.max_modules, request.max_bytes};
    options.cancelled = console.io().interrupted;
    plant.generations = options.generations;
    plant.seed = options.seed;
    if (request.stream) {
        if (const std::optional<std::string> reason = why_not_streamable(bytecode)) {
            return fail(Error{fmt::format("--stream: {}", *reason)}, console);
        }
    } else if (const std::optional<LimitReport> limit =
                   foresee_limit(bytecode, options.generations, options.limits)) {
        return show(limit_diagnostic(*limit, options.limits, bytecode, !grammar.is_module_file),
                    Status::Limit, grammar, console);
    }
    fold_modules(options, grammar);
    const bool shows = console.shows_progress();
    Progress progress(shows ? &console.io().err : nullptr, options.generations, Clock::now(),
                      shows ? expect_modules(bytecode, options.generations)
                            : std::vector<double>());
    options.progress = [&](std::uint32_t generation, std::uint64_t modules) {
        progress.update(generation, modules, Clock::now());
    };
    TurtleOptions turtle_options;
    FileBudget budget{request.max_bytes};
    if (const Status read = read_user_meshes(request.file, bytecode, console, budget,
                                             plant.user_meshes, turtle_options.mesh_lengths);
        read != Status::Fine) {
        return read;
    }
    turtle_options.max_bytes = request.max_bytes;
    turtle_options.cancelled = console.io().interrupted;
    turtle_options.seed = options.seed;
    turtle_options.generations = options.generations;
    Turtle turtle(bytecode, turtle_options);
    TurtleStatus drawn = TurtleStatus::Ok;
    const Status status = request.stream
                              ? draw_streamed(options, grammar, console, turtle, drawn, plant)
                              : draw_stored(options, grammar, console, turtle, drawn, plant);
    progress.clear();
    if (status != Status::Fine) {
        return status;
    }
    if (drawn == TurtleStatus::Ok) {
        drawn = turtle.finish();
    }
    if (drawn == TurtleStatus::NotInterpreted) {
        return tell(DeriveStatus::Error, turtle.error(), {}, options.limits, grammar, console);
    }
    const Status told = tell_drawn(drawn, turtle.faults(), request.max_bytes, grammar, console);
    plant.skeleton = turtle.take_skeleton();
    return told;
}

Status mesh_plant(const Plant& plant,
                  const Skeleton& skeleton,
                  const MeshOptions& options,
                  const Grammar& grammar,
                  const Console& console,
                  Mesh& mesh) {
    switch (make_mesh(skeleton, plant.user_meshes, options, mesh)) {
    case MeshStatus::Ok:
        return Status::Fine;
    case MeshStatus::TooManyVertices:
        return show(plant_limit_diagnostic("the mesh", "4,294,967,295 vertices",
                                           "ask for fewer sides with `--sides`, for a coarser "
                                           "`--level`, or for fewer generations with `-n`"),
                    Status::Limit, grammar, console);
    case MeshStatus::Limit:
        return show(plant_limit_diagnostic("the mesh", options.max_bytes), Status::Limit, grammar,
                    console);
    case MeshStatus::OutOfMemory:
        return show(no_memory_diagnostic("the mesh"), Status::Limit, grammar, console);
    }
    return Status::Failure;
}

} // namespace lsys::lsc
