// SPDX-License-Identifier: MIT
#include "grammar/dialects/impl/line_reader.h"

#include "grammar/base/cancellation.h"
#include "grammar/dialects/impl/syntax_message.h"

#include <algorithm>
#include <utility>

namespace lsys {

LineReader::LineReader(SourceSpan text, const LineFormat& format, const ParseContext& context)
    : span_(text), text_(context.sources.text(text)), format_(format), context_(context),
      ended_(format.blanks.find('\n') != std::string_view::npos) {}

LinePiece LineReader::piece(LinePieceKind kind, std::size_t length) {
    const auto begin = static_cast<std::uint32_t>(span_.begin + at_);
    const LinePiece next_piece{kind,
                               {span_.file, begin, begin + static_cast<std::uint32_t>(length)},
                               text_.substr(at_, length)};
    at_ += length;
    return next_piece;
}

std::string_view LineReader::ahead() {
    constexpr std::string_view kLineOrNul("\n\0", 2);
    const std::string_view comment_ends = kLineOrNul.substr(0, format_.comment_nul ? 1 : 2);
    while (true) {
        at_ = std::min(text_.find_first_not_of(format_.blanks, at_), text_.size());
        if (format_.comment == '\0' || at_ == text_.size() || text_[at_] != format_.comment) {
            return rest();
        }
        at_ = std::min(text_.find_first_of(comment_ends, at_), text_.size());
    }
}

LinePiece LineReader::next(PieceLength length) {
    stop_if_cancelled();
    const std::string_view text = ahead();
    if (text.empty()) {
        return piece(std::exchange(ended_, true) ? LinePieceKind::TextEnd : LinePieceKind::LineEnd,
                     0);
    }
    if (text[0] != '\n') {
        return take(std::max<std::size_t>(length(text), 1));
    }
    std::size_t end = 0;
    for (std::size_t at = 0; at < text.size() && text[at] == '\n';
         at = text.find_first_not_of(format_.blanks, end)) {
        end = at + 1;
    }
    return piece(LinePieceKind::LineEnd, end);
}

LinePiece LineReader::take(std::size_t length) {
    return piece(LinePieceKind::Text, length);
}

bool LineReader::expect(bool fits,
                        const LinePiece& found,
                        std::initializer_list<std::string_view> wanted) {
    if (fits) {
        return true;
    }
    SyntaxMessage message(context_, found.span, words_);
    for (const std::string_view piece : wanted) {
        message.add_expected(piece);
    }
    message.report(found.kind == LinePieceKind::TextEnd ? "the end of the file"
                                                        : "the end of the line");
    if (found.kind == LinePieceKind::Text) {
        at_ = std::min(text_.find('\n', at_), text_.size());
        const bool has_line_ends = format_.blanks.find('\n') == std::string_view::npos;
        if (has_line_ends) {
            static_cast<void>(next(nullptr)); // the next piece is the line end
        }
    }
    return false;
}

bool LineReader::expect_line_end(PieceLength length) {
    const LinePiece end = next(length);
    return expect(end.kind == LinePieceKind::LineEnd, end, {"the end of the line"});
}

SourceSpan whole_file(FileId file, const ParseContext& context) {
    return {file, 0, static_cast<std::uint32_t>(context.sources.file(file).text().size())};
}

} // namespace lsys
