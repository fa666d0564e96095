// SPDX-License-Identifier: MIT
// FolderEvents: waits for changes of the entries of folders, with inotify on Linux. Other systems
// report no changes: callers compare stamps of files (file.h) at intervals.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

namespace lsys::platform {

class FolderEvents {
public:
    /// With `receives` false no event is received, as on file systems without events.
    explicit FolderEvents(bool receives);
    FolderEvents(const FolderEvents&) = delete;
    FolderEvents& operator=(const FolderEvents&) = delete;
    ~FolderEvents();

    /// Whether events can be received.
    [[nodiscard]] bool receives() const;
    /// Replaces the watched folders; a missing folder has no events.
    void watch(const std::vector<std::filesystem::path>& folders);

    struct Waited {
        bool timed_out = false;
        /// Entries of watched folders that were written, made, removed or renamed.
        std::vector<std::filesystem::path> changed;
    };
    /// Waits for an event, for wake(), or for at most `time`. Only one thread may call wait() and
    /// watch().
    [[nodiscard]] Waited wait(std::chrono::milliseconds time);
    /// Ends the current wait(), or else the next. Callable by any thread.
    void wake();

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys::platform
