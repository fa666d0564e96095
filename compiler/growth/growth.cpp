// SPDX-License-Identifier: MIT
#include "compiler/growth/growth.h"

#include "compiler/growth/impl/growth_powers.h"
#include "compiler/growth/impl/growth_totals.h"
#include "compiler/growth/impl/growth_walk.h"
#include "compiler/growth/impl/module_classes.h"

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

using analysis::GrowthPowers;
using analysis::GrowthWalk;
using analysis::ModuleClasses;
using analysis::same;

/// Max number of ClassTerms read plus classes present, summed over all generations of a listing.
constexpr std::uint64_t kMaxListWork = 5'000'000;

/// The sizes of generations 0, 1, ... up to the current generation of `walk`.
struct Listing {
    std::vector<GenerationSize> low;
    std::vector<GenerationSize> high;
    std::vector<double> expected; // mean numbers of modules
    std::optional<std::uint32_t> unchanged_from;
    SymbolId depends_on = kNoSymbol; // see GrowthPrediction::depends_on
};

/// Advances the walk to generation `generations`. Ends earlier if the lower bound of the modules
/// exceeds `max_modules`, if all later words are equal, if the next generation would exceed
/// kMaxListWork, or if the size of the next generation depends on an answer of an environment or on
/// a sweep.
Listing follow(const Bytecode& bytecode,
               GrowthWalk& walk,
               std::uint32_t generations,
               const Count& max_modules) {
    Listing listing;
    std::uint64_t work = 0;
    const bool changes = bytecode.has_senses() || bytecode.has_sweeps();
    for (;;) {
        listing.low.push_back(walk.low());
        listing.high.push_back(walk.high());
        listing.expected.push_back(walk.expected_modules());
        work += walk.present().size();
        if (walk.age() == generations || analysis::less(max_modules, listing.low.back().modules)) {
            return listing;
        }
        if (walk.is_final()) {
            listing.unchanged_from = walk.age();
            return listing;
        }
        listing.depends_on = changes ? walk.cause_of_next() : kNoSymbol;
        if (listing.depends_on != kNoSymbol || work + walk.work() > kMaxListWork) {
            return listing;
        }
        walk.advance();
    }
}

/// Narrows the bounds of a listing by bound_totals(): if modules have several outcomes, bounds of
/// whole words are sharper than sums of the bounds of classes.
void narrow_bounds(Listing& listing, ModuleClasses& classes) {
    bool exact = true;
    for (std::size_t g = 0; g < listing.low.size(); ++g) {
        exact = exact && same(listing.low[g], listing.high[g]);
    }
    if (exact) {
        return;
    }
    const analysis::SizeBounds bounds =
        bound_totals(classes, static_cast<std::uint32_t>(listing.low.size() - 1));
    const auto raise = [](Count& count, const Count& bound) {
        if (analysis::less(count, bound)) {
            count = bound;
        }
    };
    const auto lower = [](Count& count, const Count& bound) {
        if (analysis::less(bound, count)) {
            count = bound;
        }
    };
    for (std::size_t g = 0; g < bounds.low.size(); ++g) {
        raise(listing.low[g].modules, bounds.low[g].modules);
        raise(listing.low[g].parameters, bounds.low[g].parameters);
        raise(listing.low[g].segments, bounds.low[g].segments);
        raise(listing.low[g].bytes, bounds.low[g].bytes);
        lower(listing.high[g].modules, bounds.high[g].modules);
        lower(listing.high[g].parameters, bounds.high[g].parameters);
        lower(listing.high[g].segments, bounds.high[g].segments);
        lower(listing.high[g].bytes, bounds.high[g].bytes);
    }
}

constexpr Count kNoLimit{0, true, 1e300};

} // namespace

bool is_growth_known(const Bytecode& bytecode) {
    return !bytecode.has(Stage::Decompose) && !bytecode.has_cuts();
}

GrowthPrediction predict_growth(const Bytecode& bytecode, std::uint32_t generations) {
    if (!is_growth_known(bytecode)) {
        return {};
    }
    ModuleClasses classes(bytecode, generations);
    GrowthWalk walk(classes);
    const std::uint32_t listed = std::min(generations, kMaxListedGenerations);
    Listing listing = follow(bytecode, walk, listed, kNoLimit);
    narrow_bounds(listing, classes);

    GrowthPrediction prediction;
    prediction.unchanged_from = listing.unchanged_from;
    prediction.depends_on = listing.depends_on;
    if (listing.unchanged_from) {
        const std::size_t count = std::size_t{listed} + 1;
        listing.low.resize(count, listing.low.back());
        listing.high.resize(count, listing.high.back());
        listing.expected.resize(count, listing.expected.back());
    }
    prediction.low = std::move(listing.low);
    prediction.high = std::move(listing.high);
    prediction.exact = true;
    for (std::size_t g = 0; g < prediction.low.size(); ++g) {
        prediction.exact = prediction.exact && same(prediction.low[g], prediction.high[g]);
    }
    if (walk.probabilities_known() && !prediction.exact) {
        prediction.has_expected = true;
        prediction.expected_modules = std::move(listing.expected);
    }
    if (prediction.unchanged_from || prediction.low.size() == std::size_t{generations} + 1) {
        prediction.has_last = true;
        prediction.last_low = prediction.low.back();
        prediction.last_high = prediction.high.back();
    } else if (prediction.depends_on == kNoSymbol) {
        if (std::optional<GrowthPowers> powers = GrowthPowers::make(classes)) {
            powers->advance_to(walk, generations);
            prediction.has_last = true;
            prediction.last_low = walk.low();
            prediction.last_high = walk.high();
        }
    }
    return prediction;
}

GrowthEnd
find_growth_end(const Bytecode& bytecode, std::uint32_t generations, std::uint64_t max_modules) {
    if (!is_growth_known(bytecode)) {
        return {};
    }
    ModuleClasses classes(bytecode, generations);
    GrowthWalk walk(classes);
    const std::uint32_t listed = std::min(generations, kMaxListedGenerations);
    Listing listing = follow(bytecode, walk, listed, {max_modules, false, 0.0});
    narrow_bounds(listing, classes);

    std::optional<GrowthPowers> powers;
    if (walk.age() < generations && !listing.unchanged_from && listing.depends_on == kNoSymbol) {
        powers = GrowthPowers::make(classes);
    }
    GrowthLimit limit;
    const auto first_too_large =
        std::find_if(listing.low.begin(), listing.low.end(), [&](const GenerationSize& size) {
            return !size.modules.at_most(max_modules);
        });
    if (first_too_large != listing.low.end()) {
        const auto next = static_cast<std::size_t>(first_too_large - listing.low.begin());
        limit.largest_fitting = static_cast<std::uint32_t>(next == 0 ? 0 : next - 1);
        limit.at_largest = listing.low[limit.largest_fitting];
        limit.at_next = *first_too_large;
        limit.exact = same(listing.low[next], listing.high[next]);
        GrowthWalk before(classes);
        while (before.age() < limit.largest_fitting) {
            before.advance();
        }
        limit.dominant = before.dominant();
    } else if (powers && powers->never_shrinks()) {
        powers->advance_while_fitting(walk, generations, max_modules);
        if (walk.age() == generations) {
            return {};
        }
        limit.largest_fitting = walk.age();
        limit.at_largest = walk.low();
        limit.dominant = walk.dominant();
        walk.advance();
        limit.at_next = walk.low();
        limit.exact = same(walk.low(), walk.high());
    } else {
        GrowthEnd end;
        if (listing.unchanged_from) {
            end.fixed_point = {*listing.unchanged_from, listing.high.back().modules.at_most(0)};
        }
        return end;
    }
    // The size of the requested word, if it can be computed quickly.
    if (powers) {
        powers->advance_to(walk, generations);
    } else if (walk.age() < listed && listing.depends_on == kNoSymbol) {
        follow(bytecode, walk, listed, kNoLimit);
    }
    if (walk.age() == generations) {
        limit.has_requested = true;
        limit.at_requested = walk.low();
    }
    return {limit, std::nullopt};
}

} // namespace lsys
