// SPDX-License-Identifier: MIT
#include "runtime/platform/folder_events.h"

#include "runtime/platform/file.h"

#include <array>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>
#include <utility>

namespace lsys::platform {

namespace fs = std::filesystem;

struct FolderEvents::State {
    File wake{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)}; // readable after FolderEvents::wake()
    File inotify;
    std::map<int, fs::path> folders; // by watch descriptor

    void read_events(std::vector<fs::path>& changed) {
        alignas(inotify_event) std::array<std::byte, 16 * (sizeof(inotify_event) + NAME_MAX + 1)>
            buffer{};
        while (true) {
            const ssize_t count = ::read(inotify.descriptor(), buffer.data(), buffer.size());
            if (count <= 0) {
                return;
            }
            const auto end = static_cast<std::size_t>(count);
            for (std::size_t at = 0; at < end;) {
                inotify_event event{};
                std::memcpy(&event, buffer.data() + at, sizeof event);
                const auto folder = folders.find(event.wd);
                if (event.len != 0 && folder != folders.end()) {
                    // The name is zero-terminated.
                    changed.push_back(folder->second / reinterpret_cast<const char*>(
                                                           buffer.data() + at + sizeof event));
                }
                at += sizeof event + event.len;
            }
        }
    }
};

FolderEvents::FolderEvents(bool receives) : state_(std::make_unique<State>()) {
    if (receives) {
        state_->inotify = File(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
    }
}

FolderEvents::~FolderEvents() = default;

bool FolderEvents::receives() const {
    return state_->inotify.is_open();
}

void FolderEvents::watch(const std::vector<fs::path>& folders) {
    if (!receives()) {
        return;
    }
    const int inotify = state_->inotify.descriptor();
    std::map<int, fs::path> wanted;
    for (const fs::path& folder : folders) {
        const int number =
            ::inotify_add_watch(inotify, folder.c_str(),
                                IN_CLOSE_WRITE | IN_MODIFY | IN_MOVED_TO | IN_MOVED_FROM |
                                    IN_CREATE | IN_DELETE | IN_ONLYDIR);
        if (number >= 0) {
            wanted.emplace(number, folder);
        }
    }
    for (const auto& [number, folder] : state_->folders) {
        if (!wanted.contains(number)) {
            ::inotify_rm_watch(inotify, number);
        }
    }
    state_->folders = std::move(wanted);
}

FolderEvents::Waited FolderEvents::wait(std::chrono::milliseconds time) {
    std::array<pollfd, 2> waiting = {
        {{state_->wake.descriptor(), POLLIN, 0}, {state_->inotify.descriptor(), POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), receives() ? 2 : 1, static_cast<int>(time.count()));
    Waited waited;
    waited.timed_out = ready == 0;
    if (waiting[0].revents != 0) {
        std::uint64_t count = 0;
        static_cast<void>(::read(state_->wake.descriptor(), &count, sizeof count));
    }
    if (receives() && waiting[1].revents != 0) {
        state_->read_events(waited.changed);
    }
    return waited;
}

void FolderEvents::wake() {
    const std::uint64_t one = 1;
    static_cast<void>(::write(state_->wake.descriptor(), &one, sizeof one));
}

} // namespace lsys::platform
