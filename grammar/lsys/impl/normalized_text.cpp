// SPDX-License-Identifier: MIT
#include "grammar/lsys/impl/normalized_text.h"

#include "grammar/base/characters.h"
#include "grammar/base/confusables.h"
#include "grammar/base/utf8.h"
#include "grammar/lsys/impl/draft_text.h"
#include "grammar/lsys/impl/normalizer.h"
#include "grammar/lsys/impl/scanning.h"

#include <algorithm>

namespace lsys {

namespace {

bool is_ascii(std::string_view text) {
    unsigned char bits = 0;
    for (const char c : text) { // no early exit, so that the compiler vectorises the loop
        bits |= static_cast<unsigned char>(c);
    }
    return (bits & 0x80u) == 0;
}

struct Validity {
    bool has_invalid = false;
    bool has_non_ascii = false; // valid characters
};

/// Reports each run of invalid UTF-8 and replaces it with blanks in `valid_utf8`.
Validity
check_utf8(FileId file, std::string_view text, Diagnostics& diagnostics, std::string& valid_utf8) {
    Validity validity;
    for (std::size_t at = 0; at < text.size();) {
        if ((static_cast<unsigned char>(text[at]) & 0x80u) == 0) {
            ++at;
            continue;
        }
        const CodePoint point = decode_utf8(text.substr(at));
        if (point.valid) {
            validity.has_non_ascii = true;
            at += point.length;
            continue;
        }
        if (!validity.has_invalid) {
            validity.has_invalid = true;
            valid_utf8 = text;
        }
        const std::size_t begin = at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0x80u) != 0 &&
               !decode_utf8(text.substr(at)).valid) {
            valid_utf8[at] = ' ';
            ++at;
        }
        if (diagnostics.admits(DiagnosticCode::InvalidUtf8)) {
            Diagnostic& diagnostic = diagnostics.add(
                DiagnosticCode::InvalidUtf8,
                {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at)},
                at - begin == 1 ? "this byte is not UTF-8" : "these bytes are not UTF-8");
            diagnostic.help.emplace_back("a grammar is UTF-8 text; save the file in that encoding");
        }
    }
    return validity;
}

/// Names, diagnostics and tree of a scan before the parse, discarded after that scan.
struct Scratch {
    explicit Scratch(const ParseContext& other)
        : context{other.sources, names, diagnostics, other.load} {}

    Names names;
    Diagnostics diagnostics;
    ParseContext context;
    Ast ast;
};

/// Scans the text as the parse does and appends the characters beyond ASCII that the scanner meets.
void find_strays(const ScannedText& scanned,
                 const ParseContext& context,
                 std::vector<StrayCharacter>& strays) {
    Scratch scratch(context);
    ParseSession session(scratch.context, scanned, scratch.ast, nullptr);
    session.silent = true;
    session.strays = &strays;
    lsys_grammar::Scanning scanning(session);
    while (lsys_grammar::next_token(session, scanning.scanner()).kind() !=
           lsys_grammar::Parser::symbol_kind::S_YYEOF) {
    }
}

/// All characters beyond ASCII.
std::vector<StrayCharacter> all_beyond_ascii(std::string_view text) {
    std::vector<StrayCharacter> strays;
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        if (point.value >= 0x80) {
            strays.push_back({static_cast<std::uint32_t>(at), false, false});
        }
        at += point.length;
    }
    return strays;
}

/// Makes the text and the map of `normalized` from valid UTF-8 with `strays` replaced.
void replace_strays(std::string_view valid,
                    const std::vector<StrayCharacter>& strays,
                    Diagnostics* diagnostics,
                    NormalizedText& normalized) {
    normalized.map = std::make_unique<TextMap>(valid);
    Normalizer(normalized.scanned.file, valid, *normalized.map, diagnostics).replace_all(strays);
    normalized.scanned.text = normalized.map->text();
    normalized.scanned.map = normalized.map.get();
}

/// Replaces the characters beyond ASCII that the scanner meets, until a scan of the normalized text
/// meets none: a replacement may change how the text after it is scanned. The scan depends only on
/// the text, so the scan during the parse meets no such character either.
void normalize_source(const ParseContext& context,
                      Diagnostics& diagnostics,
                      NormalizedText& normalized) {
    constexpr int kMaxScans = 8; // only malicious texts need more
    const std::string_view valid = normalized.scanned.text;
    std::vector<StrayCharacter> strays;
    for (int scan = 1;; ++scan) {
        const std::size_t known = strays.size();
        find_strays(normalized.scanned, context, strays);
        if (strays.size() == known) {
            break;
        }
        if (scan == kMaxScans) {
            strays = all_beyond_ascii(valid);
            break;
        }
        const auto found = strays.begin() + static_cast<std::ptrdiff_t>(known);
        if (!std::is_sorted(found, strays.end())) {
            std::sort(found, strays.end());
        }
        std::inplace_merge(strays.begin(), found, strays.end());
        strays.erase(std::unique(strays.begin(), strays.end(),
                                 [](const StrayCharacter& a, const StrayCharacter& b) {
                                     return a.begin == b.begin;
                                 }),
                     strays.end());
        replace_strays(valid, strays, nullptr, normalized);
    }
    if (!strays.empty()) {
        replace_strays(valid, strays, &diagnostics, normalized);
    }
}

/// The form of module names by the first `#set names` of the text.
ModuleNames names_of(const ScannedText& scanned, const ParseContext& context) {
    using Kind = lsys_grammar::Parser::symbol_kind;
    if (scanned.text.find("letters") == std::string_view::npos &&
        scanned.text.find("characters") == std::string_view::npos) {
        return ModuleNames::Words;
    }
    Scratch scratch(context);
    ParseSession session(scratch.context, scanned, scratch.ast, nullptr);
    session.silent = true;
    const NameId names = scratch.names.intern("names");
    const NameId letters = scratch.names.intern("letters");
    const NameId characters = scratch.names.intern("characters");
    lsys_grammar::Scanning scanning(session);
    int matched = 0; // tokens of `#set names`
    while (true) {
        const auto token = lsys_grammar::next_token(session, scanning.scanner());
        if (token.kind() == Kind::S_YYEOF) {
            return ModuleNames::Words;
        }
        if (token.kind() == Kind::S_SET) {
            matched = 1;
        } else if (matched == 0 || token.kind() != Kind::S_IDENTIFIER) {
            matched = 0;
        } else {
            const auto word = token.value.name;
            if (matched == 2) {
                return word == letters      ? ModuleNames::Letters
                       : word == characters ? ModuleNames::Characters
                                            : ModuleNames::Words;
            }
            matched = word == names ? 2 : 0;
        }
    }
}

} // namespace

namespace {

/// Repairs pasted text and forms of other languages; larger files are not searched.
void repair_foreign_text(std::string_view source,
                         const ParseContext& context,
                         NormalizedText& normalized) {
    constexpr std::size_t kMaxSearchedText = std::size_t{1} << 20;
    if (source.size() > kMaxSearchedText) {
        return;
    }
    lsys_grammar::DraftText draft{.file = normalized.scanned.file,
                                  .text = std::string(source),
                                  .diagnostics = context.diagnostics,
                                  .masked = {},
                                  .lines = {}};
    draft.mask();
    lsys_grammar::repair_pasted_text(draft);
    lsys_grammar::repair_foreign_forms(draft);
    normalized.is_incomplete = draft.is_incomplete;
    if (draft.is_changed) {
        normalized.draft = std::make_unique<std::string>(std::move(draft.text));
        normalized.scanned.text = *normalized.draft;
    }
}

} // namespace

NormalizedText normalize_source(FileId file, const ParseContext& context) {
    NormalizedText normalized;
    normalized.scanned = {file, context.sources.file(file).text(), nullptr, nullptr};
    repair_foreign_text(normalized.scanned.text, context, normalized);
    const std::string_view source = normalized.scanned.text;
    if (!is_ascii(source)) {
        normalized.valid_utf8 = std::make_unique<std::string>();
        const Validity validity =
            check_utf8(file, source, context.diagnostics, *normalized.valid_utf8);
        if (validity.has_invalid) {
            normalized.scanned.text = *normalized.valid_utf8;
        }
        if (validity.has_non_ascii) {
            normalize_source(context, context.diagnostics, normalized);
        }
    }
    normalized.names = names_of(normalized.scanned, context);
    return normalized;
}

NormalizedText normalize_source(const Translation& translation, const ParseContext& context) {
    NormalizedText normalized;
    normalized.scanned = {translation.file(), translation.text(), nullptr, &translation};
    normalized.names = names_of(normalized.scanned, context);
    return normalized;
}

namespace lsys_grammar {

namespace {

void record_stray(ParseSession& session, std::uint32_t begin, bool in_quotes) {
    const ScanState& scan = session.scan;
    const bool in_value = !scan.open.empty() || scan.part == Part::Value ||
                          scan.part == Part::Condition || scan.part == Part::Setting;
    session.strays->push_back({session.scanned.source_begin(begin), in_quotes, in_value});
}

/// Records the curly closing quote of a file name whose opening quote is curly. The name begins at
/// `after` in the text and at `buffer` in the scanner's copy.
void close_quotes(ParseSession& session, std::uint32_t after, char* buffer) {
    const std::string_view text = session.scanned.text;
    for (std::uint32_t at = after;
         at < text.size() && text[at] != '\n' && text[at] != '"' && text[at] != '\0';) {
        const CodePoint point = decode_utf8(text.substr(at));
        if (point.value >= 0x80 && normalized_form(point.value) == "\"") {
            record_stray(session, at, false);
            buffer[at - after + point.length - 1] = '"';
            return;
        }
        at += point.length;
    }
}

/// Reports a character beyond ASCII in a translation, outside of back quotes.
void report_stray_character(ParseSession& session) {
    if (session.wants(DiagnosticCode::UnknownCharacter)) {
        const std::string_view text = session.match_text();
        session.report(DiagnosticCode::UnknownCharacter,
                       "`" + std::string(text) + "` has no meaning in a grammar");
    }
}

/// Reports a module of another dialect whose character .lsys would normalize.
void report_foreign_confusable(ParseSession& session,
                               SourceSpan place,
                               char32_t character,
                               const Confusable& confusable) {
    if (!session.wants(DiagnosticCode::ForeignFeature)) {
        return;
    }
    const std::string what =
        code_point_name(character) +
        (confusable.name.empty() ? std::string() : " (" + std::string(confusable.name) + ")");
    const std::string ascii(confusable.ascii);
    Diagnostic& diagnostic = session.report(
        DiagnosticCode::ForeignFeature, place,
        ascii.empty() ? "an invisible character, " + what + ", cannot be a module"
        : ascii == " "
            ? "a blank that is not a plain one but " + what + " cannot be a module"
            : "this looks like `" + ascii + "` but is " + what + ", which cannot be a module");
    add_fix(diagnostic,
            ascii.empty()  ? std::string("remove it")
            : ascii == " " ? std::string("write a plain blank")
                           : "write `" + ascii + "`",
            place, ascii, false);
}

} // namespace

int normalize_character(ParseSession& session, char* character, int length) {
    if (session.strays == nullptr) {
        report_stray_character(session);
        return length;
    }
    const std::uint32_t begin = session.scan.begin;
    const std::string_view text = session.scanned.text;
    record_stray(session, begin, false);
    const std::string ascii = normalized_form(decode_utf8(text.substr(begin)).value)
                                  .substr(0, static_cast<std::size_t>(length));
    const Part part = session.scan.part;
    if (ascii == "\"" && (part == Part::ObjectName || part == Part::ObjectValue)) {
        close_quotes(session, begin + static_cast<std::uint32_t>(length), character + length);
    }
    const auto size = static_cast<int>(ascii.size());
    std::copy(ascii.begin(), ascii.end(), character + length - size);
    return length - size;
}

void normalize_after_word(ParseSession& session) {
    const std::string_view text = session.scanned.text;
    const std::uint32_t at = session.scan.end;
    if (session.strays == nullptr || at >= text.size() ||
        (static_cast<unsigned char>(text[at]) & 0x80u) == 0) {
        return;
    }
    const std::optional<Confusable> confusable =
        find_confusable(decode_utf8(text.substr(at)).value);
    if (confusable && !confusable->ascii.empty() && is_letter(confusable->ascii[0])) {
        record_stray(session, at, false);
    }
}

void normalize_quoted(ParseSession& session, std::string_view text) {
    const bool is_translation = session.scanned.translation != nullptr;
    if (session.strays == nullptr && !is_translation) {
        return;
    }
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        const std::optional<Confusable> confusable = find_confusable(point.value);
        const auto begin = session.scan.begin + static_cast<std::uint32_t>(at);
        if (confusable && !is_translation) {
            record_stray(session, begin, true);
            // U+00A0 and lower code points are blanks or controls, not names.
        } else if (confusable && point.value > 0xA0) {
            report_foreign_confusable(session, session.scanned.span(begin, begin + point.length),
                                      point.value, *confusable);
        }
        at += point.length;
    }
}

} // namespace lsys_grammar

} // namespace lsys
