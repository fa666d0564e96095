// What the scanner of .lsys files remembers between tokens: where in which statement it stands. The
// same character is an operator in one part of a statement and a module in another, so the scanner
// follows the parts by its own tokens; the parser never switches it. It also keeps three promises
// that make the parser's recovery safe: parentheses inside a statement are balanced, a condition is
// followed by `:`, and a statement ends with `;`. Where the author forgot one, the scanner reports
// it and supplies it (token insertion). Nothing here depends on the parser, or on whether anything
// is reported: scans of one text make the same tokens, with a parser or without.
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
    Module,
    Object,
    Include,
    Set,
    Ignore,
    Consider,
    Decompose,
    Interpret,
    Axiom,
};

enum class Part : std::uint8_t {
    Between,     // statements
    Opening,     // after `#word`, up to the `:` or `=` or the name
    Value,       // the expression of #n, #define, #param
    Declaration, // the modules of #module
    ObjectName,
    ObjectValue,
    Setting,
    Ignored,
    Axiom,
    Head,
    Condition,
    Successor,
};

/// Why the scanner inserts tokens before it goes on.
enum class Insertion : std::uint8_t {
    None,
    Colon,         // a `:` was read inside parentheses
    Semicolon,     // a `;` was read
    NextStatement, // a `#name` was read, a `;` is missing
    EndOfFile,
};

struct OpenBracket {
    enum class Kind : std::uint8_t { Module, Call, Group, Brace };
    Kind kind = Kind::Group;
    std::uint32_t begin = 0; // of the scanned text
    std::uint32_t chain = 0; // of the level around it
};

struct ScanState {
    // The match at hand, as offsets of the scanned text.
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t last_end = 0; // of the last token

    Keyword keyword = Keyword::Label;
    Part part = Part::Between;
    Part ended_part = Part::Between; // the last part of the statement that a `;` has ended
    bool statement_open = false;     // `#word` was read, its `;` was not
    bool part_empty = true;          // no token of the part was read
    bool skipping = false;           // everything up to `;` is dropped
    bool semicolon_supplied = false;
    bool value_before = false; // the last token ends a value
    bool name_before = false;  // the last token is a name in an expression
    std::uint32_t statement_begin = 0;
    std::optional<std::uint32_t> colons; // of the statement, once counted
    std::size_t first_diagnostic = 0;    // of the statement, as a number of the sink's
    std::uint32_t part_begin = 0;
    std::uint32_t comment_begin = 0;
    std::uint32_t next_statement = 0; // where a supplied `;` was found missing
    int comment_return = 0;           // start condition

    // Inside expressions. Operators that wait for what is to their right (unary, `^`) nest as deep
    // as parentheses do.
    std::vector<OpenBracket> open;
    std::uint32_t open_braces = 0;
    std::uint32_t chain = 0;
    std::uint32_t depth = 0; // open brackets and chains of all levels

    Insertion inserting = Insertion::None;
    SourceSpan pending_span;       // of the written `:` or `;` that follows the inserted tokens
    std::uint32_t control_end = 0; // end of the last control character
    std::uint32_t bracket_searches = 0; // of the text, see bracket_search.h

    void enter(Part next) {
        part = next;
        part_empty = true;
        part_begin = end;
        end_chain();
        value_before = false;
        name_before = false;
    }
    void end_chain() {
        depth -= chain;
        chain = 0;
    }
    /// A token that ends no value: an operator, a comma.
    void after_operator() {
        end_chain();
        value_before = false;
        name_before = false;
    }
    void push(OpenBracket::Kind kind) {
        open.push_back({kind, begin, chain});
        open_braces += kind == OpenBracket::Kind::Brace ? 1u : 0u;
        chain = 0;
        ++depth;
        value_before = false;
        name_before = false;
    }
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
