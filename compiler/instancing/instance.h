// Instancing (docs/language.md section 9): from a checked Program to the bytecode of its instanced
// system, and the list of the productions of that system.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct InstancedSystem {
    Bytecode bytecode;
    std::vector<bool> depends_on_vertical; // by id: whether the drawing of the branch does
    std::size_t kind_count = 0;            // number of different valid branches
};

/// Compiles the instanced system, in which each valid branch is taken with probability `rho` in
/// [0, 1]. Returns nothing if the system cannot be instanced, after reporting the reasons.
[[nodiscard]] std::optional<InstancedSystem> compile_instanced(Program program,
                                                               const Names& names,
                                                               const SourceMap& sources,
                                                               float rho,
                                                               Diagnostics& diagnostics);

/// The 2^n forms of each production with their probabilities. Returns nothing, after a report, if
/// the system cannot be instanced or a production has more than 12 branches.
[[nodiscard]] std::optional<std::string> list_instanced(const Program& program,
                                                        const Names& names,
                                                        const SourceMap& sources,
                                                        float rho,
                                                        Diagnostics& diagnostics);

} // namespace lsys
