// SPDX-License-Identifier: MIT
// Cancellation of parsing, checking and compiling. Long loops of these steps call
// stop_if_cancelled(). Many functions with such loops get only a text or an expression, so the flag
// is a variable of the thread, not a parameter.
#pragma once

#include <atomic>

namespace lsys {

/// Thrown by stop_if_cancelled(), and caught by the function that made the CancellationScope.
/// Like std::bad_alloc it may leave any function of the compiler.
struct CompilationCancelled {};

/// Sets the flag that stop_if_cancelled() of this thread reads; null: none. The destructor restores
/// the earlier flag.
class CancellationScope {
public:
    explicit CancellationScope(const std::atomic<bool>* flag);
    CancellationScope(const CancellationScope&) = delete;
    CancellationScope& operator=(const CancellationScope&) = delete;
    ~CancellationScope();

private:
    const std::atomic<bool>* earlier_;
};

/// Throws CompilationCancelled if the flag of this thread is set. Takes about 1 ns; call it at
/// least once per 10 ms of work.
void stop_if_cancelled();

} // namespace lsys
