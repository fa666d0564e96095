// Which features of the language a generated case really exercises: a feature of a production
// counts only if the production was applied. The self-test asks that every one is common enough.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/generate.h"

#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

std::set<std::string> features_of(const Case& made, const Derivation& derivation);

// All names that `features_of` can give.
const std::vector<std::string>& feature_names();

} // namespace lsys::reference
