#include "runtime/derive/workers.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>

namespace lsys {

struct Workers::Arena {
    explicit Arena(std::uint32_t threads) {
        if (threads > std::thread::hardware_concurrency()) {
            // without it TBB starts no more than the machine has, and says so on standard error
            more.emplace(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        }
        tasks.initialize(static_cast<int>(threads));
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
    if (!arena_) {
        arena_ = std::make_unique<Arena>(count_);
    }
    // Each task takes the next piece until none is left, so that neighbours are done at about the
    // same time. The counters order what pieces write before what follows, for every reader.
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint32_t> finished{0};
    const auto tasks = static_cast<std::uint32_t>(std::min<std::uint64_t>(count_, pieces));
    arena_->tasks.execute([&] {
        oneapi::tbb::parallel_for(
            std::uint32_t{0}, tasks,
            [&](std::uint32_t) {
                for (std::uint64_t i = next.fetch_add(1, std::memory_order_acq_rel); i < pieces;
                     i = next.fetch_add(1, std::memory_order_acq_rel)) {
                    piece(i);
                }
                finished.fetch_add(1, std::memory_order_acq_rel);
            },
            oneapi::tbb::simple_partitioner());
    });
    static_cast<void>(finished.load(std::memory_order_acquire));
}

} // namespace lsys
