// SPDX-License-Identifier: MIT
// OutputBudget: the bytes that a run may still write, in all files and standard output together.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace lsys {

class OutputBudget {
public:
    explicit OutputBudget(std::uint64_t max_bytes) : max_bytes_(max_bytes), left_(max_bytes) {}

    /// Takes `bytes` from the budget; returns false, and never true again, if they exceed it.
    /// Thread-safe.
    [[nodiscard]] bool take(std::size_t bytes) {
        std::uint64_t left = left_;
        while (left >= bytes && !is_exceeded_) {
            if (left_.compare_exchange_weak(left, left - bytes)) {
                return true;
            }
        }
        is_exceeded_ = true;
        return false;
    }
    [[nodiscard]] bool is_exceeded() const { return is_exceeded_; }
    [[nodiscard]] std::uint64_t max_bytes() const { return max_bytes_; }

private:
    std::uint64_t max_bytes_;
    std::atomic<std::uint64_t> left_;
    std::atomic<bool> is_exceeded_{false};
};

} // namespace lsys
