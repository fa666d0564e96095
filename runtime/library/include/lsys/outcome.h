// SPDX-License-Identifier: MIT
// Outcome: the result of a library call: a value or the reason why there is none, and in both cases
// the messages of the call.
#pragma once

#include <cassert>
#include <cstdint>
#include <lsys/api.h>
#include <lsys/messages.h>
#include <optional>
#include <utility>

namespace lsys::LSYS_INTERFACE {

enum class Status : std::uint8_t {
    Ok,
    Diagnosed,   // mistakes of the author of a grammar or scene
    Failed,      // a file cannot be read, or an option is invalid
    Limit,       // a value of Limits is exceeded
    OutOfMemory, // a failed allocation
    Cancelled,   // by Host::cancelled or a function of the caller
};

/// The text of a status: "out of memory".
[[nodiscard]] LSYS_API const char* text_of(Status status) noexcept;

template <typename T>
class [[nodiscard]] Outcome {
public:
    Outcome(T value, Messages messages)
        : value_(std::move(value)), messages_(std::move(messages)) {}
    /// Precondition: not Status::Ok.
    Outcome(Status status, Messages messages) : status_(status), messages_(std::move(messages)) {}

    [[nodiscard]] bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] Status status() const { return status_; }
    [[nodiscard]] const Messages& messages() const { return messages_; }

    /// Precondition: ok().
    [[nodiscard]] T& operator*() {
        assert(ok());
        return *value_;
    }
    [[nodiscard]] const T& operator*() const {
        assert(ok());
        return *value_;
    }
    [[nodiscard]] T* operator->() { return &**this; }
    [[nodiscard]] const T* operator->() const { return &**this; }

private:
    std::optional<T> value_;
    Status status_ = Status::Ok;
    Messages messages_;
};

} // namespace lsys::LSYS_INTERFACE
