// SPDX-License-Identifier: MIT
#include "runtime/base/workers.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

using lsys::Workers;

TEST_CASE("workers run every piece of every task once") {
    for (const std::uint32_t threads : {1U, 2U, 3U, 9U}) {
        Workers workers(threads);
        CHECK(workers.count() == threads);
        for (std::uint64_t pieces = 0; pieces < 200; ++pieces) {
            std::vector<std::atomic<int>> taken(pieces);
            workers.for_each(pieces, [&](std::uint64_t piece) { ++taken[piece]; });
            for (const std::atomic<int>& count : taken) {
                REQUIRE(count == 1);
            }
        }
    }
}

TEST_CASE("workers work at the same time") {
    Workers workers(4);
    // Each piece waits until all four run, so the test ends only if each of four threads has one.
    std::atomic<int> there{0};
    workers.for_each(4, [&](std::uint64_t) {
        ++there;
        while (there < 4) {
            std::this_thread::yield();
        }
    });
    CHECK(there == 4);
}

TEST_CASE("writes of a worker are visible after the task") {
    Workers workers(3);
    std::vector<std::uint64_t> squares(10'000);
    for (std::uint64_t round = 1; round < 50; ++round) {
        workers.for_each(squares.size(),
                         [&](std::uint64_t piece) { squares[piece] = round * piece * piece; });
        for (std::uint64_t i = 0; i < squares.size(); ++i) {
            REQUIRE(squares[i] == round * i * i);
        }
    }
}

TEST_CASE("idle workers end") {
    const Workers unused(8);
    Workers resting(8);
    resting.for_each(2, [](std::uint64_t) {});
    // Long enough for the helpers to stop polling and sleep.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    resting.for_each(2, [](std::uint64_t) {});
}

TEST_CASE("workers can be destroyed while a helper wakes up") {
    // At the end of a round, a helper may wake up for a task that other threads have finished.
    for (int round = 0; round < 20'000; ++round) {
        Workers workers(2);
        std::atomic<int> done{0};
        workers.for_each(2, [&](std::uint64_t) { ++done; });
        REQUIRE(done == 2);
    }
}

TEST_CASE("a piece that runs out of memory ends the task with std::bad_alloc") {
    for (const std::uint32_t threads : {1U, 4U}) {
        Workers workers(threads);
        const auto run = [&](bool has_memory) {
            workers.for_each(100, [&](std::uint64_t piece) {
                if (!has_memory && piece % 40 == 7) {
                    throw std::length_error("too long");
                }
            });
        };
        CHECK_THROWS(run(false));
        CHECK_NOTHROW(run(true)); // the threads still work
    }
}

TEST_CASE("helpers work beside the calling thread") {
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
        Workers workers(threads);
        const std::thread::id calling_thread = std::this_thread::get_id();
        std::atomic<std::uint32_t> helpers{0};
        std::atomic<bool> is_calling_thread{false};
        const auto caller = [&] {
            is_calling_thread = std::this_thread::get_id() == calling_thread;
            while (helpers < threads - 1) { // returns only if the helpers run at the same time
                std::this_thread::yield();
            }
        };
        workers.run(caller,
                    [&] { helpers += std::this_thread::get_id() != calling_thread ? 1 : 0; });
        CHECK(is_calling_thread);
        CHECK(helpers == threads - 1);
    }
    Workers workers(3);
    const auto fail = [] { throw std::bad_alloc(); };
    std::atomic<bool> has_begun{false};
    const auto wait = [&has_begun] {
        while (!has_begun) {
            std::this_thread::yield();
        }
    };
    const auto begin_and_fail = [&] {
        has_begun = true;
        fail();
    };
    CHECK_THROWS_AS(workers.run(wait, begin_and_fail), std::bad_alloc);
    CHECK_THROWS_AS(workers.run(fail, [] {}), std::bad_alloc);
}
