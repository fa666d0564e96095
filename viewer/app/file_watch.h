// SPDX-License-Identifier: MIT
// FileWatch: reports changes of files. Watches their folders by events of the system, so that it
// also sees files that editors replace. Polls times and sizes too, for file systems without events.
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
        /// Duration without events after which all changes are reported together.
        std::chrono::milliseconds quiet{10};
        /// Max time that a file may be missing, for example while an editor replaces it, before its
        /// absence is reported.
        std::chrono::milliseconds missing{250};
        /// Interval of polls; at most 100 ms on systems without events.
        std::chrono::milliseconds poll{1000};
        bool use_events = true;
    };
    /// Called on the watching thread with the changed files, as the paths given to watch(), and the
    /// time of the first change.
    using Changed = std::function<void(const std::vector<std::string>& files, Clock::time_point)>;

    FileWatch(const Options& options, Changed changed);
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;
    ~FileWatch();

    /// Replaces the list of watched files; the files need not exist. Unreported changes of files
    /// that stay in the list are kept.
    void watch(const std::vector<std::string>& files);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
