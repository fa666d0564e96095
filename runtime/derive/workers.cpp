#include "runtime/derive/workers.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>
#include <vector>

namespace lsys {

namespace {

#if defined(__SANITIZE_THREAD__)
constexpr bool kThreadSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
constexpr bool kThreadSanitizer = true;
#else
constexpr bool kThreadSanitizer = false;
#endif
#else
constexpr bool kThreadSanitizer = false;
#endif

} // namespace

struct Workers::Arena {
    explicit Arena(std::uint32_t threads) {
        if (threads > std::thread::hardware_concurrency()) {
            // without it TBB starts no more than the machine has, and says so on standard error
            more.emplace(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        }
        tasks.initialize(static_cast<int>(threads));
    }

    void run(std::uint32_t count, const std::function<void()>& task) {
        tasks.execute([&] {
            oneapi::tbb::parallel_for(
                std::uint32_t{0}, count, [&task](std::uint32_t) { task(); },
                oneapi::tbb::simple_partitioner());
        });
    }

    std::optional<oneapi::tbb::global_control> more;
    oneapi::tbb::task_arena tasks;
};

Workers::Workers(std::uint32_t threads)
    : count_(threads != 0 ? std::min(threads, 1024U)
                          : std::max(1U, std::thread::hardware_concurrency())) {}

Workers::~Workers() = default;

void Workers::for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece) {
    if (count_ == 1 || pieces <= 1) {
        for (std::uint64_t i = 0; i < pieces; ++i) {
            piece(i);
        }
        return;
    }
    // Each task takes the next piece until none is left, so that neighbours are done at about the
    // same time.
    std::atomic<std::uint64_t> next{0};
    const std::function<void()> task = [&] {
        for (std::uint64_t i = next.fetch_add(1); i < pieces; i = next.fetch_add(1)) {
            piece(i);
        }
    };
    const auto tasks = static_cast<std::uint32_t>(std::min<std::uint64_t>(count_, pieces));
    if (kThreadSanitizer) {
        // it cannot see how TBB's library orders its tasks, and would report every one of them
        std::vector<std::thread> threads;
        for (std::uint32_t i = 1; i < tasks; ++i) {
            threads.emplace_back(task);
        }
        task();
        for (std::thread& thread : threads) {
            thread.join();
        }
        return;
    }
    if (!arena_) {
        arena_ = std::make_unique<Arena>(count_);
    }
    arena_->run(tasks, task);
}

} // namespace lsys
