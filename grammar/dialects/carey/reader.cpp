// SPDX-License-Identifier: MIT
#include "grammar/dialects/carey/reader.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/line_reader.h"
#include "grammar/dialects/impl/syntax_message.h"
#include "grammar/dialects/impl/text.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::array kKeys{
    CareyKey{"axiom", ""},          CareyKey{"generations", ""},
    CareyKey{"angle", "angle"},     CareyKey{"angle_scale", "angle_scale"},
    CareyKey{"step", "step"},       CareyKey{"step_scale", "step_scale"},
    CareyKey{"thickness", "width"}, CareyKey{"thickness_scale", "width_scale"},
    CareyKey{"seed", "seed"},
};

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Length of the value of a setting at the beginning of `ahead`: up to the end of the line.
std::size_t value_length(std::string_view ahead) {
    return trimmed(ahead.substr(0, length_up_to(ahead, std::string_view("\r\n\0", 3)))).size();
}

/// Length of the text at the beginning of `ahead`, up to the next `=`, `:` or end of line.
std::size_t text_length(std::string_view ahead) {
    return trimmed(ahead.substr(0, length_up_to(ahead, std::string_view("=:\r\n\0", 5)))).size();
}

bool is_text(const LinePiece& piece) {
    return piece.kind == LinePieceKind::Text && piece.text != "=" && piece.text != ":" &&
           piece.text[0] != '\0';
}

/// Reports a colon without a `=` before it. `has_equals`: a `=` follows the colon.
void report_no_equals(const LinePiece& name,
                      const LinePiece& colon,
                      bool has_equals,
                      Diagnostics& diagnostics) {
    if (has_equals) {
        diagnostics.add(DiagnosticCode::ForeignSyntax, colon.span,
                        "the ratio of a rule comes after its right side");
        return;
    }
    Diagnostic& error =
        diagnostics.add(DiagnosticCode::ForeignKey, name.span,
                        "`" + shown(name.text) + "` is not a setting, and a rule has a `=`");
    std::vector<std::string_view> keys;
    for (const CareyKey& key : kKeys) {
        keys.push_back(key.name);
    }
    suggest_key(error, name.span, name.text, keys);
    std::string names;
    for (const CareyKey& key : kKeys) {
        names += (names.empty() ? "`" : ", `") + std::string(key.name) + "`";
    }
    error.help.push_back("the settings are " + names);
}

class CareyReader {
public:
    CareyReader(FileId root, const ParseContext& context)
        : context_(context), reader_(whole_file(root, context), {" \t\r"}, context) {}

    CareyFile read() {
        for (LinePiece piece; piece.kind != LinePieceKind::TextEnd;) {
            skip_byte_order_mark();
            if (const CareyKey* const key = find_carey_key(reader_.ahead())) {
                read_setting(*key);
            } else if (piece = next(); is_text(piece)) {
                read_rule(piece);
            } else {
                reader_.expect(piece.kind != LinePieceKind::Text, piece,
                               {"the end of the file", "the end of the line",
                                "the name of a setting", "symbols"});
            }
        }
        return std::move(file_);
    }

private:
    LinePiece next() { return reader_.next(text_length); }

    /// Skips byte order marks that stand alone; others belong to a text.
    void skip_byte_order_mark() {
        while (reader_.ahead().starts_with(kByteOrderMark) &&
               text_length(reader_.ahead()) == kByteOrderMark.size()) {
            static_cast<void>(next());
        }
    }

    void read_setting(const CareyKey& key) {
        const LinePiece name = reader_.take(reader_.ahead().find(':') + 1);
        const LinePiece value = reader_.next(value_length);
        const bool fits = value.kind == LinePieceKind::Text && value.text[0] != '\0';
        if (reader_.expect(fits, value, {"the value of the setting"}) &&
            reader_.expect_line_end(value_length)) {
            file_.settings.push_back({&key, name.span, value.span});
        }
    }

    void read_rule(const LinePiece& left) {
        const LinePiece sign = next();
        if (sign.text == ":") {
            read_no_equals(left, sign);
            return;
        }
        if (!reader_.expect(sign.text == "=", sign, {"`=`", "`:`"})) {
            return;
        }
        CareyRule rule{left.span, {sign.span.file, sign.span.end, sign.span.end}, {}};
        LinePiece piece = next();
        const bool erases = !is_text(piece);
        if (!erases) {
            rule.right = piece.span;
            piece = next();
        }
        bool fits = true;
        if (piece.text == ":") {
            const LinePiece ratio = next();
            rule.ratio = ratio.span;
            fits = reader_.expect(is_text(ratio), ratio, {"symbols"}) &&
                   reader_.expect_line_end(text_length);
        } else {
            fits = piece.kind == LinePieceKind::LineEnd;
            erases ? reader_.expect(fits, piece, {"the end of the line", "symbols", "`:`"})
                   : reader_.expect(fits, piece, {"the end of the line", "`:`"});
        }
        if (fits) {
            file_.rules.push_back(rule);
        }
    }

    void read_no_equals(const LinePiece& name, const LinePiece& colon) {
        bool has_equals = false;
        LinePiece piece = next();
        for (; piece.kind == LinePieceKind::Text && piece.text[0] != '\0'; piece = next()) {
            has_equals = has_equals || piece.text == "=";
        }
        if (reader_.expect(piece.kind == LinePieceKind::LineEnd, piece,
                           {"the end of the line", "symbols", "`=`", "`:`"})) {
            report_no_equals(name, colon, has_equals, context_.diagnostics);
        }
    }

    const ParseContext& context_;
    LineReader reader_;
    CareyFile file_;
};

} // namespace

const CareyKey* find_carey_key(std::string_view text) {
    for (const CareyKey& key : kKeys) {
        if (text.starts_with(key.name)) {
            const std::size_t colon = text.find_first_not_of(" \t", key.name.size());
            if (colon != std::string_view::npos && text[colon] == ':') {
                return &key;
            }
        }
    }
    return nullptr;
}

CareyFile read_carey(FileId root, const ParseContext& context) {
    return CareyReader(root, context).read();
}

} // namespace lsys
