// SPDX-License-Identifier: MIT
// Repairs of one statement in the notation of other languages, in a DraftText.
#pragma once

#include "grammar/lsys/impl/draft_pieces.h"
#include "grammar/lsys/impl/draft_text.h"
#include "grammar/lsys/impl/lookahead.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::lsys_grammar {

/// Searches one statement for forms of other languages and repairs them.
class StatementRepair {
public:
    StatementRepair(DraftText& draft, StatementText statement);

    /// Repairs the statement; returns the offset from which the search continues.
    std::size_t repair();

private:
    /// The text that is searched: comments and names in back quotes are masked.
    [[nodiscard]] std::string_view text() const { return draft_.masked; }
    [[nodiscard]] char char_at(std::size_t at) const {
        return at < draft_.masked.size() ? draft_.masked[at] : '\0';
    }
    /// The offset of `what` in the statement from `from` on; npos if there is none.
    template <typename Text>
    [[nodiscard]] std::size_t find(Text what, std::size_t from) const {
        return text().substr(0, statement_.end).find(what, from);
    }
    Diagnostic& report(Piece piece, std::string message) {
        return draft_.report(DiagnosticCode::ForeignForm, draft_.span(piece.begin, piece.end),
                             std::move(message));
    }
    /// The offset after the statement and its `;`.
    [[nodiscard]] std::size_t after() const {
        return statement_.end + (statement_.end < text().size() && char_at(statement_.end) == ';');
    }

    // --- functions

    /// Repairs `#function f(x) { return x; }` and `#function f(x): return x;`.
    std::size_t repair_function();

    /// Whether the braces at `at` enclose one expression and are not a random range.
    [[nodiscard]] bool is_braced_expression(std::size_t at) const;

    /// Repairs `A(float x)` and `A(x, w = 1)`: parameters with a type or a default value.
    void formals(std::size_t open, std::size_t close);

    /// The first call, `A(1)`, of the module whose parenthesis is at `open`, with `value` added:
    /// `A(1, 0.1)`. Empty if that call does not have `count` parameters.
    [[nodiscard]] std::string
    first_use(std::size_t open, const std::string& value, std::size_t count) const;

    // --- curves

    /// Repairs points in parentheses, `(0, 1), (1, 2)`, and coordinates with commas, `0,1 1,2`.
    void repair_curve();

    // --- settings

    /// Repairs `#set tropism (0, -1, 0) 0.2;`.
    void repair_setting();

    // --- objects and files

    /// Repairs `#object L LEAF scale 0.4;`.
    void repair_object();

    /// Repairs `#include <file.lsys>;`.
    void repair_include();

    // --- constants

    /// Repairs `#define ANGLES [20, 35, 50];`, and `ANGLES[k]` in the rest of the text.
    void constant();

    // --- productions

    /// Repairs the parts of a production; returns the offset from which the search continues.
    std::size_t production();

    /// Repairs the local values after `let`.
    void local_values();

    /// Repairs `let a, b = x, y`.
    void unpacked(std::size_t let, std::size_t end);

    /// Repairs `A(x) : x > 1 --> B`, and Houdini's `A(x) : x > 1 = B`.
    void arrow(std::size_t colon);

    /// Repairs `(a, 4)`, modules of papers on timed systems.
    void timed_modules();

    /// Repairs a successor `if (c) { A } else { B }`.
    void conditional_successor(std::size_t colon, const std::vector<Piece>& parts);

    // --- expressions

    /// Repairs `c ? a : b`.
    void choices();

    /// The text `if(c, a, b)` for `c ? a : b`; empty for other texts.
    [[nodiscard]] std::string choice_text(Piece piece) const;

    /// Blanks the statement, whose repair does not fit into its place.
    void leave_out();

    DraftText& draft_;
    StatementText statement_;
    std::string_view word_; // word after the `#`
    std::size_t body_ = 0;  // offset after `#word`
    Keyword keyword_ = Keyword::Label;
};

} // namespace lsys::lsys_grammar
