// The unfinished files of this process by name, so that a signal that ends it can remove them.
// Written by Output, read by the signal handlers of process.cpp.
#pragma once

#include <string>

namespace lsys {

/// A place for one name. Never freed: a signal handler may be reading it.
struct TemporaryName;

/// Remembers `path` until unregister_temporary(). Thread-safe.
[[nodiscard]] TemporaryName* register_temporary(const std::string& path);
void unregister_temporary(TemporaryName* name);

/// Removes all remembered files. Async-signal-safe: allocates nothing and takes no lock.
void remove_temporaries() noexcept;

} // namespace lsys
