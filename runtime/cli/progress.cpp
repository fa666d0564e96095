// SPDX-License-Identifier: MIT
#include "runtime/cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <string>

namespace lsys::lsc {

namespace {

constexpr auto kShowDelay = std::chrono::seconds(1);
constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr std::uint64_t kBarWidth = 24; // characters of the bar
constexpr const char* kClearLine = "\r\x1b[K";

/// A rate with few digits: "830", "12 k", "210 M", "3 G".
std::string short_text(double count) {
    constexpr std::array<const char*, 4> kUnits{"", " k", " M", " G"};
    std::size_t unit = 0;
    while (count >= 1000.0 && unit + 1 < kUnits.size()) {
        count /= 1000.0;
        ++unit;
    }
    return fmt::format("{:.0f}{}", count, kUnits[unit]);
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<std::uint64_t>(std::min(seconds + 0.5, 360000.0));
    if (whole < 60) {
        return fmt::format("{} s", whole);
    }
    return whole < 3600 ? fmt::format("{}:{:02} min", whole / 60, whole % 60)
                        : fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

} // namespace

/// The text of the remaining time, estimated from the rate so far.
std::string
Progress::time_left(std::uint32_t generation, std::uint64_t modules, double seconds) const {
    if (expected_.size() <= generations_) {
        return {};
    }
    double done = static_cast<double>(modules);
    double all = 0.0;
    for (std::uint32_t i = 1; i <= generations_; ++i) {
        all += expected_[i];
        done += i < generation ? expected_[i] : 0.0;
    }
    if (!(done > 0.0)) {
        return {};
    }
    return ", " + duration_text(std::max(all - done, 0.0) / done * seconds) + " left";
}

void Progress::update(std::uint32_t generation, std::uint64_t modules, Clock::time_point now) {
    earlier_modules_ += generation != generation_ ? modules_ : 0;
    generation_ = generation;
    modules_ = modules;
    if (terminal_ == nullptr || now - begin_ < kShowDelay ||
        (drawn_ && now - last_drawn_ < kRedrawInterval)) {
        return;
    }
    last_drawn_ = now;
    drawn_ = true;
    const std::uint64_t total = std::max<std::uint64_t>(generations_, 1);
    const auto filled =
        static_cast<std::size_t>(std::min(kBarWidth * generation / total, kBarWidth));
    const double seconds = std::chrono::duration<double>(now - begin_).count();
    const double rate = static_cast<double>(earlier_modules_ + modules) / seconds;
    *terminal_ << kClearLine
               << fmt::format("[{}{}] generation {} of {}, {} modules, {}/s{}",
                              std::string(filled, '='),
                              std::string(static_cast<std::size_t>(kBarWidth) - filled, ' '),
                              generation, generations_, modules, short_text(rate),
                              time_left(generation, modules, seconds))
               << std::flush;
}

void Progress::clear() {
    if (drawn_) {
        *terminal_ << kClearLine << std::flush;
        drawn_ = false;
    }
}

PipelineProgress::PipelineProgress(const Console& console, Host& host) {
    if (!console.shows_progress()) {
        return;
    }
    host.progress = [this, &console](const DerivationProgress& progress) {
        if (!bar_) {
            bar_.emplace(&console.io().err, progress.generations, begin_, progress.expected);
        }
        bar_->update(progress.generation, progress.modules, Progress::Clock::now());
    };
}

} // namespace lsys::lsc
