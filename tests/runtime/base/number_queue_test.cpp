// SPDX-License-Identifier: MIT
#include "runtime/base/number_queue.h"
#include "runtime/base/workers.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

using lsys::NumberQueue;
using lsys::Workers;

TEST_CASE("every number of a queue is taken once") {
    constexpr std::uint64_t kCount = 10'000;
    constexpr std::uint64_t kRange = 7;
    NumberQueue queue;
    std::vector<std::atomic<int>> taken(kCount);
    Workers workers(4);
    const auto fill = [&] {
        for (std::uint64_t begin = 0; begin < kCount; begin += kRange) {
            while (queue.left() >= 2 * kRange) {
                queue.wait_below(2 * kRange, std::chrono::milliseconds(1));
            }
            queue.add(begin, std::min(begin + kRange, kCount));
        }
        queue.close();
    };
    workers.run(fill, [&] {
        while (const auto number = queue.take()) {
            ++taken[*number];
        }
    });
    for (const std::atomic<int>& count : taken) {
        REQUIRE(count == 1);
    }
    CHECK(queue.left() == 0);
}

TEST_CASE("an empty range is not added, and a closed queue ends") {
    NumberQueue queue;
    queue.add(3, 3);
    CHECK(!queue.take_now());
    queue.add(3, 5);
    queue.close();
    CHECK(queue.take() == 3);
    CHECK(queue.take_now() == 4);
    CHECK(!queue.take());
}
