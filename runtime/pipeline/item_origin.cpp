// SPDX-License-Identifier: MIT
#include "runtime/pipeline/item_origin.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/derive/word_text.h"
#include "runtime/pipeline/impl/drawing_end.h"
#include "runtime/pipeline/impl/mesh_files.h"
#include "runtime/pipeline/senses.h"
#include "runtime/pipeline/step.h"
#include "runtime/turtle/turtle.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// The origins of the items of one kind. Origin::place is the position of the module that drew the
/// item, as set by Derivation::follow().
const LargeVector<Origin>& origins_of(const Skeleton& skeleton, SkeletonItem::Kind kind) {
    switch (kind) {
    case SkeletonItem::Kind::Object:
        return skeleton.object_origins;
    case SkeletonItem::Kind::Polygon:
        return skeleton.polygon_origins;
    case SkeletonItem::Kind::Segment:
        break;
    }
    return skeleton.segment_origins;
}

std::string module_text(const Bytecode& bytecode, const Word& word, std::uint64_t number) {
    std::size_t parameter = 0;
    for (std::uint64_t i = 0; i < number; ++i) {
        parameter += bytecode.stored_parameters(word.code(i));
    }
    const std::array<Code, 1> code{word.code(number)};
    std::string text;
    WordPrinter(bytecode).append(
        code, word.parameters().subspan(parameter, bytecode.stored_parameters(code[0])), text);
    return text;
}

Outcome<ItemOrigin> find(const PlantOptions& options,
                         std::uint32_t generation,
                         const SkeletonItem& item,
                         Grammar& grammar,
                         const Project& project) {
    Step step(project);
    DeriveOptions derive = derive_options(options, grammar.bytecode, project);
    derive.origins = true;
    fold_modules(derive, grammar.bytecode);
    const Bytecode& bytecode = grammar.bytecode;
    MeshFiles meshes;
    FileBudget budget{project.limits.max_bytes};
    if (!step.take(read_mesh_files(options.file, grammar, project, budget), meshes)) {
        return step.end();
    }
    PlantSenses senses;
    if (!step.take(read_senses(options.file, grammar, project), senses)) {
        return step.end();
    }
    const std::unique_ptr<EnvironmentSense> own_senses = senses.make(bytecode);
    derive.senses = own_senses.get();
    Derivation derivation(bytecode, derive);
    if (derivation.start() || derivation.run_to(generation)) {
        return step.end(*report_drawing(derivation.end(), {}, grammar, step));
    }
    const auto word_origins = derivation.word().origins();
    const std::vector<Origin> origins(word_origins.begin(), word_origins.end());
    if (!derivation.follow()) {
        return step.fail("the word has more than 4,294,967,295 modules");
    }
    TurtleOptions turtle_options;
    turtle_options.mesh_lengths = std::move(meshes.lengths);
    turtle_options.max_bytes = project.limits.max_bytes;
    turtle_options.cancelled = project.host.cancelled;
    turtle_options.seed = derive.seed;
    turtle_options.generations = generation;
    Turtle turtle(bytecode, turtle_options);
    const Word& word = derivation.word();
    if (turtle.reserve(word) || turtle.feed(word) || turtle.finish()) {
        if (const std::optional<Stop> stop = report_drawing({}, turtle.end(), grammar, step)) {
            return step.end(*stop);
        }
    }
    ItemOrigin found;
    found.module_count = word.module_count();
    found.generation = generation;
    const LargeVector<Origin>& drawn = origins_of(turtle.skeleton(), item.kind);
    if (item.index < drawn.size()) {
        found.module_index = drawn[item.index].place;
        found.module = module_text(bytecode, word, found.module_index);
        OriginPrinter(bytecode).append(origins[found.module_index], found.origin);
        found.place = position_of(origins[found.module_index], bytecode);
    }
    return step.done(std::move(found));
}

} // namespace

Outcome<ItemOrigin> origin_of_item(const PlantOptions& options,
                                   std::uint32_t generation,
                                   const SkeletonItem& item,
                                   Grammar& grammar,
                                   const Project& project) {
    return catch_out_of_memory([&] { return find(options, generation, item, grammar, project); },
                               [&]() -> Outcome<ItemOrigin> {
                                   Step step(project);
                                   return step.end_too_large(Stop::OutOfMemory, "the word");
                               });
}

} // namespace lsys
