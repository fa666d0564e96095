#include "grammar/dialects/carey/reader.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/line_reader.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

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

/// Bytes up to the first of `stops`, without blanks before it.
std::size_t length_up_to(std::string_view ahead, std::string_view stops) {
    const std::string_view text = ahead.substr(0, ahead.find_first_of(stops));
    return text.find_last_not_of(" \t") + 1;
}

std::size_t value_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view("\r\n\0", 3));
}

std::size_t text_length(std::string_view ahead) {
    return length_up_to(ahead, std::string_view("=:\r\n\0", 5));
}

/// A colon of a line that has no `=` before it; `has_equals`: it has one behind.
void report_no_equals(const LinePiece& name,
                      const LinePiece& colon,
                      bool has_equals,
                      Diagnostics& diagnostics) {
    if (has_equals) {
        diagnostics.add(DiagnosticCode::ForeignSyntax, colon.span,
                        "the ratio of a rule stands behind its right side");
        return;
    }
    Diagnostic& error =
        diagnostics.add(DiagnosticCode::ForeignSyntax, name.span,
                        "`" + shown(name.text) + "` is no setting, and a rule has a `=`");
    std::string names;
    for (const CareyKey& key : kKeys) {
        names += (names.empty() ? "`" : ", `") + std::string(key.name) + "`";
    }
    error.help.push_back("the settings are " + names);
}

class Lines {
public:
    Lines(FileId root, const ParseContext& context)
        : context_(context), reader_(whole_file(root, context), {" \t\r"}, context) {}

    CareyFile read() {
        while (true) {
            skip_byte_order_mark();
            if (const CareyKey* const key = find_carey_key(reader_.ahead())) {
                read_setting(*key);
                continue;
            }
            const LinePiece piece = next();
            if (piece.kind == LinePieceKind::TextEnd) {
                return std::move(file_);
            }
            if (is_text(piece)) {
                read_rule(piece);
            } else if (piece.kind != LinePieceKind::LineEnd) {
                reader_.reject(piece, {"the end of the file", "the end of the line",
                                       "the name of a setting", "symbols"});
            }
        }
    }

private:
    LinePiece next() { return reader_.next(text_length); }

    static bool is_text(const LinePiece& piece) {
        return piece.kind == LinePieceKind::Text && piece.text != "=" && piece.text != ":" &&
               piece.text[0] != '\0';
    }

    /// One that stands alone; else it belongs to a text.
    void skip_byte_order_mark() {
        while (reader_.ahead().starts_with(kByteOrderMark) &&
               text_length(reader_.ahead()) == kByteOrderMark.size()) {
            static_cast<void>(next());
        }
    }

    /// Returns whether the line ends; else `piece` is rejected.
    bool ends(const LinePiece& piece) {
        if (piece.kind != LinePieceKind::LineEnd) {
            reader_.reject(piece, {"the end of the line"});
        }
        return piece.kind == LinePieceKind::LineEnd;
    }

    void read_setting(const CareyKey& key) {
        const LinePiece name = reader_.take(reader_.ahead().find(':') + 1);
        const LinePiece value = reader_.next(value_length);
        if (value.kind != LinePieceKind::Text || value.text[0] == '\0') {
            reader_.reject(value, {"the value of the setting"});
        } else if (ends(reader_.next(value_length))) {
            file_.settings.push_back({&key, name.span, value.span});
        }
    }

    void read_rule(const LinePiece& left) {
        const LinePiece sign = next();
        if (sign.text == ":") {
            read_no_equals(left, sign);
            return;
        }
        if (sign.text != "=") {
            reader_.reject(sign, {"`=`", "`:`"});
            return;
        }
        CareyRule rule{left.span, {sign.span.file, sign.span.end, sign.span.end}, {}};
        LinePiece piece = next();
        const bool erases = !is_text(piece);
        if (!erases) {
            rule.right = piece.span;
            piece = next();
        }
        if (piece.text == ":") {
            const LinePiece ratio = next();
            if (!is_text(ratio)) {
                reader_.reject(ratio, {"symbols"});
                return;
            }
            rule.ratio = ratio.span;
            if (!ends(next())) {
                return;
            }
        } else if (piece.kind != LinePieceKind::LineEnd) {
            erases ? reader_.reject(piece, {"the end of the line", "symbols", "`:`"})
                   : reader_.reject(piece, {"the end of the line", "`:`"});
            return;
        }
        file_.rules.push_back(rule);
    }

    void read_no_equals(const LinePiece& name, const LinePiece& colon) {
        bool has_equals = false;
        LinePiece piece = next();
        for (; piece.kind == LinePieceKind::Text && piece.text[0] != '\0'; piece = next()) {
            has_equals = has_equals || piece.text == "=";
        }
        if (piece.kind == LinePieceKind::LineEnd) {
            report_no_equals(name, colon, has_equals, context_.diagnostics);
        } else {
            reader_.reject(piece, {"the end of the line", "symbols", "`=`", "`:`"});
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
    return Lines(root, context).read();
}

} // namespace lsys
