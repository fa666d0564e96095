// SPDX-License-Identifier: MIT
#include "tests/support/lsc_run.h"
#include "viewer/app/file_watch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <thread>

using namespace lsys::tests;
using namespace lsys::view;
using namespace std::chrono_literals;

namespace {

/// Collects the changed files that a watch reports.
class ReportLog {
public:
    void add(const std::vector<std::string>& files) {
        const std::lock_guard lock(mutex_);
        files_.insert(files_.end(), files.begin(), files.end());
        ++times_;
        changed_.notify_all();
    }
    /// Waits up to 10 s for a report of `file`, then forgets all reports; returns whether it came.
    bool waits_for(const std::string& file) {
        std::unique_lock lock(mutex_);
        const bool is_reported = changed_.wait_for(lock, 10s, [&] {
            return std::find(files_.begin(), files_.end(), file) != files_.end();
        });
        files_.clear();
        return is_reported;
    }
    int times() {
        const std::lock_guard lock(mutex_);
        return times_;
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> files_;
    int times_ = 0;
};

struct Watching {
    explicit Watching(const FileWatch::Options& options)
        : watch(options,
                [this](const std::vector<std::string>& files, FileWatch::Clock::time_point) {
                    reports.add(files);
                }) {}
    ReportLog reports;
    FileWatch watch;
};

FileWatch::Options with_events() {
    FileWatch::Options options;
    options.poll = 1h; // so long that only events can report in time
    options.missing = 20ms;
    return options;
}

FileWatch::Options without_events() {
    FileWatch::Options options;
    options.use_events = false;
    options.poll = 5ms;
    options.missing = 20ms;
    return options;
}

/// Waits until the thread of the watch has begun to watch the requested files.
void settle() {
    std::this_thread::sleep_for(100ms);
}

} // namespace

TEST_CASE("a file that is written, replaced, removed or created is reported") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    const std::string other = folder / "leaf.obj";
    write_text(file, "one");
    Watching watching(GENERATE(with_events(), without_events()));
    watching.watch.watch({file, other});
    settle();
    write_text(file, "written");
    CHECK(watching.reports.waits_for(file));
    write_text(folder / "plant.lsys~", "renamed");
    std::filesystem::rename(folder / "plant.lsys~", file);
    CHECK(watching.reports.waits_for(file));
    write_text(file, "written again");
    CHECK(watching.reports.waits_for(file));
    std::filesystem::remove(file);
    CHECK(watching.reports.waits_for(file));
    write_text(file, "back");
    CHECK(watching.reports.waits_for(file));
    write_text(other, "new");
    CHECK(watching.reports.waits_for(other));
}

TEST_CASE("the target of a link is watched") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "real");
    const std::string real = folder / "real/plant.lsys";
    const std::string link = folder / "plant.lsys";
    write_text(real, "one");
    std::filesystem::create_symlink(real, link);
    Watching watching(with_events());
    watching.watch.watch({link});
    settle();
    write_text(real, "two");
    CHECK(watching.reports.waits_for(link));
}

TEST_CASE("changes in quick succession are one change, and other files are not reported") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "one");
    FileWatch::Options options = with_events();
    options.quiet = 200ms;
    Watching watching(options);
    watching.watch.watch({file});
    settle();
    for (int i = 0; i < 20; ++i) {
        write_text(folder / "other.lsys", "x");
        write_text(file, std::string(static_cast<std::size_t>(i), 'x'));
    }
    CHECK(watching.reports.waits_for(file));
    CHECK(watching.reports.times() == 1);
}

TEST_CASE("a change is reported in time while other files in the folder are written") {
    const ScratchFolder folder;
    const std::string file = folder / "plant.lsys";
    write_text(file, "one");
    Watching watching(with_events());
    watching.watch.watch({file});
    settle();
    std::atomic<bool> ends{false};
    std::thread noise([&] {
        while (!ends) {
            write_text(folder / "other.txt", "x");
            std::this_thread::sleep_for(1ms);
        }
    });
    write_text(file, "two");
    CHECK(watching.reports.waits_for(file));
    ends = true;
    noise.join();
}
