// SPDX-License-Identifier: MIT
// Plants of samples/, for tests of meshes.
#pragma once

#include "runtime/pipeline/plant.h"

#include <string>

namespace lsys::test {

/// The plant of samples/NAME/LAST.lsys, where LAST is NAME or its part after the last `/`.
[[nodiscard]] lsys::Plant sample_plant(const std::string& name);

} // namespace lsys::test
