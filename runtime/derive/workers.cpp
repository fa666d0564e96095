#include "runtime/derive/workers.h"

#include <algorithm>
#include <system_error>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxThreads = 1024;
// How often a helper looks for the next task before it sleeps: some tens of microseconds, as long
// as the serial work between two passes over a word.
constexpr int kLooks = 2000;

void pause_a_moment() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

} // namespace

Workers::Workers(std::uint32_t threads)
    : count_(threads != 0 ? std::min(threads, kMaxThreads)
                          : std::max(1U, std::thread::hardware_concurrency())) {}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
        ++tickets_;
    }
    begun_.notify_all();
    for (std::thread& helper : helpers_) {
        helper.join();
    }
}

void Workers::start() {
    if (!helpers_.empty()) {
        return;
    }
    helpers_.reserve(count_ - 1);
    while (helpers_.size() + 1 < count_) {
        try {
            helpers_.emplace_back([this] { help(); });
        } catch (const std::system_error&) {
            count_ = static_cast<std::uint32_t>(helpers_.size()) + 1;
        }
    }
}

/// Returns whether there is a task after the last one seen; else the team ends.
bool Workers::wait_for_task(std::uint64_t last) {
    for (int i = 0; i < kLooks && tickets_.load(std::memory_order_relaxed) == last; ++i) {
        pause_a_moment();
    }
    std::unique_lock lock(mutex_);
    begun_.wait(lock, [&] { return stops_ || tickets_ != last; });
    return !stops_;
}

void Workers::help() {
    std::uint64_t last = 0;
    while (wait_for_task(last)) {
        const Task* task = nullptr;
        {
            const std::lock_guard lock(mutex_);
            last = tickets_;
            task = task_;
            busy_ += task != nullptr ? 1 : 0;
        }
        if (task == nullptr) {
            continue; // woken too late
        }
        (*task)();
        const std::lock_guard lock(mutex_);
        if (--busy_ == 0) {
            left_.notify_one();
        }
    }
}

void Workers::for_each(std::uint64_t pieces, const std::function<void(std::uint64_t)>& piece) {
    if (count_ == 1 || pieces <= 1) {
        for (std::uint64_t i = 0; i < pieces; ++i) {
            piece(i);
        }
        return;
    }
    start();
    // Each thread takes the next piece until none is left, so that neighbours are done at about the
    // same time.
    std::atomic<std::uint64_t> next{0};
    const Task task = [&] {
        for (std::uint64_t i = next.fetch_add(1); i < pieces; i = next.fetch_add(1)) {
            piece(i);
        }
    };
    {
        const std::lock_guard lock(mutex_);
        task_ = &task;
        ++tickets_;
    }
    begun_.notify_all();
    task();
    std::unique_lock lock(mutex_);
    task_ = nullptr;
    left_.wait(lock, [&] { return busy_ == 0; });
}

} // namespace lsys
