// SPDX-License-Identifier: MIT
#include "viewer/app/making_progress.h"

#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace lsys::view {

namespace {

constexpr std::array<const char*, kCountOf<LongStep>> kNames{
    "Reading files",   "Deriving",       "Drawing",      "Making meshes",
    "Choosing heroes", "Growing heroes", "Placing trees"};

/// Expected modules of the first generations divided by those of all; empty if they are unknown.
std::optional<float> fraction_of(const DerivationProgress& progress) {
    if (progress.expected.size() <= progress.generations) {
        return std::nullopt;
    }
    double done = static_cast<double>(progress.modules);
    double all = 0.0;
    for (std::uint32_t i = 1; i <= progress.generations; ++i) {
        all += progress.expected[i];
        done += i < progress.generation ? progress.expected[i] : 0.0;
    }
    return all > 0.0 ? std::optional(static_cast<float>(std::min(done / all, 1.0))) : std::nullopt;
}

} // namespace

void MakingProgress::follow(Host& host) {
    host.step_begins = [this](LongStep step) { begin(step); };
    host.progress = [this](const DerivationProgress& progress) { derive(progress); };
    begin(LongStep::Read);
}

MakingState MakingProgress::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void MakingProgress::begin(LongStep step) {
    const std::lock_guard lock(mutex_);
    state_ = {kNames[static_cast<std::size_t>(step)], std::nullopt};
}

void MakingProgress::derive(const DerivationProgress& progress) {
    const std::lock_guard lock(mutex_);
    state_ = {fmt::format("Deriving generation {} of {}: {} modules", progress.generation,
                          progress.generations, grouped(progress.modules)),
              fraction_of(progress)};
}

} // namespace lsys::view
