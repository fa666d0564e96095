// The instanced system of Kenwood, Gain and Marais 2014 (docs/language.md section 9): each valid
// branch is recorded, or with probability rho taken from those that were.
#pragma once

#include "compiler/instancing/impl/branches.h"
#include "compiler/program/program.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>

namespace lsys {

/// Longer lists than that of 2^12 forms of one production are refused.
inline constexpr std::uint32_t kMostListedBranches = 12;

/// Lets the `[` of each valid branch say whether it is taken, its age and id, and the formals that
/// its text uses: a module SaveBranch in its place, so that all modules keep their positions and
/// the word is that of the plain system. Each branch draws by itself. Precondition: rho in [0, 1].
void instance_branches(Program& program, const Branches& branches, float rho);

/// The 2^n forms of each production with their probabilities, `@(id,#)[...]$` where a branch is
/// recorded and `<(id,#)[...]>` where it is taken. Precondition: no production has more than
/// kMostListedBranches; `program` is as it was checked.
[[nodiscard]] std::string list_branches(const Program& program,
                                        const Branches& branches,
                                        const Names& names,
                                        const SourceMap& sources,
                                        float rho);

} // namespace lsys
