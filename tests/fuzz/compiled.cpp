// SPDX-License-Identifier: MIT
#include "tests/fuzz/compiled.h"

#include "compiler/bytecode/verify.h"
#include "grammar/rendering/render_diagnostic.h"
#include "runtime/derive/word_text.h"
#include "tests/fuzz/small_derivation.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

CompiledText compile_text(std::string text, lsys::Dialect dialect, std::string_view system) {
    lsys::SourceMap sources;
    lsys::Names names;
    lsys::Diagnostics diagnostics;
    const lsys::FileLoader no_files = [](const std::string&) -> lsys::Result<std::string> {
        return lsys::Error{"no such file"};
    };
    const lsys::FileId file = sources.add("fuzz", std::move(text));
    CompiledText made;
    lsys::Ast ast = lsys::parse_dialect(
        file, dialect, {sources, names, diagnostics, no_files, false, system}, &made.translation);
    lsys::CompileOutcome outcome =
        lsys::compile(std::move(ast), names, sources, lsys::CompileOptions{}, diagnostics);
    // Rendering asserts that every place in a message is within its file.
    diagnostics.sort_by_place();
    for (const lsys::MessageFormat format :
         {lsys::MessageFormat::Human, lsys::MessageFormat::Json}) {
        std::string messages;
        lsys::render_all(diagnostics, sources, {format, false, 50}, messages);
    }
    made.has_errors = diagnostics.has_errors();
    made.bytecode = std::move(outcome.bytecode);
    if (made.bytecode.has_value() == made.has_errors ||
        (made.bytecode && lsys::verify(*made.bytecode).has_value())) {
        std::abort();
    }
    return made;
}

std::string derived_text(const lsys::Bytecode& bytecode) {
    SmallDerivation derivation(bytecode);
    const std::optional<lsys::Stop> stop = derivation.run();
    std::string text = std::to_string(stop ? 1 + static_cast<int>(*stop) : 0) + " ";
    if (!stop) {
        static_cast<void>(
            lsys::WordPrinter(bytecode).print(derivation.word(), [&](std::string_view piece) {
                text += piece;
                return true;
            }));
    }
    return text;
}
