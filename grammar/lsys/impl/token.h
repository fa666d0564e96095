// SPDX-License-Identifier: MIT
// A token, made by the scanner and read by the parser.
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

    /// The token, marked as inserted.
    [[nodiscard]] Token as_inserted() const {
        Token token = *this;
        token.inserted = true;
        return token;
    }
    /// The parser's symbol for the token. Tokens and symbols have equal numbers (api.token.raw).
    [[nodiscard]] Parser::symbol_kind_type kind() const {
        return static_cast<Parser::symbol_kind_type>(type);
    }

    Kind type;
    TokenValue value;
    SourceSpan location;
    bool inserted = false; // inserted and reported by the scanner
};

} // namespace lsys::lsys_grammar
