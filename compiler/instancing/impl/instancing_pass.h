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

/// Replaces the `[` of each valid branch by a module SaveBranch, whose parameters say whether a
/// recorded branch is taken, the age, the id, and the formals that the branch uses. All modules
/// keep their positions, so the rest of the word is the one of the plain system. Each branch has a
/// draw of its own. Precondition: rho in [0, 1].
void instance_branches(Program& program, const Branches& branches, float rho);

/// The greatest number of a form of a production with n branches: 2^n - 1, or 2^64 - 1 for n > 64.
[[nodiscard]] std::uint64_t last_form(std::size_t branch_count);

/// Lists forms [first, first + count) of each production that has them, with their probabilities,
/// `@(id,#)[...]$` where a branch is recorded and `<(id,#)[...]>` where it is taken. `put` takes
/// the text in pieces; false ends the list. Precondition: `program` has not been instanced.
void list_branches(const Program& program,
                   const Branches& branches,
                   const Names& names,
                   const SourceMap& sources,
                   float rho,
                   const FormPage& page,
                   const std::function<bool(std::string_view)>& put);

} // namespace lsys
