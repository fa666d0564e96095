#include "grammar/lsys/impl/plain_text.h"

#include "grammar/base/utf8.h"
#include "grammar/lsys/impl/plain_reader.h"
#include "grammar/lsys/impl/scanning.h"

#include <algorithm>

namespace lsys {

namespace {

bool is_ascii(std::string_view text) {
    return std::none_of(text.begin(), text.end(),
                        [](char c) { return (static_cast<unsigned char>(c) & 0x80u) != 0; });
}

struct Validity {
    bool has_invalid = false;
    bool has_beyond_ascii = false; // and valid
};

/// Reports each run of bytes that are not UTF-8, and puts blanks in their place into `repaired`.
Validity
check_utf8(FileId file, std::string_view text, Diagnostics* diagnostics, std::string& repaired) {
    Validity validity;
    for (std::size_t at = 0; at < text.size();) {
        if ((static_cast<unsigned char>(text[at]) & 0x80u) == 0) {
            ++at;
            continue;
        }
        const CodePoint point = decode_utf8(text.substr(at));
        if (point.valid) {
            validity.has_beyond_ascii = true;
            at += point.length;
            continue;
        }
        if (!validity.has_invalid) {
            validity.has_invalid = true;
            repaired = text;
        }
        const std::size_t begin = at;
        while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0x80u) != 0 &&
               !decode_utf8(text.substr(at)).valid) {
            repaired[at] = ' ';
            ++at;
        }
        if (diagnostics != nullptr && diagnostics->admits(DiagnosticCode::InvalidUtf8)) {
            Diagnostic& diagnostic = diagnostics->add(
                DiagnosticCode::InvalidUtf8,
                {file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at)},
                at - begin == 1 ? "this byte is not UTF-8" : "these bytes are not UTF-8");
            diagnostic.help.emplace_back("a grammar is UTF-8 text; save the file in that encoding");
        }
    }
    return validity;
}

/// What the passes over the text before the parse do not share with it.
struct Scratch {
    explicit Scratch(const ParseContext& other)
        : context{other.sources, names, diagnostics, other.load} {}

    Names names;
    Diagnostics diagnostics;
    ParseContext context;
    Ast ast;
};

void scan_all(ParseSession& session) {
    session.silent = true;
    lsys_grammar::Scanning scanning(session);
    while (lsys_grammar::next_token(session, scanning.scanner()).kind() !=
           lsys_grammar::Parser::symbol_kind::S_YYEOF) {
    }
}

/// What the first `#set names` of the text says.
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
    int matched = 0; // of: SET names
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

PlainText make_plain(FileId file, const ParseContext& context, bool silent) {
    PlainText plain;
    const std::string_view source = context.sources.file(file).text();
    plain.scanned = {file, source, source, nullptr, nullptr};
    if (!is_ascii(source)) {
        Diagnostics* const diagnostics = silent ? nullptr : &context.diagnostics;
        const Validity validity = check_utf8(file, source, diagnostics, plain.own);
        if (validity.has_invalid) {
            plain.scanned.text = plain.own;
        }
        if (validity.has_beyond_ascii) {
            plain.map = std::make_unique<TextMap>(plain.scanned.text);
            PlainReader reader(file, plain.scanned.text, *plain.map, diagnostics);
            Scratch scratch(context);
            ParseSession session(scratch.context, plain.scanned, scratch.ast, nullptr);
            session.plain_reader = &reader;
            scan_all(session);
            reader.finish();
            plain.scanned.text = plain.map->text();
            plain.scanned.map = plain.map.get();
        }
    }
    plain.names = names_of(plain.scanned, context);
    return plain;
}

PlainText make_plain(const Translation& translation, const ParseContext& context) {
    PlainText plain;
    plain.scanned = {translation.file(), context.sources.file(translation.file()).text(),
                     translation.text(), nullptr, &translation};
    plain.names = names_of(plain.scanned, context);
    return plain;
}

namespace lsys_grammar {

int read_as_plain(ParseSession& session, char* character, int length) {
    LSYS_CHECK(session.plain_reader != nullptr, session.scan.begin);
    const Part part = session.scan.part;
    const bool in_object = part == Part::ObjectName || part == Part::ObjectValue;
    return session.plain_reader->read(session.scan.begin, character, length, in_object);
}

void replace_in_quotes(ParseSession& session, std::string_view text) {
    if (session.plain_reader == nullptr) {
        return;
    }
    for (std::size_t at = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        if (point.value >= 0x80) {
            session.plain_reader->read_quoted(session.scan.begin + static_cast<std::uint32_t>(at),
                                              point.length);
        }
        at += point.length;
    }
}

} // namespace lsys_grammar

} // namespace lsys
