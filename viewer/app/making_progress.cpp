// SPDX-License-Identifier: MIT
#include "viewer/app/making_progress.h"

#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace lsys::view {

namespace {

constexpr std::array<const char*, kCountOf<LongStep>> kNames{
    "Reading files",   "Deriving",       "Drawing",      "Making meshes",
    "Choosing heroes", "Growing heroes", "Placing trees"};

} // namespace

void MakingProgress::follow(Host& host) {
    host.step_begins = [this](LongStep step) { note_step(step); };
    host.progress = [this](const DerivationProgress& progress) { note_derivation(progress); };
    note_step(LongStep::Read);
}

MakingState MakingProgress::state() const {
    const std::lock_guard lock(mutex_);
    if (step_ != LongStep::Derive || generation_ == 0) {
        return {kNames[static_cast<std::size_t>(step_)], std::nullopt};
    }
    MakingState state{fmt::format("Deriving generation {} of {}: {} modules", generation_,
                                  generations_, grouped(modules_)),
                      std::nullopt};
    if (expected_ > 0.0) {
        const double done = expected_before_ + static_cast<double>(modules_);
        state.fraction = static_cast<float>(std::min(done / expected_, 1.0));
    }
    return state;
}

void MakingProgress::note_step(LongStep step) {
    const std::lock_guard lock(mutex_);
    step_ = step;
    generation_ = 0;
}

/// Keeps a running sum of the expected modules, because summing up to 2^32 generations again for
/// each report would take too long.
void MakingProgress::note_derivation(const DerivationProgress& progress) {
    const std::lock_guard lock(mutex_);
    if (generation_ == 0) {
        const bool is_known = progress.expected.size() > progress.generations;
        expected_ =
            is_known ? std::accumulate(progress.expected.begin() + 1, progress.expected.end(), 0.0)
                     : 0.0;
        expected_before_ = 0.0;
        summed_ = 0;
    }
    while (expected_ > 0.0 && summed_ + 1 < progress.generation) {
        expected_before_ += progress.expected[++summed_];
    }
    generation_ = progress.generation;
    generations_ = progress.generations;
    modules_ = progress.modules;
}

} // namespace lsys::view
