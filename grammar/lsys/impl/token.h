// A token as the scanner makes it and the parser takes it.
#pragma once

#include "lsys/parser.h"

namespace lsys::lsys_grammar {

struct Token {
    using Kind = Parser::token_kind_type;

    Token(Kind token, SourceSpan span) : type(token), location(span) {}
    Token(Kind token, NameId name, SourceSpan span) : Token(token, span) { value.name = name; }
    Token(Kind token, TextRange names, SourceSpan span) : Token(token, span) {
        value.names = names;
    }
    Token(Kind token, float number, SourceSpan span) : Token(token, span) { value.number = number; }

    /// The same, of a token that nobody wrote.
    [[nodiscard]] Token as_supplied() const {
        Token token = *this;
        token.supplied = true;
        return token;
    }
    /// The parser numbers tokens and symbols alike.
    [[nodiscard]] Parser::symbol_kind_type kind() const {
        return static_cast<Parser::symbol_kind_type>(type);
    }

    Kind type;
    TokenValue value;
    SourceSpan location;
    bool supplied = false; // by the scanner, which has reported it
};

} // namespace lsys::lsys_grammar
