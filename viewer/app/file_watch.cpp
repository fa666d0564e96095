#include "viewer/app/file_watch.h"

#include "runtime/program/descriptor.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace lsys::view {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxDelay = 10; // max delay of a report, as a multiple of Options::quiet

/// Attributes of a file that change with its contents.
struct Stamp {
    bool exists = false;
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    std::int64_t size = 0;
    std::uint64_t node = 0;

    friend bool operator==(const Stamp&, const Stamp&) = default;
};

Stamp stamp_of(const std::string& path) {
    struct stat facts {};
    if (::stat(path.c_str(), &facts) != 0) {
        return {};
    }
    return {true, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec, facts.st_size, facts.st_ino};
}

/// Names whose events are changes of `path`: its own name and that of its link target.
std::vector<fs::path> names_of(const std::string& path) {
    std::error_code error;
    std::vector<fs::path> names;
    const fs::path own = fs::absolute(path, error).lexically_normal();
    if (!error) {
        names.push_back(own);
    }
    const fs::path real = fs::canonical(path, error);
    if (!error && (names.empty() || real != names.front())) {
        names.push_back(real);
    }
    return names;
}

struct Watched {
    std::string path;
    std::vector<fs::path> names;
    Stamp stamp;
    /// First unreported change.
    std::optional<FileWatch::Clock::time_point> changed;
};

} // namespace

struct FileWatch::State {
    Options options;
    Changed changed;
    Descriptor wake{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
    Descriptor inotify;
    std::mutex mutex; // guards the next two
    std::optional<std::vector<std::string>> requested;
    bool stops = false;
    // Used by the thread only.
    std::vector<Watched> files;
    std::map<int, fs::path> folders; // by watch descriptor
    std::thread thread;

    State(const Options& wanted, Changed report)
        : options(wanted), changed(std::move(report)),
          inotify(wanted.use_inotify ? ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK) : -1) {}

    void notify() const {
        const std::uint64_t one = 1;
        static_cast<void>(::write(wake.get(), &one, sizeof one));
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
        if (inotify.get() < 0) {
            return;
        }
        std::map<int, fs::path> wanted;
        for (const Watched& file : files) {
            for (const fs::path& name : file.names) {
                const fs::path folder = name.parent_path();
                const int number =
                    ::inotify_add_watch(inotify.get(), folder.c_str(),
                                        IN_CLOSE_WRITE | IN_MODIFY | IN_MOVED_TO | IN_MOVED_FROM |
                                            IN_CREATE | IN_DELETE | IN_ONLYDIR);
                if (number >= 0) {
                    wanted.emplace(number, folder);
                }
            }
        }
        for (const auto& [number, folder] : folders) {
            if (!wanted.contains(number)) {
                ::inotify_rm_watch(inotify.get(), number);
            }
        }
        folders = std::move(wanted);
    }

    void mark(const fs::path& name, Clock::time_point now) {
        for (Watched& file : files) {
            if (std::find(file.names.begin(), file.names.end(), name) != file.names.end() &&
                !file.changed) {
                file.changed = now;
            }
        }
    }

    void read_events(Clock::time_point now) {
        alignas(inotify_event) std::array<std::byte, 16 * (sizeof(inotify_event) + NAME_MAX + 1)>
            buffer{};
        while (true) {
            const ssize_t count = ::read(inotify.get(), buffer.data(), buffer.size());
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
                    mark(folder->second /
                             reinterpret_cast<const char*>(buffer.data() + at + sizeof event),
                         now);
                }
                at += sizeof event + event.len;
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

    /// Reports changes, unless a file has been missing for a short time only.
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
            std::array<pollfd, 2> waiting = {{{wake.get(), POLLIN, 0}, {inotify.get(), POLLIN, 0}}};
            const bool in_change = first_change().has_value();
            const int ready = ::poll(
                waiting.data(), inotify.get() < 0 ? 1 : 2,
                static_cast<int>(
                    (in_change ? std::min(options.quiet, until_check) : until_check).count()));
            const Clock::time_point now = Clock::now();
            if (waiting[0].revents != 0) {
                std::uint64_t count = 0;
                static_cast<void>(::read(wake.get(), &count, sizeof count));
            }
            if (inotify.get() >= 0 && waiting[1].revents != 0) {
                read_events(now);
            }
            if (now >= next_check) {
                next_check = now + options.poll;
                check_stamps(now);
            }
            // Report when no event came for `quiet`, or after kMaxDelay in folders with constant
            // writes.
            const auto first = first_change();
            if (first && ((in_change && ready == 0) || now - *first > kMaxDelay * options.quiet)) {
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
    state_->notify();
    state_->thread.join();
}

void FileWatch::watch(const std::vector<std::string>& files) {
    {
        const std::lock_guard lock(state_->mutex);
        state_->requested = files;
    }
    state_->notify();
}

} // namespace lsys::view
