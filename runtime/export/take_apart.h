// SPDX-License-Identifier: MIT
// take_apart(): empties a document of nlohmann-json so that its destructor allocates nothing. The
// destructors of version 3.11 move the items of nested values to a list on the heap; without memory
// for the list, the exception leaves a destructor and ends the process (std::terminate).
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace lsys {

/// Removes all items, the innermost first. The value stays an array or object, or keeps its text or
/// number. Recursive: only for documents that this program writes.
void take_apart(nlohmann::ordered_json& value) noexcept;

/// Takes a value apart at the end of a scope. Declare it after the value.
class TakesApart {
public:
    explicit TakesApart(nlohmann::ordered_json& value) : value_(value) {}
    ~TakesApart() { take_apart(value_); }
    TakesApart(const TakesApart&) = delete;
    TakesApart& operator=(const TakesApart&) = delete;

private:
    nlohmann::ordered_json& value_;
};

} // namespace lsys
