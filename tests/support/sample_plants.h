// SPDX-License-Identifier: MIT
// Plants of samples/, for tests of meshes.
#pragma once

#include "runtime/pipeline/plant.h"

#include <string>
#include <vector>

namespace lsys::test {

/// The plant of samples/NAME/LAST.lsys, where LAST is NAME or its part after the last `/`, with
/// other values for the constants in `definitions`.
[[nodiscard]] lsys::Plant sample_plant(const std::string& name,
                                       const std::vector<lsys::Definition>& definitions = {});

} // namespace lsys::test
