// SPDX-License-Identifier: MIT
// The instanced system of Kenwood, Gain and Marais 2014 (docs/language.md section 9): each valid
// branch is recorded, or with probability rho replaced by a recorded branch.
#pragma once

#include "compiler/instancing/impl/branches.h"
#include "compiler/instancing/instance.h"
#include "compiler/program/program.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace lsys {

/// Replaces the `[` of each valid branch by a module SaveBranch. Its parameters are: whether to
/// take a recorded branch, the age, the id, and the formals and local values that the branch uses.
/// The positions of all modules stay the same, and all other modules equal the modules of the
/// original system. Each branch has a draw of its own. Precondition: rho in [0, 1].
void instance_branches(Program& program, const Branches& branches, float rho);

/// The greatest form number of a production with n branches: 2^n - 1, or 2^64 - 1 for n > 64.
[[nodiscard]] std::uint64_t last_form(std::size_t branch_count);

/// Lists forms [first, first + count) of each production that has them, with their probabilities:
/// `@(id,#)[...]$` for a branch that is recorded, `<(id,#)[...]>` for one taken from a record.
/// `put` gets the text in pieces and returns false to end the list. Precondition: `program` has not
/// been instanced.
void list_branches(const Program& program,
                   const Branches& branches,
                   const Names& names,
                   const SourceMap& sources,
                   float rho,
                   const FormPage& page,
                   const std::function<bool(std::string_view)>& put);

} // namespace lsys
