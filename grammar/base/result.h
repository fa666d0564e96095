// SPDX-License-Identifier: MIT
// Result<T>: a value or a failure of the environment (a missing file, a full disk, a damaged module
// file, a file larger than the memory limit). Mistakes of authors are Diagnostics.
#pragma once

#include "grammar/base/contract.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace lsys {

enum class ErrorKind : std::uint8_t {
    Environment,
    Limit, // a memory limit
};

/// A failure in words for the user: lower case, no final stop, with the name of the file if there
/// is one.
struct Error {
    std::string message;
    ErrorKind kind = ErrorKind::Environment;
};

template <typename T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    [[nodiscard]] bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] T& value() {
        LSYS_CHECK(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const T& value() const {
        LSYS_CHECK(ok());
        return *std::get_if<0>(&state_);
    }
    [[nodiscard]] const Error& error() const {
        LSYS_CHECK(!ok());
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

/// The result of an action that computes no value.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !error_; }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] const Error& error() const {
        LSYS_CHECK(!ok());
        return *error_;
    }

private:
    std::optional<Error> error_;
};

} // namespace lsys
