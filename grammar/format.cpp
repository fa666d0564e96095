#include "grammar/format.h"

#include "grammar/contract.h"
#include "grammar/formatting/lexemes.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::string_view kIndent = "    ";

bool is_comment(const Lexeme& lexeme) {
    return lexeme.kind == LexemeKind::LineComment || lexeme.kind == LexemeKind::BlockComment;
}

/// Whether a blank stands between two tokens of one statement.
bool blank_between(const Lexeme& before, const Lexeme& after) {
    using enum LexemeKind;
    if (before.kind == BlockComment || after.kind == BlockComment) {
        return true;
    }
    switch (after.kind) {
    case Semicolon:
        return before.kind == Colon; // an empty successor
    case Open:
    case Close:
    case Right:
    case Comma:
        return false;
    case Colon:
    case Context:
        return true;
    case Module:
        return before.kind != Module && before.kind != Close ? true : after.blank_before;
    case Left:
        if (after.call) {
            return false;
        }
        break;
    case Operator:
        if (after.text == "^") {
            return false;
        }
        break;
    default:
        break;
    }
    if (before.kind == Open || before.kind == Left || before.kind == Unary) {
        return false;
    }
    return !(before.kind == Operator && before.text == "^");
}

class Layout {
public:
    std::string run(const std::vector<Lexeme>& lexemes) {
        std::size_t i = 0;
        while (i < lexemes.size()) {
            const Lexeme& first = lexemes[i];
            begin_item(first);
            if (is_comment(first)) {
                append(first.text);
                after_comment_ = first.kind == LexemeKind::BlockComment;
                after_statement_ = false;
                ++i;
                continue;
            }
            i = statement(lexemes, i);
            after_comment_ = false;
            after_statement_ = true;
        }
        if (!out_.empty()) {
            out_ += '\n';
        }
        return std::move(out_);
    }

private:
    /// A comment or statement goes on its own line, but for comments beside a statement.
    void begin_item(const Lexeme& first) {
        if (out_.empty()) {
            return;
        }
        const bool same_line = first.newlines_before == 0;
        if (same_line && after_statement_ && is_comment(first)) {
            append("  ");
            return;
        }
        if (same_line && after_comment_) {
            append(" ");
            return;
        }
        new_line();
        if (first.newlines_before > 1) {
            new_line();
        }
    }

    std::size_t statement(const std::vector<Lexeme>& lexemes, std::size_t i) {
        std::uint32_t depth = 0;
        std::string piece(lexemes[i].text); // what no line end may part
        const auto flush = [&](bool blank) {
            const std::size_t width = piece.find('\n') == piece.npos ? piece.size() : 0;
            if (blank && column_ + 1 + width > kColumns && column_ > kIndent.size()) {
                new_line();
                append(kIndent);
            } else if (blank) {
                append(" ");
            }
            append(piece);
            piece.clear();
        };
        bool blank_before_piece = false;
        while (lexemes[i].kind != LexemeKind::Semicolon && i + 1 < lexemes.size()) {
            const Lexeme& before = lexemes[i];
            const Lexeme& after = lexemes[i + 1];
            if (before.kind == LexemeKind::Open || before.kind == LexemeKind::Left) {
                ++depth;
            } else if (before.kind == LexemeKind::Close || before.kind == LexemeKind::Right) {
                depth -= depth > 0 ? 1U : 0U;
            }
            if (blank_between(before, after)) {
                if (depth == 0) {
                    flush(blank_before_piece);
                    blank_before_piece = true;
                } else {
                    piece += ' ';
                }
            }
            piece += after.text;
            ++i;
        }
        flush(blank_before_piece);
        return i + 1;
    }

    void append(std::string_view text) {
        for (const char c : text) {
            if (c == '\r') {
                continue;
            }
            out_ += c;
            column_ = c == '\n' ? 0 : column_ + 1;
        }
    }

    void new_line() {
        out_ += '\n';
        column_ = 0;
    }

    std::string out_;
    std::size_t column_ = 0;
    bool after_statement_ = false;
    bool after_comment_ = false;
};

} // namespace

std::string format_text(std::string_view text) {
    return Layout().run(lexemes_of(text));
}

std::optional<std::string> format_lsys(FileId file, const ParseContext& context) {
    const std::uint64_t errors = context.diagnostics.count(Severity::Error);
    const FileLoader nothing = [](const std::string&) -> Result<std::string> {
        return std::string();
    };
    static_cast<void>(
        parse_lsys(file, {context.sources, context.names, context.diagnostics, nothing}));
    if (context.diagnostics.count(Severity::Error) != errors) {
        return std::nullopt;
    }
    return format_text(context.sources.file(file).text());
}

} // namespace lsys
