#include "runtime/cli/tell.h"

#include "runtime/runtime_diagnostic.h"

#include <utility>

namespace lsys::lsc {

Status show(Diagnostic diagnostic, Status status, const Grammar& grammar, const Console& console) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    static_cast<void>(console.show(diagnostics, grammar.sources));
    return status;
}

Status fail(const Error& error, const Console& console) {
    console.error(error.message);
    if (error.kind == ErrorKind::Limit) {
        console.help("raise the limit with `--max-memory`");
        return Status::Limit;
    }
    return Status::Failure;
}

Status tell(DeriveStatus status,
            const RuntimeError& error,
            const LimitReport& limit,
            const Limits& limits,
            const Grammar& grammar,
            const Console& console) {
    const Bytecode& bytecode = *grammar.bytecode;
    const bool has_sources = !grammar.is_module_file;
    switch (status) {
    case DeriveStatus::Ok:
        return Status::Fine;
    case DeriveStatus::Error:
        return show(runtime_diagnostic(error, bytecode, has_sources), Status::AuthorErrors, grammar,
                    console);
    case DeriveStatus::Limit:
    case DeriveStatus::OutOfMemory:
        return show(limit_diagnostic(limit, limits, bytecode, has_sources), Status::Limit, grammar,
                    console);
    case DeriveStatus::Cancelled:
        return Status::Interrupted;
    }
    return Status::Failure;
}

} // namespace lsys::lsc
