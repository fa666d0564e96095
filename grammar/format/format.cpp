// SPDX-License-Identifier: MIT
#include "grammar/format/format.h"

#include "grammar/base/utf8.h"
#include "grammar/format/impl/columns.h"
#include "grammar/format/impl/conditions.h"
#include "grammar/format/impl/lexemes.h"
#include "grammar/format/impl/lines.h"
#include "grammar/format/impl/pieces.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Blanks between a statement and the comment after it.
constexpr std::uint32_t kCommentGap = 2;

/// Formats a text group by group. A group is a sequence of statements on consecutive lines.
class Layout {
public:
    explicit Layout(std::string_view text) : text_(text) {}

    std::string run() {
        std::size_t at = 0;
        bool after_comment = false; // the last item was a standalone block comment
        for (;;) {
            LexemeReader reader(text_, at);
            Lexeme first;
            if (!reader.next(first)) {
                break;
            }
            if (is_comment(first)) {
                flush();
                begin_item(first, after_comment);
                write_comment(first.text);
                after_comment = first.kind == LexemeKind::BlockComment;
                at = reader.offset();
                continue;
            }
            const bool beside_comment = after_comment && first.newlines_before == 0;
            if (beside_comment || first.newlines_before > 1 || rows_.empty()) {
                flush();
                begin_item(first, after_comment);
            }
            const std::size_t begin = reader.offset() - first.text.size();
            rows_.push_back(measure_statement(text_, begin, beside_comment ? column_ : 0));
            find_comments(rows_.back());
            const LayoutRow& row = rows_.back();
            at = row.comments_end;
            if (text_.substr(row.end, row.comments_end - row.end).find('\n') != text_.npos) {
                flush(); // a comment of several lines separates groups
            }
            after_comment = false;
        }
        flush();
        if (!out_.empty()) {
            out_ += '\n';
        }
        return std::move(out_);
    }

private:
    /// Writes the separator before a statement group or a standalone comment: line ends, or a blank
    /// after a block comment on the same line.
    void begin_item(const Lexeme& first, bool after_comment) {
        if (out_.empty()) {
            return;
        }
        if (first.newlines_before == 0 && after_comment) {
            out_ += ' ';
            ++column_;
            return;
        }
        out_ += first.newlines_before > 1 ? "\n\n" : "\n";
        column_ = 0;
    }

    /// Sets LayoutRow::comments_end.
    void find_comments(LayoutRow& row) const {
        std::size_t next = row.end;
        while (next < text_.size() && (text_[next] == ' ' || text_[next] == '\t')) {
            ++next;
        }
        if (next == text_.size() || text_[next] != '/') {
            return;
        }
        LexemeReader reader(text_, row.end);
        for (Lexeme lexeme;
             reader.next(lexeme) && is_comment(lexeme) && lexeme.newlines_before == 0;) {
            row.comments_end = static_cast<std::uint32_t>(reader.offset());
        }
    }

    void write_comment(std::string_view comment) {
        append_comment(comment, out_);
        const std::size_t line = comment.rfind('\n');
        column_ = line == comment.npos ? column_ + text_width(comment)
                                       : text_width(comment.substr(line + 1));
    }

    /// Lines up and writes the statement group in rows_, and clears it.
    void flush() {
        line_up(rows_);
        const bool commented = std::any_of(rows_.begin(), rows_.end(), [](const LayoutRow& row) {
            return row.comments_end != row.end;
        });
        if (!commented) {
            for (std::size_t i = 0; i < rows_.size(); ++i) {
                out_ += i > 0 ? "\n" : "";
                write_statement(rows_[i], out_);
            }
        } else {
            write_commented();
        }
        rows_.clear();
    }

    struct StatementEnd {
        std::uint32_t column = 0; // just after the statement
        bool is_one_line = false; // the whole statement is one line
    };

    StatementEnd write_statement(const LayoutRow& row, std::string& out) const {
        PieceReader reader(text_, row.begin);
        LineWriter writer(out, row.column);
        const bool breaks_head = row.head > kColumns;
        const ConditionLines condition =
            breaks_head ? ConditionLines(text_, row.begin, row.column) : ConditionLines();
        std::size_t cell = 0;
        std::size_t index = 0;
        bool in_head = true;
        for (Piece piece; reader.next(piece); ++index) {
            condition.place(index, piece);
            std::uint32_t blanks = piece.has_blank_before ? 1 : 0;
            if (piece.begins_cell && cell + 1 < kCells) {
                blanks += row.cells[cell];
                ++cell;
            }
            const bool begins_list = piece.is_in_list && in_head;
            in_head = in_head && !begins_list;
            piece.begins_line = piece.begins_line || (begins_list && row.list_below);
            writer.add(piece, blanks, in_head ? breaks_head : !begins_list);
        }
        writer.finish();
        return {writer.column(), writer.one_line()};
    }

    void write_commented() {
        std::string statements;
        std::vector<std::size_t> offsets; // ends of the rows in `statements`
        std::vector<StatementEnd> ends;
        for (const LayoutRow& row : rows_) {
            ends.push_back(write_statement(row, statements));
            offsets.push_back(statements.size());
        }
        std::vector<std::uint32_t> gaps(rows_.size(), kCommentGap);
        for (std::size_t i = 0; i < rows_.size();) {
            std::size_t end = i;
            while (end < rows_.size() && ends[end].is_one_line) {
                ++end;
            }
            line_up_comments(i, end, ends, gaps);
            i = end + 1;
        }
        std::size_t at = 0;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            out_ += i > 0 ? "\n" : "";
            out_.append(statements, at, offsets[i] - at);
            at = offsets[i];
            LexemeReader reader(text_, rows_[i].end);
            std::uint32_t gap = gaps[i];
            for (Lexeme lexeme; reader.offset() < rows_[i].comments_end && reader.next(lexeme);) {
                out_.append(gap, ' ');
                write_comment(lexeme.text);
                gap = 1;
            }
        }
    }

    void line_up_comments(std::size_t begin,
                          std::size_t end,
                          const std::vector<StatementEnd>& ends,
                          std::vector<std::uint32_t>& gaps) const {
        std::vector<std::uint32_t> widths;
        for (std::size_t i = begin; i < end; ++i) {
            if (rows_[i].comments_end != rows_[i].end) {
                widths.push_back(ends[i].column);
            }
        }
        pad(widths);
        std::size_t next = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (rows_[i].comments_end != rows_[i].end) {
                gaps[i] += widths[next] == kUnaligned ? 0 : widths[next];
                ++next;
            }
        }
    }

    std::string_view text_;
    std::string out_;
    std::uint32_t column_ = 0; // columns of the last line of out_ if it ends with a comment, else 0
    std::vector<LayoutRow> rows_; // the current group, not yet in out_
};

bool has_crlf(std::string_view text) {
    std::size_t line_end_count = 0;
    std::size_t crlf_count = 0;
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
        ++line_end_count;
        crlf_count += at > 0 && text[at - 1] == '\r' ? 1U : 0U;
    }
    return crlf_count * 2 > line_end_count;
}

} // namespace

std::string format_text(std::string_view text) {
    std::string out = Layout(text).run();
    if (!has_crlf(text)) {
        return out;
    }
    std::string lines;
    lines.reserve(out.size() + out.size() / 16);
    for (const char c : out) {
        if (c == '\n') {
            lines += '\r';
        }
        lines += c;
    }
    return lines;
}

std::optional<std::string> format_lsys(FileId file, const ParseContext& context) {
    const std::uint64_t errors = context.diagnostics.count(Severity::Error);
    const FileLoader load_nothing = [](const std::string&) -> Result<std::string> {
        return std::string();
    };
    static_cast<void>(
        parse_lsys(file, {context.sources, context.names, context.diagnostics, load_nothing}));
    if (context.diagnostics.count(Severity::Error) != errors) {
        return std::nullopt;
    }
    const SourceFile& source = context.sources.file(file);
    std::string text = format_text(source.text());
    if (source.has_byte_order_mark()) {
        text.insert(0, "\xEF\xBB\xBF");
    }
    return text;
}

} // namespace lsys
