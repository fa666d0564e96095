// SPDX-License-Identifier: MIT
// FileWatch: reports changes of files. Watches folders by events of the system, so that files
// replaced by editors are seen, and polls times and sizes, for file systems without events.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsys::view {

class FileWatch {
public:
    using Clock = std::chrono::steady_clock;
    struct Options {
        /// Time without events after which changes are reported, all together.
        std::chrono::milliseconds quiet{10};
        /// Max time that a file may be missing, for example while an editor replaces it, before its
        /// absence is reported.
        std::chrono::milliseconds missing{250};
        /// Interval of polls; at most 100 ms on systems without events.
        std::chrono::milliseconds poll{1000};
        bool use_events = true;
    };
    /// Called on the watch's thread with the changed files, by their paths in watch(), and the time
    /// of the first change.
    using Changed = std::function<void(const std::vector<std::string>& files, Clock::time_point)>;

    FileWatch(const Options& options, Changed changed);
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;
    ~FileWatch();

    /// Replaces the watched files; they need not exist. Unreported changes of files that stay are
    /// kept.
    void watch(const std::vector<std::string>& files);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
