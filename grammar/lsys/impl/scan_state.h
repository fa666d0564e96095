// SPDX-License-Identifier: MIT
// The state of the .lsys scanner between tokens: its place in the statement. A character is an
// operator in one part of a statement and a module in another, so the scanner tracks the parts from
// its own tokens; the parser never switches it. For safe recovery the scanner guarantees three
// things to the parser: parentheses in a statement are balanced, a `:` follows a condition, and a
// `;` ends a statement. It reports missing tokens and inserts them (token insertion). Nothing
// depends on the parser or on reports: every scan of a text yields the same tokens.
#pragma once

#include "grammar/ast/ast_builder.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

enum class Keyword : std::uint8_t {
    Label, // any other word: a production
    Generations,
    Define,
    Param,
    Function,
    Curve,
    Contour,
    Material,
    Sense,
    Module,
    Object,
    Include,
    Set,
    Ignore,
    Consider,
    Decompose,
    Interpret,
    Down,
    Up,
    Axiom,
};

enum class Part : std::uint8_t {
    Between,      // between statements
    Opening,      // after `#word`, up to the `:` or `=` or the name
    FunctionHead, // the formals of #function
    Value,        // the expression of #n, #define, #param, #function
    Declaration,  // the modules of #module
    ObjectName,   // the module of #object, or the first word of #include
    ObjectValue,  // the object or file that follows
    Setting,      // the values of #set, #curve, #contour, #material, #sense
    Ignored,      // the modules of #ignore and #consider
    Probability,  // the probability of an axiom
    Axiom,        // the modules of an axiom
    Head,         // contexts and predecessor
    Condition,    // condition and probability of a production
    Locals,       // `let` and local values
    Successor,
};

/// The next token among local values, `let a = 1, b = 2`.
enum class NextInLocals : std::uint8_t {
    Let,
    Name,
    Sign,  // the `=`
    Value, // the expression, or the `,` after it
};

/// The event before which the scanner inserts missing tokens.
enum class Insertion : std::uint8_t {
    None,
    Colon,         // a `:` inside parentheses
    Semicolon,     // a `;`
    NextStatement, // a `#name` without `;` before it
    EndOfFile,
};

struct OpenBracket {
    enum class Kind : std::uint8_t { Module, Call, Group, Brace };
    Kind kind = Kind::Group;
    std::uint32_t begin = 0; // offset in the scanned text
    std::uint32_t chain = 0; // ScanState::chain of the enclosing level
};

struct ScanState {
    // The current match, as offsets of the scanned text.
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t last_end = 0; // end of the last token

    Keyword keyword = Keyword::Label;
    Part part = Part::Between;
    Part ended_part = Part::Between; // last part of the last complete statement
    bool statement_open = false;     // between `#word` and `;`
    bool part_empty = true;          // the part has no token yet
    bool has_locals = false;         // the statement has Part::Locals
    bool skipping = false;           // the scanner skips the text up to the `;` of the statement
    bool sign_explained = false;     // another message explains the `=` after the key
    bool semicolon_inserted = false;
    bool value_before = false;                         // the last token ends a value
    bool name_before = false;                          // the last token is a name, not of a module
    NextInLocals next_in_locals = NextInLocals::Value; // next item of Part::Locals
    std::uint32_t statement_begin = 0;
    std::optional<std::uint32_t> colons; // count of `:` in the statement; empty until counted
    std::size_t first_diagnostic = 0;    // index of the statement's first diagnostic
    std::uint32_t part_begin = 0;        // end of the token before the part
    std::uint32_t comment_begin = 0;
    std::uint32_t next_statement = 0; // first character after a missing `;`
    int comment_return = 0;           // start condition after the comment

    // Open brackets of the current expression. Right-associative operators (unary ones and `^`)
    // count as nesting too.
    std::vector<OpenBracket> open;
    std::uint32_t open_braces = 0; // number of `{` in `open`
    std::uint32_t chain = 0; // operators `-`, `!` and `^` that wait for operands at this level
    std::uint32_t depth = 0; // open brackets and chains of all levels

    Insertion inserting = Insertion::None;
    SourceSpan pending_span;       // the written `:` or `;` after the inserted tokens
    std::uint32_t control_end = 0; // end of the last control character
    // Count of bracket searches in this text, at most kMaxBracketSearches (bracket_search.h).
    std::uint32_t bracket_searches = 0;

    /// Begins a part of the statement.
    void enter(Part next) {
        part = next;
        part_empty = true;
        part_begin = end;
        end_chain();
        value_before = false;
        name_before = false;
        has_locals = has_locals || next == Part::Locals;
        next_in_locals = next == Part::Locals ? NextInLocals::Let : NextInLocals::Value;
    }
    /// Ends the operators that wait for operands at this level.
    void end_chain() {
        depth -= chain;
        chain = 0;
    }
    /// Notes an operator or a comma, which does not end a value.
    void after_operator() {
        end_chain();
        value_before = false;
        name_before = false;
    }
    /// Opens a bracket.
    void push(OpenBracket::Kind kind) {
        open.push_back({kind, begin, chain});
        open_braces += kind == OpenBracket::Kind::Brace ? 1u : 0u;
        chain = 0;
        ++depth;
        value_before = false;
        name_before = false;
    }
    /// Closes the innermost bracket; returns its kind.
    OpenBracket::Kind pop() {
        end_chain();
        const OpenBracket top = open.back();
        open.pop_back();
        open_braces -= top.kind == OpenBracket::Kind::Brace ? 1u : 0u;
        chain = top.chain;
        --depth;
        value_before = true;
        name_before = false;
        return top.kind;
    }
};

} // namespace lsys
