// SPDX-License-Identifier: MIT
#include "runtime/platform/input.h"

namespace lsys::platform {

bool wait_for_standard_input(int /*milliseconds*/) {
    return true; // the read that follows waits
}

} // namespace lsys::platform
