// The tokens of a correct .lsys text as the formatter wants them: with comments, and with what
// stood before.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

enum class LexemeKind : std::uint8_t {
    LineComment,  // between statements
    BlockComment, // anywhere
    Keyword,      // `#name`
    Module,       // a name or symbol of a module list
    Open,         // the `(` after a module
    Close,        // its `)`
    Context,      // `<` or `>` of a production's head
    Colon,
    Semicolon,
    Word,     // a name where an expression or value stands
    Number,   //
    Quoted,   // "file"
    Operator, // of an expression, `*` and `~` of a condition included
    Unary,    // `-` or `!` before its operand
    Left,     // `(` or `{` of an expression
    Right,    // `)` or `}`
    Comma,
};

struct Lexeme {
    LexemeKind kind{};
    std::string_view text;
    std::uint32_t newlines_before = 0;
    bool blank_before = false;
    bool call = false; // Left: follows the name of a function
};

[[nodiscard]] std::vector<Lexeme> lexemes_of(std::string_view text);

} // namespace lsys
