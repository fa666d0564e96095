// SPDX-License-Identifier: MIT
// Instancing (docs/language.md section 9): from a checked Program to the bytecode of its instanced
// system, and the list of the productions of that system.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace lsys {

/// Number of forms per production that a listing shows by default.
inline constexpr std::uint64_t kDefaultFormCount = 4096;

struct InstancedSystem {
    Bytecode bytecode;
    /// By branch id, of which 0 is the axiom: whether the drawing depends on the vertical.
    std::vector<bool> depends_on_vertical;
    std::size_t kind_count = 0; // number of different valid branches
};

/// Compiles the instanced system, in which each valid branch is replaced by a recorded branch with
/// probability `rho` in [0, 1]. Returns nothing if the system cannot be instanced, after reporting
/// the reasons.
[[nodiscard]] std::optional<InstancedSystem> compile_instanced(Program program,
                                                               const Names& names,
                                                               const SourceMap& sources,
                                                               float rho,
                                                               Diagnostics& diagnostics);

/// The range of form numbers that a listing shows of each production (docs/language.md section
/// 9.2).
struct FormPage {
    std::uint64_t first = 0;
    std::uint64_t count = kDefaultFormCount;
};

/// Lists forms of each production with their probabilities. Passes the text to `put` in pieces
/// until `put` returns false. If `page` is not set, lists the first page and notes each production
/// that has more forms. Time and memory are linear in the forms listed. Returns the largest form
/// number of all productions, 2^n - 1 or 2^64 - 1; if it is below `page.first`, nothing is listed.
/// Returns nothing, after reporting the reasons, if the system cannot be instanced.
[[nodiscard]] std::optional<std::uint64_t>
list_instanced(const Program& program,
               const Names& names,
               const SourceMap& sources,
               float rho,
               const std::optional<FormPage>& page,
               const std::function<bool(std::string_view)>& put,
               Diagnostics& diagnostics);

} // namespace lsys
