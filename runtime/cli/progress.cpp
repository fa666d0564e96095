#include "runtime/cli/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace lsys::lsc {

namespace {

constexpr auto kPatience = std::chrono::seconds(1);
constexpr auto kInterval = std::chrono::milliseconds(100);
constexpr std::uint64_t kWidth = 24;
constexpr const char* kBackToStart = "\r\x1b[K";

} // namespace

void Progress::update(std::uint32_t generation, std::uint64_t modules, Clock::time_point now) {
    if (terminal_ == nullptr || now - begin_ < kPatience || (drawn_ && now - last_ < kInterval)) {
        return;
    }
    last_ = now;
    drawn_ = true;
    const std::uint64_t of = std::max<std::uint64_t>(generations_, 1);
    const auto filled = static_cast<std::size_t>(std::min(kWidth * generation / of, kWidth));
    *terminal_ << kBackToStart
               << fmt::format("[{}{}] generation {} of {}, {} modules", std::string(filled, '='),
                              std::string(static_cast<std::size_t>(kWidth) - filled, ' '),
                              generation, generations_, modules)
               << std::flush;
}

void Progress::clear() {
    if (drawn_) {
        *terminal_ << kBackToStart << std::flush;
        drawn_ = false;
    }
}

} // namespace lsys::lsc
