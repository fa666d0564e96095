// The first pass over a file: bytes that are no UTF-8 and typographic characters are reported, and
// the text is made in which plain characters stand for them. Comments and file names stay as they
// are.
#pragma once

#include "grammar/ast/text_map.h"
#include "grammar/lsys/impl/parse_session.h"

#include <memory>
#include <string>

namespace lsys {

/// What a file is scanned as. `own` and `map` are what `scanned` refers to.
struct PlainText {
    std::string own;
    std::unique_ptr<TextMap> map;
    ScannedText scanned;
    /// What the first `#set names` of the file says.
    ModuleNames names = ModuleNames::Words;
};

/// Reports to the context's diagnostics unless `silent`. The result holds views of the file's text.
[[nodiscard]] PlainText make_plain(FileId file, const ParseContext& context, bool silent);

/// Of a translation, which is plain already.
[[nodiscard]] PlainText make_plain(const Translation& translation, const ParseContext& context);

namespace lsys_grammar {

/// The scanner of the first pass has met a character beyond ASCII. Reports it and writes what is
/// meant over the end of it; returns where the scan goes on.
int read_as_plain(ParseSession& session, char* character, int length);
/// The same for the name in back quotes at hand, which the scan then passes over.
void replace_in_quotes(ParseSession& session, std::string_view text);

} // namespace lsys_grammar
} // namespace lsys
