// SPDX-License-Identifier: MIT
#include <lsys/api.h>

namespace lsys::v0 {

const char* version() noexcept {
    return LSYS_LIBRARY_VERSION;
}

int version_number() noexcept {
    return LSYS_VERSION;
}

} // namespace lsys::v0
