// SPDX-License-Identifier: MIT
#include "grammar/base/cancellation.h"

#include <utility>

namespace lsys {

namespace {

// In a library that is loaded by a running program, the first use of a variable of a thread allocates
// memory, and the GNU C library ends the process if there is none. This model needs no memory.
#if defined(__GLIBC__)
[[gnu::tls_model("initial-exec")]]
#endif
thread_local const std::atomic<bool>* cancelled = nullptr;

} // namespace

CancellationScope::CancellationScope(const std::atomic<bool>* flag)
    : earlier_(std::exchange(cancelled, flag)) {}

CancellationScope::~CancellationScope() {
    cancelled = earlier_;
}

void stop_if_cancelled() {
    if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) {
        throw CompilationCancelled();
    }
}

} // namespace lsys
