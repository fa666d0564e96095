// Instancing for those who use the compiler: from a checked Program to the bytecode of its
// instanced system, and the list of that system's productions (docs/language.md section 9).
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
    std::vector<bool> depends_on_vertical; // by id: the drawing does
    std::size_t kind_count = 0;            // of different valid branches
};

/// Each valid branch is taken with probability `rho`, in [0, 1]. Nothing if the system cannot be
/// instanced: `diagnostics` say why. The program is used up.
[[nodiscard]] std::optional<InstancedSystem> compile_instanced(Program program,
                                                               const Names& names,
                                                               const SourceMap& sources,
                                                               float rho,
                                                               Diagnostics& diagnostics);

/// The 2^n forms of each production with their probabilities. Nothing as above, or if a production
/// has so many branches that its forms are not for reading.
[[nodiscard]] std::optional<std::string> list_instanced(const Program& program,
                                                        const Names& names,
                                                        const SourceMap& sources,
                                                        float rho,
                                                        Diagnostics& diagnostics);

} // namespace lsys
