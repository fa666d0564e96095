// Outcome<T>: a value, or why there is none; in both cases the messages on the way. Every step of
// the pipeline returns one: an author's mistakes, the environment, a limit or the user may end it.
// Result<T> is for a single failure of the environment without diagnostics.
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

/// Why a step ended without its value.
enum class Stop : std::uint8_t {
    Diagnosed,   // mistakes of the author, in the diagnostics
    Failed,      // the environment: a missing file, an option that does not fit
    Limit,       // a limit of Limits, in the diagnostics
    OutOfMemory, // the system gave no more memory
    Cancelled,   // by the host
};

/// One message of a step. Programs render it: as text, as JSON, in a window.
struct Message {
    enum class Kind : std::uint8_t {
        Diagnostics, // with places in `sources`
        Error,       // of the environment
        Help,        // belongs to the error before it
        Info,        // about the result
        Detail,      // about the work, for users who asked for more
    };
    Kind kind = Kind::Diagnostics;
    std::string text; // of all kinds but Diagnostics
    Diagnostics diagnostics;
    std::shared_ptr<const SourceMap> sources; // of Diagnostics; null: no diagnostic has a place
};

/// Messages of a step in the order in which they arose.
class Messages {
public:
    void add_error(std::string text) { add(Message::Kind::Error, std::move(text)); }
    void add_help(std::string text) { add(Message::Kind::Help, std::move(text)); }
    void add_info(std::string text) { add(Message::Kind::Info, std::move(text)); }
    void add_detail(std::string text) { add(Message::Kind::Detail, std::move(text)); }
    /// Adds diagnostics sorted by place, unless there are none.
    void add(Diagnostics diagnostics, std::shared_ptr<const SourceMap> sources);
    void append(Messages other);

    [[nodiscard]] const std::vector<Message>& all() const { return all_; }
    /// Whether any diagnostic is an error, or any message is one.
    [[nodiscard]] bool has_errors() const;

private:
    void add(Message::Kind kind, std::string text);

    std::vector<Message> all_;
};

/// The value of a step that only acts: Outcome<Done>.
struct Done {};

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

} // namespace lsys
