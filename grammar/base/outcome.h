// SPDX-License-Identifier: MIT
// Outcome<T>: a value or the reason for its absence, with messages. Returned by every step of the
// pipeline: mistakes of the author, the environment, a limit or the user may end a step. Result<T>
// is for a single failure of the environment without diagnostics.
#pragma once

#include "grammar/base/contract.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

/// The reason why a step has no value.
enum class Stop : std::uint8_t {
    Diagnosed,   // mistakes of the author; see the diagnostics
    Failed,      // the environment: a missing file, an unsuitable option
    Limit,       // a limit of Limits; see the diagnostics
    OutOfMemory, // a failed allocation
    Cancelled,   // ended by Host::cancelled
};

/// One message of a step, rendered by programs as text, as JSON or in a window.
struct Message {
    enum class Kind : std::uint8_t {
        Diagnostics, // diagnostics whose places are in `sources`
        Error,       // failure of the environment
        Help,        // advice on the error message before this one
        Info,        // about the result
        Detail,      // about the work, for verbose output
    };
    Kind kind = Kind::Diagnostics;
    std::string text; // empty for Diagnostics
    Diagnostics diagnostics;
    std::shared_ptr<const SourceMap> sources; // files of Diagnostics; null if none has a place
};

/// Messages of a step in order.
class Messages {
public:
    void add_error(std::string text) { add(Message::Kind::Error, std::move(text)); }
    void add_help(std::string text) { add(Message::Kind::Help, std::move(text)); }
    void add_info(std::string text) { add(Message::Kind::Info, std::move(text)); }
    void add_detail(std::string text) { add(Message::Kind::Detail, std::move(text)); }
    /// Adds diagnostics, sorted by place; nothing if there are none.
    void add(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources);
    void append(Messages other);

    [[nodiscard]] const std::vector<Message>& all() const { return all_; }
    /// Whether a message or a diagnostic is an error.
    [[nodiscard]] bool has_errors() const;

private:
    void add(Message::Kind kind, std::string text);

    std::vector<Message> all_;
};

template <typename T>
class [[nodiscard]] Outcome {
public:
    Outcome(T value, Messages messages)
        : value_(std::move(value)), messages_(std::move(messages)) {}
    Outcome(Stop stop, Messages messages) : stop_(stop), messages_(std::move(messages)) {}

    [[nodiscard]] bool ok() const { return value_.has_value(); }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] T& value() {
        LSYS_CHECK(ok());
        return *value_;
    }
    [[nodiscard]] const T& value() const {
        LSYS_CHECK(ok());
        return *value_;
    }
    [[nodiscard]] Stop stop() const {
        LSYS_CHECK(!ok());
        return stop_;
    }
    [[nodiscard]] const Messages& messages() const { return messages_; }
    [[nodiscard]] Messages& messages() { return messages_; }

private:
    std::optional<T> value_;
    Stop stop_ = Stop::Failed;
    Messages messages_;
};

/// The outcome of a step that computes no value.
template <>
class [[nodiscard]] Outcome<void> {
public:
    Outcome() = default;
    Outcome(Messages messages) : messages_(std::move(messages)) {}
    Outcome(Stop stop, Messages messages) : stop_(stop), messages_(std::move(messages)) {}

    [[nodiscard]] bool ok() const { return !stop_; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] Stop stop() const {
        LSYS_CHECK(!ok());
        return *stop_;
    }
    [[nodiscard]] const Messages& messages() const { return messages_; }
    [[nodiscard]] Messages& messages() { return messages_; }

private:
    std::optional<Stop> stop_;
    Messages messages_;
};

} // namespace lsys
