// SPDX-License-Identifier: MIT
// Waits for standard input, for programs that answer requests until they are ended.
#pragma once

namespace lsys::platform {

/// Waits until standard input has bytes or ends, at most `milliseconds`. Returns false after this
/// time and after a signal. On Windows returns true at once.
[[nodiscard]] bool wait_for_standard_input(int milliseconds);

} // namespace lsys::platform
