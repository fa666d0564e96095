// SPDX-License-Identifier: MIT
// Plants of samples/, for tests of meshes.
#pragma once

#include "runtime/pipeline/plant.h"

#include <string>
#include <vector>

namespace lsys::test {

/// The plant of samples/NAME/LAST.lsys, where LAST is the part of NAME after the last `/`.
/// `definitions`: values that replace values of constants.
[[nodiscard]] lsys::Plant sample_plant(const std::string& name,
                                       const std::vector<lsys::Definition>& definitions = {});

} // namespace lsys::test
