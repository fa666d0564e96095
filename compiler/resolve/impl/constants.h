// SPDX-License-Identifier: MIT
// The constants of #define and #param by name. A constant must be defined before its use, so the
// table is filled while the statements are resolved in their order. The places of later definitions
// are known from the beginning, for messages.
#pragma once

#include "compiler/resolve/impl/resolution.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

enum class ConstantState : std::uint8_t {
    Unknown, // no statement defines it
    Later,   // a later statement defines it
    Known,   // constant() returns it
    Failed,  // an error in its definition has been reported
};

class ConstantTable {
public:
    explicit ConstantTable(Resolution& resolution);

    /// The state at the statement given to visible_until(): Later for a constant defined at that
    /// statement or after it.
    [[nodiscard]] ConstantState state(NameId name) const;
    /// Makes state() ignore definitions at and after this statement (index in Ast::statements).
    void visible_until(std::size_t statement) { visible_until_ = statement; }
    /// The place of the first definition of the name. Precondition: not Unknown.
    [[nodiscard]] SourceSpan definition_span(NameId name) const;
    /// Precondition: state(name) is Known.
    [[nodiscard]] Constant& constant(NameId name);

    /// Makes the name known and adds it to Program::constants.
    void define(const Constant& constant);
    /// Marks the definition of the name as failed.
    void fail(NameId name);

    /// Texts of the constants known so far, for suggestions.
    [[nodiscard]] std::vector<std::string_view> known_names() const;

private:
    struct Entry {
        SourceSpan span;
        ConstantState state = ConstantState::Later;
        std::uint32_t constant = kNone; // index in Program::constants
        std::size_t statement = 0;      // index of the definition in Ast::statements
    };
    /// Records the first definition of a name, in state Later.
    void declare(NameId name, SourceSpan span, std::size_t statement);

    Resolution& resolution_;
    std::vector<std::uint32_t> entry_of_; // by name: index in entries_, or kNone
    std::vector<Entry> entries_;
    std::size_t visible_until_ = std::numeric_limits<std::size_t>::max();
};

} // namespace lsys
