// SPDX-License-Identifier: MIT
// The checks of a Program: the rules of docs/language.md that need the whole program, and lints for
// likely mistakes. Each check is one function in a file of its own; checks.cpp lists them.
// Checks run in the order of that list, after lowering, so that they can also read the bytecode.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/compile_options.h"
#include "compiler/program/program.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <string_view>

namespace lsys {

/// The input of a check.
struct CheckInput {
    const Program& program;
    /// Null if the program was not lowered. A production has the same index as in `program`.
    const Bytecode* bytecode;
    const Names& names;
    const SourceMap& sources;
    const CompileOptions& options;

    [[nodiscard]] std::string_view name(NameId id) const { return names.text(id); }
    /// The name as the author wrote it.
    [[nodiscard]] std::string_view name(SymbolId id) const {
        return names.written(program.symbol(id).name);
    }
};

using Check = void (*)(const CheckInput& input, Diagnostics& diagnostics);

/// Runs all checks. If Program::is_valid is false, runs only the checks that also work on programs
/// with errors (checks.cpp).
void run_checks(const CheckInput& input, Diagnostics& diagnostics);

// Checks of rules of docs/language.md that need the whole program, each in a file of its own. Lints
// are in lints.h.
void check_probability_sums(const CheckInput& input, Diagnostics& diagnostics);
void check_formal_names(const CheckInput& input, Diagnostics& diagnostics);
void check_ignored_contexts(const CheckInput& input, Diagnostics& diagnostics);
void check_extra_parameters(const CheckInput& input, Diagnostics& diagnostics);

/// The place of the name, with its back quotes if any, of module `index` of Program::modules.
/// Precondition: the module belongs to `word`.
[[nodiscard]] SourceSpan
module_name_span(const CheckInput& input, const ProgramWord& word, std::size_t index);

} // namespace lsys
