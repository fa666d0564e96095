// SPDX-License-Identifier: MIT
// Compiles any bytes: the compiler must return diagnostics, or bytecode that verifies and can be
// derived within small limits.
#include "compiler/bytecode/verify.h"
#include "compiler/compile.h"
#include "grammar/lsys/parse.h"
#include "tests/fuzz/small_derivation.h"

#include <algorithm>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    lsys::SourceMap sources;
    lsys::Names names;
    lsys::Diagnostics diagnostics;
    const lsys::FileLoader no_files = [](const std::string&) -> lsys::Result<std::string> {
        return lsys::Error{"no such file"};
    };
    const lsys::FileId file = sources.add("fuzz.lsys", std::string(data, data + size));
    lsys::Ast ast = lsys::parse_lsys(file, {sources, names, diagnostics, no_files});
    const lsys::CompileOutcome outcome =
        lsys::compile(std::move(ast), names, sources, lsys::CompileOptions{}, diagnostics);
    if (!outcome.bytecode.has_value()) {
        return diagnostics.has_errors() ? 0 : (std::abort(), 0);
    }
    if (lsys::verify(*outcome.bytecode).has_value()) {
        std::abort();
    }
    static_cast<void>(SmallDerivation(*outcome.bytecode).run());
    return 0;
}
