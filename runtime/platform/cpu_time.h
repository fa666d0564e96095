// SPDX-License-Identifier: MIT
// Processor time of threads.
#pragma once

namespace lsys::platform {

/// Seconds for which a processor has run the calling thread, without the time in which the thread
/// waited; 0 if unknown.
[[nodiscard]] double thread_cpu_seconds();

} // namespace lsys::platform
