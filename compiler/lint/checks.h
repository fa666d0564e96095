// The checks of a Program: what a grammar may say but hardly means, and the rules of
// docs/language.md that need the whole program. Each check is one function in a file of its own;
// checks.cpp lists them. They run in the order of the list, after lowering, so that they may ask
// the bytecode as well.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/compile_options.h"
#include "compiler/program/program.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <string_view>

namespace lsys {

/// What a check may look at.
struct CheckInput {
    const Program& program;
    /// Null where the program has errors. Productions have the same index in both.
    const Bytecode* bytecode;
    const Names& names;
    const SourceMap& sources;
    const CompileOptions& options;

    [[nodiscard]] std::string_view name(NameId id) const { return names.text(id); }
    /// As the author wrote it.
    [[nodiscard]] std::string_view name(SymbolId id) const {
        return names.written(program.symbol(id).name);
    }
};

using Check = void (*)(const CheckInput& input, Diagnostics& diagnostics);

/// Runs every check of the list; of an incomplete program only those that look at one production,
/// word or statement at a time.
void run_checks(const CheckInput& input, Diagnostics& diagnostics);

// Rules of docs/language.md that need the whole program; each in a file of its own. lints.h has the
// rest.
void check_probability_sums(const CheckInput& input, Diagnostics& diagnostics);
void check_formal_names(const CheckInput& input, Diagnostics& diagnostics);
void check_ignored_contexts(const CheckInput& input, Diagnostics& diagnostics);
void check_extra_parameters(const CheckInput& input, Diagnostics& diagnostics);

/// The bytes of the name of module `index` of Program::modules, which stands in `word`; with its
/// back quotes, if it is written in them.
[[nodiscard]] SourceSpan
module_name_span(const CheckInput& input, const ProgramWord& word, std::size_t index);

} // namespace lsys
