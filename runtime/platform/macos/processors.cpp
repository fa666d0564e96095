// SPDX-License-Identifier: MIT
#include "runtime/platform/processors.h"

namespace lsys::platform {

std::vector<std::uint64_t> allowed_processors() {
    return {};
}

} // namespace lsys::platform
