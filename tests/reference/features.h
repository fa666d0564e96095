// SPDX-License-Identifier: MIT
// Lists the features of the language that a generated case uses. A feature of a production counts
// only if the production was applied. generator_test.cpp checks that cases use every feature often
// enough.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/generate.h"

#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

std::set<std::string> features_of(const Case& test_case, const Derivation& derivation);

// All names that features_of() may return.
const std::vector<std::string>& feature_names();

// Further features, which only plants that sense use (generate_plant()).
std::set<std::string> sense_features_of(const Case& test_case, const Derivation& derivation);
const std::vector<std::string>& sense_feature_names();

} // namespace lsys::reference
