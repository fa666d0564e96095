// FileWatch: tells when files change. Folders are watched by inotify, so that editors that replace
// a file by another of its name are seen; what the files' times and sizes say is looked at as well
// now and then, which is all there is where inotify does not work.
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
        /// Changes that follow each other so quickly are one.
        std::chrono::milliseconds quiet{10};
        /// So long a file may be missing, as while an editor replaces it.
        std::chrono::milliseconds missing{250};
        std::chrono::milliseconds poll{1000};
        bool use_inotify = true;
    };
    /// The files that changed, as they were named, and when the first of them was seen to change.
    /// Called on a thread of the watch.
    using Changed = std::function<void(const std::vector<std::string>& files, Clock::time_point)>;

    FileWatch(const Options& options, Changed changed);
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;
    ~FileWatch();

    /// The files that are watched from now on; they need not be there. What changed in those that
    /// were watched before and still are is told.
    void watch(const std::vector<std::string>& files);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::view
