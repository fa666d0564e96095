// SPDX-License-Identifier: MIT
// Runs `lsview` in-process in tests.
#pragma once

#include "tests/support/lsc_run.h"

#include <string>
#include <vector>

namespace lsys::tests {

/// Runs `lsview ARGUMENTS`. Pictures have low quality unless the arguments set another quality, so
/// that pictures of any device can be compared with stored pictures.
[[nodiscard]] LscRun run_lsview(const std::vector<std::string>& arguments);
/// The path of a sample's grammar, `samples/NAME/NAME.lsys`.
[[nodiscard]] std::string sample(const std::string& name);

} // namespace lsys::tests
