// SPDX-License-Identifier: MIT
#include "runtime/platform/folder_events.h"

#if LSYS_THREADS
#include <condition_variable>
#include <mutex>
#endif

namespace lsys::platform {

#if LSYS_THREADS

struct FolderEvents::State {
    std::mutex mutex; // guards is_woken
    std::condition_variable woken;
    bool is_woken = false; // wake() was called since the last wait() ended
};

FolderEvents::Waited FolderEvents::wait(std::chrono::milliseconds time) {
    std::unique_lock lock(state_->mutex);
    Waited waited;
    waited.timed_out = !state_->woken.wait_for(lock, time, [this] { return state_->is_woken; });
    state_->is_woken = false;
    return waited;
}

void FolderEvents::wake() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->is_woken = true;
    }
    state_->woken.notify_one();
}

#else

struct FolderEvents::State {};

FolderEvents::Waited FolderEvents::wait(std::chrono::milliseconds /*time*/) {
    return {true, {}};
}

void FolderEvents::wake() {}

#endif

FolderEvents::FolderEvents(bool /*receives*/) : state_(std::make_unique<State>()) {}

FolderEvents::~FolderEvents() = default;

bool FolderEvents::receives() const {
    return false;
}

void FolderEvents::watch(const std::vector<std::filesystem::path>& /*folders*/) {}

} // namespace lsys::platform
