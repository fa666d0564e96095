// SPDX-License-Identifier: MIT
// Deadline: stops a run after a time, by the flag that the pipeline checks for cancellation.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

namespace lsys {

class Deadline {
public:
    /// Sets stop() to true after `seconds`, or when `cancelled`, which may be null, becomes true.
    /// Calls `end_late`, on another thread, if the Deadline still exists a second after the time
    /// has passed; `end_late` may be empty.
    Deadline(double seconds, const std::atomic<bool>* cancelled, std::function<void()> end_late);
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
    ~Deadline();

    /// The flag that tells the run to stop; valid as long as the Deadline.
    [[nodiscard]] const std::atomic<bool>* stop() const;
    /// Whether the time has passed before `cancelled` became true.
    [[nodiscard]] bool has_passed() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace lsys
