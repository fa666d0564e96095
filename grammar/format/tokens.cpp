// SPDX-License-Identifier: MIT
#include "grammar/format/tokens.h"

#include "grammar/format/impl/lexemes.h"

namespace lsys {

namespace {

std::string_view name_of(LexemeKind kind) {
    switch (kind) {
    case LexemeKind::LineComment:
    case LexemeKind::BlockComment:
        return "comment";
    case LexemeKind::Keyword:
        return "keyword";
    case LexemeKind::Module:
        return "module";
    case LexemeKind::Open:
        return "open";
    case LexemeKind::Close:
        return "close";
    case LexemeKind::Context:
        return "context";
    case LexemeKind::Colon:
        return "colon";
    case LexemeKind::Semicolon:
        return "semicolon";
    case LexemeKind::Word:
        return "word";
    case LexemeKind::Number:
        return "number";
    case LexemeKind::Quoted:
        return "quoted";
    case LexemeKind::Operator:
    case LexemeKind::Any:
        return "operator";
    case LexemeKind::Unary:
        return "unary";
    case LexemeKind::Left:
        return "left";
    case LexemeKind::Right:
        return "right";
    case LexemeKind::Comma:
        return "comma";
    }
    return "";
}

} // namespace

std::string dump_tokens(const SourceFile& file) {
    std::string out;
    for (const Lexeme& lexeme : lexemes_of(file.text())) {
        const auto offset = static_cast<std::uint32_t>(lexeme.text.data() - file.text().data());
        const LineColumn place = file.line_column(offset);
        out += std::to_string(place.line) + ":" + std::to_string(place.column) + " ";
        out += name_of(lexeme.kind);
        out += ' ';
        out += lexeme.text;
        out += '\n';
    }
    return out;
}

} // namespace lsys
