// SPDX-License-Identifier: MIT
#include "viewer/app/file_watch.h"

#include "runtime/platform/file.h"
#include "runtime/platform/folder_events.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace lsys::view {

namespace {

namespace fs = std::filesystem;

using platform::stamp_of;

constexpr int kMaxDelayRatio = 10; // max delay of a report / Options::quiet
/// Max interval of polls on systems without events of files.
constexpr std::chrono::milliseconds kPollWithoutEvents{100};

/// Absolute paths whose events mean that `path` has changed: `path` itself and the targets of its
/// links.
std::vector<fs::path> names_of(const std::string& path) {
    std::error_code error;
    std::vector<fs::path> names;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    if (!error) {
        names.push_back(absolute);
    }
    const fs::path real = fs::canonical(path, error);
    if (!error && (names.empty() || real != names.front())) {
        names.push_back(real);
    }
    return names;
}

struct Watched {
    std::string path;
    std::vector<fs::path> names; // names_of(path)
    platform::FileStamp stamp;
    /// Time of the first unreported change; empty: none.
    std::optional<FileWatch::Clock::time_point> changed;
};

} // namespace

struct FileWatch::State {
    Options options;
    Changed changed;
    platform::FolderEvents events;
    std::mutex mutex; // guards `requested` and `stops`
    std::optional<std::vector<std::string>> requested;
    bool stops = false; // tells the thread to end
    // Used by the watching thread only.
    std::vector<Watched> files;
    std::thread thread;

    State(const Options& wanted, Changed report)
        : options(wanted), changed(std::move(report)), events(wanted.use_events) {
        if (wanted.use_events && !events.receives()) {
            options.poll = std::min(options.poll, kPollWithoutEvents);
        }
    }

    /// Watches the requested files; returns false to stop the thread.
    bool take_requested() {
        std::optional<std::vector<std::string>> paths;
        {
            const std::lock_guard lock(mutex);
            if (stops) {
                return false;
            }
            paths = std::exchange(requested, std::nullopt);
        }
        if (paths) {
            set_files(*paths);
        }
        return true;
    }

    void set_files(const std::vector<std::string>& paths) {
        std::vector<Watched> before = std::move(files);
        files.clear();
        for (const std::string& path : paths) {
            const auto is_same = [&path](const Watched& file) { return file.path == path; };
            if (std::any_of(files.begin(), files.end(), is_same)) {
                continue;
            }
            const auto known = std::find_if(before.begin(), before.end(), is_same);
            if (known != before.end()) {
                files.push_back(std::move(*known));
                files.back().names = names_of(path);
            } else {
                files.push_back({path, names_of(path), stamp_of(path), std::nullopt});
            }
        }
        watch_folders();
    }

    void watch_folders() {
        std::vector<fs::path> folders;
        for (const Watched& file : files) {
            for (const fs::path& name : file.names) {
                folders.push_back(name.parent_path());
            }
        }
        events.watch(folders);
    }

    void mark(const fs::path& name, Clock::time_point now) {
        for (Watched& file : files) {
            if (std::find(file.names.begin(), file.names.end(), name) != file.names.end() &&
                !file.changed) {
                file.changed = now;
            }
        }
    }

    void check_stamps(Clock::time_point now) {
        for (Watched& file : files) {
            if (!file.changed && stamp_of(file.path) != file.stamp) {
                file.changed = now;
            }
        }
    }

    /// Reports all changes, unless a changed file has been missing for less than `options.missing`.
    void report(Clock::time_point now) {
        std::vector<std::string> names;
        Clock::time_point first = Clock::time_point::max();
        for (const Watched& file : files) {
            if (!file.changed) {
                continue;
            }
            if (!stamp_of(file.path).exists && now - *file.changed < options.missing) {
                return;
            }
            names.push_back(file.path);
            first = std::min(first, *file.changed);
        }
        for (Watched& file : files) {
            if (file.changed) {
                file.changed.reset();
                file.stamp = stamp_of(file.path);
                file.names = names_of(file.path); // link targets may change
            }
        }
        if (!names.empty()) {
            watch_folders();
            changed(names, first);
        }
    }

    /// Time of the first unreported change.
    [[nodiscard]] std::optional<Clock::time_point> first_change() const {
        std::optional<Clock::time_point> first;
        for (const Watched& file : files) {
            if (file.changed && (!first || *file.changed < *first)) {
                first = file.changed;
            }
        }
        return first;
    }

    void run() {
        Clock::time_point next_check = Clock::now() + options.poll;
        while (take_requested()) {
            const Clock::time_point before = Clock::now();
            const auto until_check =
                std::max(std::chrono::duration_cast<std::chrono::milliseconds>(next_check - before),
                         std::chrono::milliseconds(1));
            const bool in_change = first_change().has_value();
            const platform::FolderEvents::Waited waited =
                events.wait(in_change ? std::min(options.quiet, until_check) : until_check);
            const Clock::time_point now = Clock::now();
            for (const fs::path& name : waited.changed) {
                mark(name, now);
            }
            if (now >= next_check) {
                next_check = now + options.poll;
                check_stamps(now);
            }
            // Reports when no event has come for `quiet` or, in folders with constant writes, after
            // kMaxDelayRatio times `quiet`.
            const auto first = first_change();
            if (first && ((in_change && waited.timed_out) ||
                          now - *first > kMaxDelayRatio * options.quiet)) {
                report(now);
            }
        }
    }
};

FileWatch::FileWatch(const Options& options, Changed changed)
    : state_(std::make_unique<State>(options, std::move(changed))) {
    state_->thread = std::thread([state = state_.get()] { state->run(); });
}

FileWatch::~FileWatch() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stops = true;
    }
    state_->events.wake();
    state_->thread.join();
}

void FileWatch::watch(const std::vector<std::string>& files) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->requested = files;
    }
    state_->events.wake();
}

} // namespace lsys::view
