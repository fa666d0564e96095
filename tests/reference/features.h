// SPDX-License-Identifier: MIT
// The features of the language that a generated case exercises: a feature of a production counts
// only if the production was applied. generator_test.cpp checks that every feature is frequent
// enough.

#pragma once

#include "tests/reference/derive.h"
#include "tests/reference/generate.h"

#include <set>
#include <string>
#include <vector>

namespace lsys::reference {

std::set<std::string> features_of(const Case& test_case, const Derivation& derivation);

// All names that `features_of` can give.
const std::vector<std::string>& feature_names();

// The same for what plants that sense exercise beyond that.
std::set<std::string> sense_features_of(const Case& test_case, const Derivation& derivation);
const std::vector<std::string>& sense_feature_names();

} // namespace lsys::reference
