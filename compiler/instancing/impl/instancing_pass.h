// The instanced system of Kenwood, Gain and Marais 2014 (docs/language.md section 9): each valid
// branch is recorded, or with probability rho replaced by a recorded branch.
#pragma once

#include "compiler/instancing/impl/branches.h"
#include "compiler/program/program.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>

namespace lsys {

/// Maximum number of branches of a production whose 2^n forms are listed.
inline constexpr std::uint32_t kMaxListedBranches = 12;

/// Replaces the `[` of each valid branch by a module SaveBranch, whose parameters say whether a
/// recorded branch is taken, the age, the id, and the formals that the branch uses. All modules
/// keep their positions, so the rest of the word is the one of the plain system. Each branch has a
/// draw of its own. Precondition: rho in [0, 1].
void instance_branches(Program& program, const Branches& branches, float rho);

/// The 2^n forms of each production with their probabilities, `@(id,#)[...]$` where a branch is
/// recorded and `<(id,#)[...]>` where it is taken. Precondition: no production has more than
/// kMaxListedBranches; `program` has not been instanced.
[[nodiscard]] std::string list_branches(const Program& program,
                                        const Branches& branches,
                                        const Names& names,
                                        const SourceMap& sources,
                                        float rho);

} // namespace lsys
