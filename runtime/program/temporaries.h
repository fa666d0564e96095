// SPDX-License-Identifier: MIT
// Names of the temporary files of this process. Output registers them; the signal handlers that
// process.cpp sets remove the files.
#pragma once

#include <string>

namespace lsys {

/// A slot for one name; never freed, because a signal handler may read it.
struct TemporaryName;

/// Registers `path` until unregister_temporary(). Thread-safe.
[[nodiscard]] TemporaryName* register_temporary(const std::string& path);
void unregister_temporary(TemporaryName* name);

/// Removes all registered files. Async-signal-safe: no allocation, no lock.
void remove_temporaries() noexcept;

} // namespace lsys
