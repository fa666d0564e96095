// SPDX-License-Identifier: MIT
// `lsview` run in-process by tests.
#pragma once

#include "tests/support/lsc_run.h"

#include <string>
#include <vector>

namespace lsys::tests {

[[nodiscard]] LscRun run_lsview(const std::vector<std::string>& arguments);
/// The path of a sample's grammar, `samples/NAME/NAME.lsys`.
[[nodiscard]] std::string sample(const std::string& name);

} // namespace lsys::tests
