// SPDX-License-Identifier: MIT
#include "runtime/platform/input.h"

#include <poll.h>
#include <unistd.h>

namespace lsys::platform {

bool wait_for_standard_input(int milliseconds) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return ::poll(&input, 1, milliseconds) > 0;
}

} // namespace lsys::platform
