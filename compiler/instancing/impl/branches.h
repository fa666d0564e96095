// SPDX-License-Identifier: MIT
// The valid branches of a system. Instancing records such a branch once and reuses the record in
// place of equal branches (docs/language.md section 9; Kenwood, Gain and Marais 2014, "Efficient
// procedural generation of forests", J. WSCG 22(1), as implemented by Carey 2019).
#pragma once

#include "compiler/program/program.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// A `[...]` of a successor in which, at any depth, some production can rewrite a module.
struct BranchSite {
    std::uint32_t production = 0; // index in Program::productions
    std::uint32_t number = 0;     // number within its successor, in text order
    std::uint32_t open = 0;       // index of `[` among the modules of the successor
    std::uint32_t close = 0;      // index of `]` among them
    std::uint32_t kind_id = 0;    // 1 + index in Branches::kinds
};

/// A set of branches that are equal after names are resolved.
struct BranchKind {
    std::uint32_t first_site = 0;       // index in Branches::sites
    std::vector<std::uint32_t> formals; // formals used in the branch, ascending
    std::vector<std::uint32_t> locals;  // local values used in the branch, ascending
    /// Whether the drawing of the branch depends on the vertical: by tropism or an operation with
    /// the trait DependsOnVertical, in the branch itself or after rewriting.
    bool depends_on_vertical = false;
    /// Whether a production that the branch can reach is stochastic or draws a random number.
    bool is_random = false;
};

struct Branches {
    std::vector<BranchSite> sites; // sites in file order, an outer branch before its inner ones
    std::vector<BranchKind> kinds; // kind of id i at i - 1; id 0 is the axiom
    bool axiom_is_random = false;
};

/// Returns nothing if the system cannot be instanced, after reporting the reasons. Also reports a
/// system whose plants would all be equal, or all be copies of heroes, the plants whose branches
/// are recorded (DiagnosticCode::NoVariety). A system that senses or sweeps has no valid branches.
/// Precondition: program.is_valid.
[[nodiscard]] std::optional<Branches>
find_branches(const Program& program, const Names& names, Diagnostics& diagnostics);

} // namespace lsys
