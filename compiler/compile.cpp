// SPDX-License-Identifier: MIT
#include "compiler/compile.h"

#include "compiler/bytecode/verify.h"
#include "compiler/lint/checks.h"
#include "compiler/lower/lower.h"
#include "compiler/resolve/resolve.h"
#include "grammar/base/contract.h"

#include <utility>

namespace lsys {

CompileOutcome compile(Ast ast,
                       Names& names,
                       const SourceMap& sources,
                       const CompileOptions& options,
                       Diagnostics& diagnostics) {
    CompileOutcome outcome;
    ResolveOutcome resolved = resolve(std::move(ast), names, sources, options, diagnostics);
    Program& program = resolved.program;
    outcome.unknown_definitions = std::move(resolved.unknown_definitions);

    if (program.is_valid && options.lower) {
        outcome.bytecode = lower(program, names, sources);
        if (!outcome.bytecode) {
            diagnostics.add(DiagnosticCode::ProgramTooLarge, program.axiom_span(),
                            "this grammar has more parameters or constants than can be numbered");
        }
        LSYS_DCHECK(!outcome.bytecode || !verify(*outcome.bytecode));
    }
    const Bytecode* bytecode = outcome.bytecode ? &*outcome.bytecode : nullptr;
    run_checks({program, bytecode, names, sources, options}, diagnostics);

    if (diagnostics.has_errors() || options.part) {
        outcome.bytecode.reset();
    } else {
        outcome.program = std::move(program);
    }
    return outcome;
}

Result<void> change_settings(Ast& ast,
                             Names& names,
                             const SourceMap& sources,
                             Bytecode& bytecode,
                             Diagnostics& diagnostics) {
    resolve_settings(ast, names, sources, bytecode.settings, diagnostics);
    if (const std::optional<std::string> problem = verify(bytecode)) {
        return Error{*problem};
    }
    return {};
}

} // namespace lsys
