// SPDX-License-Identifier: MIT
#include "grammar/dialects/fractint/reader.h"

#include "grammar/dialects/impl/line_reader.h"
#include "grammar/dialects/impl/text.h"

namespace lsys {

namespace {

/// `;` begins a comment everywhere.
constexpr LineFormat kFormat{" \t\r\x1A", ';', true};

/// Length of the next piece of text between entries: a word, a brace, or a remark after a `(`.
std::size_t word_length(std::string_view ahead) {
    const std::string_view stops(" \t\r\x1A(\n;{\0", 9);
    return length_up_to(ahead, ahead[0] == '(' ? stops.substr(5) : stops);
}

/// Length of the text up to the end of the line or of the entry.
std::size_t body_length(std::string_view ahead) {
    return length_up_to(ahead, "};\n");
}

/// Length of a key or of a piece of its text.
std::size_t text_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view(" \t\r\x1A\n;=\0", 8));
}

} // namespace

std::vector<FractintEntry> read_fractint_entries(FileId root, const ParseContext& context) {
    LineReader reader(whole_file(root, context), kFormat, context);
    std::vector<FractintEntry> entries;
    SourceSpan name{root, 0, 0};
    // Words on this line; a line of one word may name the entry that begins on the next line.
    std::size_t word_count = 0;
    LinePiece piece;
    while ((piece = reader.next(word_length)).kind != LinePieceKind::TextEnd) {
        if (piece.kind == LinePieceKind::LineEnd) {
            name.begin = word_count > 1 ? name.end : name.begin;
            word_count = 0;
        } else if (piece.text == "{") {
            LinePiece close;
            do {
                close = reader.next(body_length);
            } while (close.text != "}" && close.span.begin != close.span.end);
            if (!reader.expect(close.text == "}", close, {"`}`"})) {
                return entries;
            }
            entries.push_back({name, {root, piece.span.end, close.span.begin}});
            name.begin = name.end;
            word_count = 0;
        } else if (piece.text[0] != '(' && piece.text != "\xEF\xBB\xBF") {
            name = word_count++ == 0 ? piece.span : name;
        }
    }
    return entries;
}

std::vector<FractintLine> read_fractint_lines(const FractintEntry& entry,
                                              const ParseContext& context) {
    LineReader reader(entry.body, kFormat, context);
    std::vector<FractintLine> lines;
    LinePiece piece;
    while ((piece = reader.next(text_length)).kind != LinePieceKind::TextEnd) {
        if (piece.kind == LinePieceKind::LineEnd) {
            continue;
        }
        const bool is_key = piece.text != "=" && piece.text[0] != '\0';
        if (!reader.expect(
                is_key, piece,
                {"the end of the file", "the end of the line", "`Axiom`", "`Angle`", "a symbol"})) {
            continue;
        }
        const std::string key = lowered(piece.text);
        FractintLine& line = lines.emplace_back();
        line.kind = key == "axiom"   ? FractintLineKind::Axiom
                    : key == "angle" ? FractintLineKind::Angle
                                     : FractintLineKind::Rule;
        line.key = piece.span;
        while ((piece = reader.next(text_length)).kind == LinePieceKind::Text) {
            line.texts.push_back(piece.span);
        }
    }
    return lines;
}

} // namespace lsys
