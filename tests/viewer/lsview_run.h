// SPDX-License-Identifier: MIT
// `lsview` run in-process by tests.
#pragma once

#include "tests/support/lsc_run.h"

#include <string>
#include <vector>

namespace lsys::tests {

/// Pictures have low quality unless the arguments set another one, so that stored pictures are
/// compared with pictures of any device.
[[nodiscard]] LscRun run_lsview(const std::vector<std::string>& arguments);
/// The path of a sample's grammar, `samples/NAME/NAME.lsys`.
[[nodiscard]] std::string sample(const std::string& name);

} // namespace lsys::tests
