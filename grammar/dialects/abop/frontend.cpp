// SPDX-License-Identifier: MIT
// The notation of "The Algorithmic Beauty of Plants" as people write it in plain text: settings and
// constants, an axiom, and rules `label: left < predecessor > right : condition -> successor`. The
// turtle is the profile `abop`.
#include "grammar/dialects/abop/reader.h"
#include "grammar/dialects/abop/writer.h"
#include "grammar/dialects/impl/frontends.h"

namespace lsys {

std::string_view recognise_abop(std::string_view text) {
    return is_abop(text) && recognise_cpfg(text).empty() ? "an axiom, and rules `A -> B`,"
                                                         : std::string_view();
}

void translate_abop(const DialectRow& row, const ParseContext& context, Translation& translation) {
    const FileId root = translation.file();
    const AbopFile file = read_abop(root, context.sources.file(root).text(), &context);
    if (!context.diagnostics.has_errors()) {
        AbopWriter(file, context, translation).write(row.turtle);
    }
}

} // namespace lsys
