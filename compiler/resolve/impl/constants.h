// The constants of #define and #param by name: which are known where, and what they are. A constant
// must precede its use, so the table is filled while the statements are walked; where a name is
// defined later is known from the beginning, for the message.
#pragma once

#include "compiler/resolve/impl/resolution.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

enum class ConstantState : std::uint8_t {
    Unknown, // no statement defines it
    Later,   // a later statement does
    Known,   // constant() is it
    Failed,  // its definition is in error: keep quiet
};

class ConstantTable {
public:
    explicit ConstantTable(Resolution& resolution);

    [[nodiscard]] ConstantState state(NameId name) const;
    /// Where the name is first defined; precondition: not Unknown.
    [[nodiscard]] SourceSpan definition_span(NameId name) const;
    /// Precondition: Known.
    [[nodiscard]] Constant& constant(NameId name);

    /// Makes the name known; it is in Program::constants from now on.
    void define(const Constant& constant);
    /// The definition of the name is in error.
    void fail(NameId name);

    /// Texts of the constants known so far, for suggestions.
    [[nodiscard]] std::vector<std::string_view> known_names() const;

private:
    struct Entry {
        SourceSpan span;
        ConstantState state = ConstantState::Later;
        std::uint32_t constant = kNone; // in Program::constants
    };
    void declare(NameId name, SourceSpan span);

    Resolution& resolution_;
    std::vector<std::uint32_t> entry_of_; // by name: in entries_, or kNone
    std::vector<Entry> entries_;
};

} // namespace lsys
