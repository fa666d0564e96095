// SPDX-License-Identifier: MIT
#include "grammar/base/cancellation.h"

#include <utility>

namespace lsys {

namespace {

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
