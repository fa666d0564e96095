// A host that remembers the files it was asked for, so that they can be watched.
#pragma once

#include "runtime/pipeline/project.h"

#include <string>
#include <vector>

namespace lsys::view {

/// `host`, adding the path of every file that is asked for to `files`, whether it can be read or
/// not. `files` outlives the host.
[[nodiscard]] Host record_files(Host host, std::vector<std::string>& files);

} // namespace lsys::view
