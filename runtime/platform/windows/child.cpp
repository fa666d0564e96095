// SPDX-License-Identifier: MIT
#include "runtime/platform/child.h"

#include <cerrno>

namespace lsys::platform {

std::string find_program(const std::string& /*name*/) {
    return {};
}

Reason run_program(const std::vector<std::string>& /*arguments*/,
                   const std::string& /*messages*/,
                   const std::atomic<bool>& /*cancelled*/,
                   int& /*status*/) {
    return ENOSYS;
}

Reason start_program(const std::vector<std::string>& /*arguments*/, Child& /*child*/) {
    return ENOSYS;
}

bool has_ended(Child& /*child*/, int& /*status*/) {
    return false;
}

} // namespace lsys::platform
