// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/variety_note.h"

#include "grammar/base/counted_text.h"
#include "runtime/base/size_text.h"
#include "runtime/forest/different_trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kFirstSample = 512; // trees compared first; more only if few of them differ
constexpr double kNearlyAll = 0.9; // fraction of different trees in the sample; above: no note
constexpr std::size_t kMaxSample = 20'000;   // max trees compared per species
constexpr std::uint64_t kManyShapes = 1'000; // number of different trees; with as many: no note

/// Whether most keys of the cache (docs/language.md section 9.5) have only one recorded branch.
bool has_single_instances(const ForestSpecies& species) {
    std::uint64_t key_count = 0;
    std::uint64_t single_count = 0;
    for (const ForestStage& stage : species.stages) {
        for (std::size_t i = 1; i < stage.cache.slots.size(); ++i) {
            ++key_count;
            single_count += stage.cache.slots[i].variant_count == 1 ? 1U : 0U;
        }
    }
    return 2 * single_count > key_count;
}

std::string advice(const SceneSpecies& species, const ForestSpecies& grown) {
    constexpr float kHighRho = 0.75F; // for a greater rho, a smaller one is proposed
    std::string text = fmt::format("more heroes make more of them: `--heroes {}`",
                                   std::min(4 * species.cache.heroes, kMaxHeroes));
    if (species.rho > kHighRho) {
        text += fmt::format(", and so does a rho below {}: `--rho 0.5`", species.rho);
    }
    if (species.cache.tolerance == 0.0F && species.rho > 0.0F && has_single_instances(grown)) {
        text += ", and so does `--instance-tolerance 0.1`, as most keys have a single branch";
    }
    return text;
}

} // namespace

void note_variety(const Scene& scene, const GrownForest& grown, Step& step) {
    if (scene.goal.is_set()) {
        return; // choose_instancing() has reported how many trees differ
    }
    const Forest& forest = grown.forest;
    std::vector<std::vector<Tree>> trees(forest.species.size());
    std::vector<std::uint64_t> counts(forest.species.size(), 0);
    for (const Tree& tree : forest.trees) {
        ++counts[tree.species];
        if (trees[tree.species].size() < kMaxSample) {
            trees[tree.species].push_back(tree);
        }
    }
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        const SceneSpecies& species = scene.species[s];
        const AxiomPlace& axiom = grown.axioms[s];
        const bool is_wanted =
            species.cache.heroes == 1 || (species.rho == 0.0F && species.explicit_instancing.rho);
        if (trees[s].size() < 2 || is_wanted || axiom.is_noted) {
            continue;
        }
        const std::span<const Tree> all(trees[s]);
        const std::span<const Tree> first = all.first(std::min(kFirstSample, all.size()));
        std::uint64_t different = count_different_trees(forest, first);
        if (static_cast<double>(different) >= kNearlyAll * static_cast<double>(first.size())) {
            continue;
        }
        different = first.size() == all.size() ? different : count_different_trees(forest, all);
        if (2 * different >= all.size() || different >= kManyShapes) {
            continue;
        }
        const std::string of = (all.size() == counts[s] ? "" : "the first ") +
                               counted(all.size(), grouped_digits(all.size()), "tree");
        Diagnostic note =
            make_diagnostic(DiagnosticCode::NoVariety, axiom.span,
                            fmt::format("only {} of {} of `{}` {}", grouped_digits(different), of,
                                        species.name, different == 1 ? "differs" : "differ"));
        note.help.push_back(advice(species, forest.species[s]));
        note.help.emplace_back("`--variety 0.99` chooses heroes and rho for 99 % different trees");
        step.diagnose(std::move(note), axiom.sources);
    }
}

} // namespace lsys
