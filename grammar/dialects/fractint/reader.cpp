#include "grammar/dialects/fractint/reader.h"

#include "grammar/dialects/impl/line_reader.h"

#include <algorithm>

namespace lsys {

namespace {

/// `;` begins a comment everywhere.
constexpr LineFormat kFormat{" \t\r\x1A", ';', true};

std::size_t length_up_to(std::string_view ahead, std::string_view stops) {
    return std::min(ahead.find_first_of(stops), ahead.size());
}

/// Bytes of a piece between entries: a word, a brace, or a remark that a parenthesis begins.
std::size_t word_length(std::string_view ahead) {
    const std::string_view stops(" \t\r\x1A(\n;{\0", 9);
    return length_up_to(ahead, ahead[0] == '(' ? stops.substr(5) : stops);
}

std::size_t body_length(std::string_view ahead) {
    return length_up_to(ahead, "};\n");
}

std::size_t text_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view(" \t\r\x1A\n;=\0", 8));
}

} // namespace

std::string lowered(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return out;
}

std::vector<FractintEntry> read_fractint_entries(FileId root, const ParseContext& context) {
    LineReader reader(whole_file(root, context), kFormat, context);
    std::vector<FractintEntry> entries;
    SourceSpan name{root, 0, 0};
    std::size_t words = 0; // of this line, or of the one above, which may name the next entry
    LinePiece piece;
    while ((piece = reader.next(word_length)).kind != LinePieceKind::TextEnd) {
        if (piece.kind == LinePieceKind::LineEnd) {
            name.begin = words > 1 ? name.end : name.begin;
            words = 0;
        } else if (piece.text == "{") {
            LinePiece close;
            do {
                close = reader.next(body_length);
            } while (close.text != "}" && close.span.begin != close.span.end);
            if (close.text != "}") {
                reader.reject(close, {"`}`"});
                return entries;
            }
            entries.push_back({name, {root, piece.span.end, close.span.begin}});
            name.begin = name.end;
            words = 0;
        } else if (piece.text[0] != '(' && piece.text != "\xEF\xBB\xBF") {
            name = words++ == 0 ? piece.span : name;
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
        if (piece.text == "=" || piece.text[0] == '\0') {
            reader.reject(piece, {"the end of the file", "the end of the line", "`Axiom`",
                                  "`Angle`", "a symbol"});
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
