// SPDX-License-Identifier: MIT
#include "runtime/pipeline/instancing_choice.h"

#include "grammar/base/counted_text.h"
#include "runtime/forest/different_trees.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Cases of surroundings for which a species has heroes of their own.
std::size_t cases_of(const SceneSpecies& species) {
    return species.senses_surroundings ? kSurroundings : 1;
}

constexpr std::uint64_t kNoBytes = std::numeric_limits<std::uint64_t>::max();
// Values to try. The default rho comes first, since the first of equally good choices is taken.
constexpr std::array<float, 9> kRhos{0.6F, 0.5F, 0.7F, 0.4F, 0.8F, 0.3F, 0.2F, 0.1F, 0.0F};
constexpr std::array<std::uint32_t, 16> kHeroes{1,  2,  3,  4,  6,  8,   12,  16,
                                                24, 32, 48, 64, 96, 128, 192, 256};
static_assert(kHeroes.back() == kMaxChosenHeroes);
constexpr std::array<std::uint32_t, 12> kCaps{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
/// The search for one rho ends after this many consecutive entries of kHeroes without more
/// different trees.
constexpr int kIdleSteps = 4;

struct Choice {
    std::uint32_t heroes = 0; // CacheOptions::heroes
    float rho = 0.0F;
    std::uint32_t cap = 0;          // CacheOptions::cap
    std::uint64_t bytes = kNoBytes; // needed memory
    std::uint64_t different = 0;    // number of different trees
    std::uint32_t largest_slot = 0; // result: branches recorded in the fullest slot

    [[nodiscard]] bool is_set() const { return bytes != kNoBytes; }
};

std::string size_text(std::uint64_t bytes) {
    constexpr double kKiB = 1024.0;
    const auto size = static_cast<double>(bytes);
    if (size < kKiB) {
        return fmt::format("{}", bytes);
    }
    // Round up, so that --memory with this number suffices.
    return size < kKiB * kKiB ? fmt::format("{:.1f}K", std::ceil(size / kKiB * 10.0) / 10.0)
                              : fmt::format("{:.1f}M", std::ceil(size / kKiB / kKiB * 10.0) / 10.0);
}

std::string options_text(const Choice& choice) {
    std::string text = fmt::format("--heroes {} --rho {}", choice.heroes, choice.rho);
    if (choice.cap != 0) {
        text += fmt::format(" --cache-cap {}", choice.cap);
    }
    return text;
}

/// The search for one species.
class Search {
public:
    Search(const LoadedScene& loaded,
           std::size_t species,
           std::vector<Tree> trees,
           const Project& project)
        : project_(project), trees_(std::move(trees)), one_species_(loaded) {
        one_species_.scene.species = {loaded.scene.species[species]};
        one_species_.scene.placement.species = {loaded.scene.placement.species[species]};
        one_species_.scene.terrain = {};
        one_species_.scene.density_map = {};
        one_species_.scene.painting = {};
        for (Tree& tree : trees_) {
            tree.species = 0;
        }
    }

    /// Sets `smallest`, `best_in_budget` and `best`. `budget`: max bytes of `best_in_budget`.
    /// `max_bytes`: a choice of more bytes ends the search for its rho.
    Outcome<void> run(std::uint64_t budget, std::uint64_t max_bytes) {
        Step step(project_);
        const SceneSpecies& species = one_species_.scene.species.front();
        const ExplicitInstancing& written = species.explicit_instancing;
        const std::vector<float> rhos =
            written.rho ? std::vector{species.rho} : std::vector(kRhos.begin(), kRhos.end());
        const std::vector<std::uint32_t> heroes = written.heroes
                                                      ? std::vector{species.cache.heroes}
                                                      : std::vector(kHeroes.begin(), kHeroes.end());
        for (const float rho : rhos) {
            std::uint64_t shapes = 0;
            int idle = 0;
            for (const std::uint32_t count : heroes) {
                Choice choice{count, rho, written.cap ? species.cache.cap : 0};
                if (!step.take(try_choice(choice, budget))) {
                    return step.end();
                }
                if (!choice.is_set() || choice.bytes >= smallest.bytes ||
                    choice.bytes > max_bytes || choice.different >= needed) {
                    break; // more heroes would only take more memory
                }
                idle = choice.different > shapes ? 0 : idle + 1;
                shapes = std::max(shapes, choice.different);
                if (idle == kIdleSteps) {
                    break;
                }
            }
        }
        // A cap may save memory of `smallest`, or make `least` fit if no choice fits the budget.
        const Choice& capped = smallest.is_set() ? smallest : least;
        if (!written.cap && (smallest.is_set() || !best_in_budget.is_set())) {
            for (const std::uint32_t cap : kCaps) {
                Choice choice = capped;
                choice.cap = cap;
                const std::uint64_t bytes = capped.bytes;
                if (cap >= capped.largest_slot) {
                    break;
                }
                if (!step.take(try_choice(choice, budget))) {
                    return step.end();
                }
                if (capped.bytes < bytes) {
                    break; // a larger cap would only take more memory
                }
            }
        }
        return step.done();
    }

    /// Derives heroes without instancing and with different seeds. Returns whether they differ.
    Outcome<bool> compare_heroes() {
        Step step(project_);
        constexpr std::uint32_t kSeeds = 4;
        SceneSpecies& species = one_species_.scene.species.front();
        species.cache.heroes = kSeeds;
        species.rho = 0.0F;
        GrownForest grown;
        Step quiet(project_);
        if (!quiet.take(grow_species(one_species_, project_, {}), grown)) {
            return quiet.end();
        }
        grown.forest.trees.assign(trees_.begin(), trees_.end());
        const std::uint64_t shapes =
            std::max<std::size_t>(species.stages.size(), 1) * cases_of(species);
        return step.done(count_different_trees(grown.forest, project_.threads) > shapes);
    }

    [[nodiscard]] std::uint64_t tree_count() const { return trees_.size(); }
    [[nodiscard]] const std::string& name() const {
        return one_species_.scene.species.front().name;
    }

    std::uint64_t needed = 0; // min number of different trees
    Choice smallest;          // the choice of least memory with at least `needed` different trees
    Choice best_in_budget;    // the choice with most different trees within the budget
    Choice best;              // the choice with most different trees
    Choice least;             // the choice of least memory

private:
    /// Grows the heroes of `choice`, sets its results, and keeps it if it is better than earlier
    /// choices. Results stay unset if the heroes cannot be grown, for example at a limit.
    Outcome<void> try_choice(Choice& choice, std::uint64_t budget) {
        Step step(project_);
        SceneSpecies& species = one_species_.scene.species.front();
        species.cache.heroes = choice.heroes;
        species.rho = choice.rho;
        species.cache.cap = choice.cap;
        choice.bytes = kNoBytes;
        Outcome<GrownForest> outcome = grow_species(one_species_, project_, {});
        if (!outcome) {
            return outcome.stop() == Stop::Cancelled ? Outcome<void>(step.end(Stop::Cancelled))
                                                     : step.done();
        }
        Forest& forest = outcome.value().forest;
        choice.bytes = 0;
        for (const ForestStage& stage : forest.species.front().stages) {
            choice.bytes += stage.cache.byte_count() + stage.cache.skeleton.byte_count();
            for (std::size_t i = 1; i < stage.cache.slots.size(); ++i) {
                choice.largest_slot =
                    std::max(choice.largest_slot, stage.cache.slots[i].variant_count);
            }
        }
        least = choice.bytes < least.bytes ? choice : least;
        if (choice.bytes >= smallest.bytes) {
            return step.done();
        }
        forest.trees.assign(trees_.begin(), trees_.end());
        choice.different = count_different_trees(forest, project_.threads);
        const auto is_more = [](const Choice& a, const Choice& b) {
            return !b.is_set() || a.different > b.different ||
                   (a.different == b.different && a.bytes < b.bytes);
        };
        best = is_more(choice, best) ? choice : best;
        if (choice.bytes <= budget && is_more(choice, best_in_budget)) {
            best_in_budget = choice;
        }
        if (choice.different >= needed) {
            smallest = choice;
        }
        return step.done();
    }

    const Project& project_;
    std::vector<Tree> trees_;
    LoadedScene one_species_; // the scene reduced to this species, on flat ground
};

/// The share `variety` of `count` trees, rounded up.
std::uint64_t share_of(double variety, std::uint64_t count) {
    return static_cast<std::uint64_t>(std::ceil(variety * static_cast<double>(count) - 1e-9));
}

double part_of(std::uint64_t part, std::uint64_t all) {
    return all == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(all);
}

/// The placed trees, by species. Grows only one hero per species, since places do not depend on
/// heroes. Sets `is_noted` to AxiomPlace::is_noted, by species.
Outcome<std::vector<std::vector<Tree>>>
place_trees_of(const LoadedScene& loaded, const Project& project, std::vector<bool>& is_noted) {
    Step step(project);
    LoadedScene cheap = loaded;
    cheap.scene.goal = {};
    for (SceneSpecies& species : cheap.scene.species) {
        species.cache.heroes = 1; // with one hero there are no notes on variety
        species.rho = species.explicit_instancing.rho ? species.rho : 0.0F;
    }
    Step quiet(project); // its messages are dropped, since growing the forest repeats them
    GrownForest grown;
    if (!quiet.take(grow_species(cheap, project, {}), grown) ||
        !quiet.take(place_forest(cheap.scene, project, grown))) {
        return quiet.end();
    }
    std::vector<std::vector<Tree>> trees(cheap.scene.species.size());
    for (const Tree& tree : grown.forest.trees) {
        trees[tree.species].push_back(tree);
    }
    for (const AxiomPlace& axiom : grown.axioms) {
        is_noted.push_back(axiom.is_noted);
    }
    return step.done(std::move(trees));
}

/// A help text that names the nearest goals that can be reached.
std::string nearest_goals(const std::vector<Search>& searches, const InstancingGoal& goal) {
    std::uint64_t bytes = 0;
    bool all_have_smallest = true;
    bool all_fit_budget = true;
    double min_part_in_budget = 1.0;
    double min_best_part = 1.0;
    std::uint64_t least = 0; // least memory of the species that needs most
    std::string smallest_text;
    std::string in_budget_text;
    for (const Search& search : searches) {
        const auto add = [&](const Choice& choice, std::string& text) {
            text += text.empty() ? "" : "; ";
            text += searches.size() > 1 ? search.name() + ": " : std::string();
            text += options_text(choice);
        };
        all_have_smallest = all_have_smallest && search.smallest.is_set();
        all_fit_budget = all_fit_budget && search.best_in_budget.is_set();
        if (search.smallest.is_set()) {
            bytes += search.smallest.bytes;
            add(search.smallest, smallest_text);
        }
        if (search.best_in_budget.is_set()) {
            min_part_in_budget = std::min(
                min_part_in_budget, part_of(search.best_in_budget.different, search.tree_count()));
            add(search.best_in_budget, in_budget_text);
        }
        least = std::max(least, search.least.bytes);
        min_best_part =
            std::min(min_best_part, part_of(search.best.different, search.tree_count()));
    }
    const auto floor_text = [](double part) {
        return fmt::format("{}", std::floor(part * 1e4 + 1e-9) / 1e4);
    };
    if (all_have_smallest) {
        std::string text =
            fmt::format("`--memory {}` is enough ({})", size_text(bytes), smallest_text);
        if (all_fit_budget) {
            text += fmt::format(", or `--variety {}` for this memory ({})",
                                floor_text(min_part_in_budget), in_budget_text);
        }
        return text;
    }
    if (goal.max_bytes != 0 && all_fit_budget) {
        return fmt::format("`--variety {}` fits this memory ({})", floor_text(min_part_in_budget),
                           in_budget_text);
    }
    if (goal.variety <= 0.0 && least != kNoBytes) {
        // Each species may use an equal part of the memory.
        return fmt::format("`--memory {}` is the minimum", size_text(least * searches.size()));
    }
    return fmt::format("`--variety {}` is the maximum", floor_text(min_best_part));
}

void apply(const Choice& choice, SceneSpecies& species) {
    species.cache.heroes = choice.heroes;
    species.rho = choice.rho;
    species.cache.cap = choice.cap;
}

} // namespace

Outcome<void> choose_instancing(LoadedScene& loaded, const Project& project) {
    Step step(project);
    const InstancingGoal goal = loaded.scene.goal;
    if (!goal.is_set()) {
        return step.done();
    }
    project.begin(LongStep::ChooseHeroes);
    std::vector<std::vector<Tree>> trees;
    std::vector<bool> is_noted;
    if (!step.take(place_trees_of(loaded, project, is_noted), trees)) {
        return step.end();
    }
    const std::uint64_t budget =
        goal.max_bytes == 0 ? kNoBytes - 1 : goal.max_bytes / loaded.scene.species.size();
    const std::string wanted = goal.variety > 0.0
                                   ? fmt::format("--variety {}", goal.variety)
                                   : fmt::format("--memory {}", size_text(goal.max_bytes));
    std::vector<Search> searches;
    std::uint64_t bytes = 0;
    bool is_met = true;
    for (std::size_t s = 0; s < trees.size(); ++s) {
        SceneSpecies& species = loaded.scene.species[s];
        Search& search = searches.emplace_back(loaded, s, std::move(trees[s]), project);
        search.needed =
            goal.variety > 0.0 ? share_of(goal.variety, search.tree_count()) : search.tree_count();
        const std::uint64_t shapes =
            std::max<std::size_t>(species.stages.size(), 1) * cases_of(species);
        if (goal.variety > 0.0 && is_noted[s] && search.needed > shapes) {
            Outcome<bool> is_random = search.compare_heroes();
            bool differs = false;
            if (!step.take(std::move(is_random), differs)) {
                return step.end();
            }
            if (!differs) {
                return step.fail(fmt::format(
                    "{}: nothing that `{}` derives is left to chance, so all its plants are equal, "
                    "whatever heroes and rho are",
                    wanted, species.name));
            }
        }
        // With a goal of variety the search also tries choices beyond the budget, so that an error
        // can name a sufficient amount of memory.
        const std::uint64_t max_bytes = goal.variety > 0.0 ? kNoBytes : budget;
        if (!step.take(search.run(budget, max_bytes))) {
            return step.end();
        }
        const Choice& chosen = goal.variety > 0.0 ? search.smallest : search.best_in_budget;
        is_met = is_met && chosen.is_set();
        bytes += chosen.is_set() ? chosen.bytes : 0;
    }
    if (!is_met || (goal.max_bytes != 0 && bytes > goal.max_bytes)) {
        const bool has_both_goals = goal.variety > 0.0 && goal.max_bytes != 0;
        Step::Ended ended = step.fail(
            fmt::format("{}{}: no choice of heroes, rho and cache cap gives that", wanted,
                        has_both_goals ? fmt::format(" --memory {}", size_text(goal.max_bytes))
                                       : std::string()));
        ended.messages.add_help(nearest_goals(searches, goal));
        return ended;
    }
    for (std::size_t s = 0; s < searches.size(); ++s) {
        const Search& search = searches[s];
        const Choice& chosen = goal.variety > 0.0 ? search.smallest : search.best_in_budget;
        apply(chosen, loaded.scene.species[s]);
        step.messages.add_info(fmt::format(
            "{}: chose {}: {} of {} different, {}", search.name(), options_text(chosen),
            chosen.different, counted(search.tree_count(), "tree"), size_text(chosen.bytes)));
    }
    return step.done();
}

} // namespace lsys
