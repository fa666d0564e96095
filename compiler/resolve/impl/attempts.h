// SPDX-License-Identifier: MIT
// The statements and names that a text with syntax errors seems to have, found by a simple search
// of the text, so that a wrong `#define a 2 2;` does not make every use of `a` an error. Empty
// unless Ast::incomplete.
#pragma once

#include "compiler/resolve/impl/resolution.h"

#include <string>
#include <string_view>
#include <unordered_set>

namespace lsys {

class AttemptedStatements {
public:
    explicit AttemptedStatements(const Resolution& resolution);

    /// Whether the text has `#keyword`, or a line with the same meaning in another notation
    /// (`axiom: F`, `n = 5`). Precondition: `keyword` is "w" or "n".
    [[nodiscard]] bool has(std::string_view keyword) const;
    /// Whether `#define NAME`, `#param NAME`, `#function NAME`, `#curve NAME`, `#sense NAME` or
    /// `#contour NAME` occurs anywhere in the text.
    [[nodiscard]] bool defines(std::string_view name) const;

private:
    /// Records the keywords and the defined names of statements.
    void read_statements(std::string_view text);
    /// Records lines in other notations that give the axiom or the generations.
    void read_other_notations(std::string_view text);

    std::unordered_set<std::string> keywords_; // found in the text
    std::unordered_set<std::string> defined_names_;
};

} // namespace lsys
