// SPDX-License-Identifier: MIT
// Processor time of threads.
#pragma once

namespace lsys::platform {

/// Seconds for which a processor has run the calling thread, without the time in which it waited; 0
/// if the system does not tell.
[[nodiscard]] double thread_cpu_seconds();

} // namespace lsys::platform
