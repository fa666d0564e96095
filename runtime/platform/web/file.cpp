// SPDX-License-Identifier: MIT
#include "runtime/platform/file.h"

#include <cerrno>
#include <unistd.h>

namespace lsys::platform {

Reason rename_to_new(const std::string& /*from*/, const std::string& /*to*/) {
    return ENOSYS;
}

Reason exchange_files(const std::string& /*one*/, const std::string& /*other*/) {
    return ENOSYS;
}

std::uint64_t random_bits() {
    std::uint64_t bits = 0;
    if (::getentropy(&bits, sizeof bits) != 0) {
        static std::uint64_t count = 0;
        bits = ++count;
    }
    return bits;
}

} // namespace lsys::platform
