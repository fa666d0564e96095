// What stands before the parse of a file: bytes that are no UTF-8 and typographic characters are
// reported, and the text is made in which plain characters stand for them. Comments and file names
// stay as they are.
#pragma once

#include "grammar/ast/text_map.h"
#include "grammar/lsys/impl/parse_session.h"

#include <memory>
#include <string>

namespace lsys {

/// What a file is scanned as. `own` and `map` are what `scanned` refers to.
struct NormalizedText {
    std::unique_ptr<std::string> own;
    std::unique_ptr<TextMap> map;
    ScannedText scanned;
    /// What the first `#set names` of the file says.
    ModuleNames names = ModuleNames::Words;
};

/// Reports to the context's diagnostics. The result holds views of the file's text. No scan of it
/// meets a character beyond ASCII but in comments, file names and back quotes.
[[nodiscard]] NormalizedText normalize_source(FileId file, const ParseContext& context);

/// Of a translation, which is plain already.
[[nodiscard]] NormalizedText normalize_source(const Translation& translation,
                                              const ParseContext& context);

namespace lsys_grammar {

/// The scanner has met a character beyond ASCII. Before the parse it is noted, and what is meant is
/// written over the end of it; returns where the scan goes on.
int normalize_character(ParseSession& session, char* character, int length);
/// Notes the confusables of the name in back quotes at hand, which the scan then passes over. In a
/// translation they are errors: its text would be read as another one.
void normalize_quoted(ParseSession& session, std::string_view text);

} // namespace lsys_grammar
} // namespace lsys
