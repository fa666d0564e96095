// SPDX-License-Identifier: MIT
#include "runtime/base/latest_job.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace lsys::tests {

#if LSYS_THREADS

namespace {

constexpr std::chrono::milliseconds kLong{600'000};

/// A job that runs until it is cancelled.
void run_until_cancelled(const LatestJob::Flags& flags) {
    while (!flags.cancelled) {
        std::this_thread::yield();
    }
}

} // namespace

TEST_CASE("a newer job cancels those before it, and each runs once, in order") {
    std::string log;
    LatestJob jobs;
    for (const char name : {'a', 'b', 'c'}) {
        jobs.start(
            "key",
            [&log, name](const LatestJob::Flags& flags) {
                if (name != 'c') {
                    run_until_cancelled(flags);
                }
                log += name;
                log += flags.cancelled ? '-' : '+';
            },
            kLong);
    }
    jobs.wait();
    CHECK(log == "a-b-c+");
}

TEST_CASE("jobs with different keys run one after another") {
    std::string log;
    LatestJob jobs;
    for (const char name : {'a', 'b', 'c'}) {
        jobs.start(
            std::string(1, name),
            [&log, name](const LatestJob::Flags& flags) {
                log += name;
                log += flags.cancelled ? '-' : '+';
            },
            kLong);
    }
    jobs.wait();
    CHECK(log == "a+b+c+");
}

TEST_CASE("a job is cancelled by hand, after its time, and at the end") {
    std::atomic<int> ended{0};
    std::atomic<int> late{0}; // jobs that ended because of their time
    {
        LatestJob jobs;
        const auto job = [&](const LatestJob::Flags& flags) {
            run_until_cancelled(flags);
            late += flags.out_of_time ? 1 : 0;
            ++ended;
        };
        jobs.start("key", job, kLong);
        jobs.cancel("other");
        jobs.cancel("key");
        jobs.wait();
        CHECK(ended == 1);
        CHECK(late == 0);
        jobs.start("key", job, std::chrono::milliseconds(20));
        jobs.wait();
        CHECK(ended == 2);
        CHECK(late == 1);
        jobs.start("key", job, kLong);
    }
    CHECK(ended == 3);
    CHECK(late == 1);
}

#endif

} // namespace lsys::tests
